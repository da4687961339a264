// How high the proxy is: a line straight down to the first surface or the floor, and a spot where it ends.

import * as THREE from "three";
import { overlay } from "./overlay";
import { themeColour } from "./theme";
import type { Vec } from "./vec";

/** The spot's radius: a part of the proxy's, and at least so much. */
const kSpotPart = 0.6;
const kSpot_px = 4;
const kUp = new THREE.Vector3(0, 0, 1);

export class DropLine {
  readonly group = new THREE.Group();
  private readonly line_: THREE.Line<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private readonly spot_: THREE.Mesh<THREE.CircleGeometry, THREE.MeshBasicMaterial>;
  private shown_ = true;

  constructor() {
    const ends = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(new Float32Array(6), 3));
    this.line_ = new THREE.Line(ends, overlay(THREE.LineBasicMaterial, 0.55, true));
    this.line_.frustumCulled = false;
    this.spot_ = new THREE.Mesh(new THREE.CircleGeometry(1, 32), overlay(THREE.MeshBasicMaterial, 0.6));
    this.group.add(this.line_, this.spot_);
    this.group.visible = false;
  }

  setShown(shown: boolean): void {
    this.shown_ = shown;
  }

  applyTheme(): void {
    this.line_.material.color.set(themeColour("drop"));
    this.spot_.material.color.set(themeColour("drop"));
  }

  /** From the proxy to `foot`, where the surface has `normal`; undefined: there is nothing below. */
  update(
    proxy: Vec | undefined, foot: { point: Vec; normal: Vec } | undefined, radius_m: number, metresPerPixel: number,
  ): void {
    this.group.visible = this.shown_ && proxy !== undefined && foot !== undefined;
    if (!this.shown_ || proxy === undefined || foot === undefined) {
      return;
    }
    const { point, normal } = foot;
    const ends = this.line_.geometry.getAttribute("position") as THREE.BufferAttribute;
    ends.setXYZ(0, proxy.x, proxy.y, proxy.z).setXYZ(1, point.x, point.y, point.z);
    ends.needsUpdate = true;
    this.spot_.position.set(point.x, point.y, point.z);
    this.spot_.quaternion.setFromUnitVectors(kUp, new THREE.Vector3(normal.x, normal.y, normal.z).normalize());
    this.spot_.scale.setScalar(Math.max(kSpotPart * radius_m, kSpot_px * metresPerPixel));
  }
}
