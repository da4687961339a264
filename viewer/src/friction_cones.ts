// Friction cones: at each contact, about its normal, the directions in which static friction holds the proxy. While the
// force stays inside, the proxy sticks; another colour says that it slips.

import * as THREE from "three";
import { coneShape, forceShares } from "./cone_shape";
import type { ContactPlane } from "./gen/hl_pb";
import { overlay } from "./overlay";
import { themeColour } from "./theme";
import { knownVec } from "./wire_values";

const kMax = 8;
/** Shortest side as a share of the model's diagonal: the cone of a light touch would hide inside the proxy. */
const kShortestShare = 0.09;
const kUp = new THREE.Vector3(0, 1, 0);

export class FrictionCones {
  readonly group = new THREE.Group();
  private readonly cones_: THREE.Group[] = [];
  private readonly fill_ = overlay(THREE.MeshBasicMaterial, 0.2, true);
  private readonly rim_ = overlay(THREE.LineBasicMaterial, 0.9, true);
  private shortest_m_ = 1;
  private slipping_ = false;

  constructor() {
    // Apex at the origin, opening along +y, with a rim that shows where it ends.
    const side = new THREE.ConeGeometry(1, 1, 48, 1, true).rotateX(Math.PI).translate(0, 0.5, 0);
    const angles = Array.from({ length: 48 }, (_, i) => (i * Math.PI) / 24);
    const rim = angles.map((angle) => new THREE.Vector3(Math.cos(angle), 1, Math.sin(angle)));
    const loop = new THREE.BufferGeometry().setFromPoints(rim);
    for (let i = 0; i < kMax; ++i) {
      const cone = new THREE.Group().add(new THREE.Mesh(side, this.fill_), new THREE.LineLoop(loop, this.rim_));
      cone.visible = false;
      this.cones_.push(cone);
      this.group.add(cone);
    }
    this.group.visible = false;
  }

  setShown(shown: boolean): void {
    this.group.visible = shown;
  }

  setScene(diagonal_m: number): void {
    this.shortest_m_ = kShortestShare * diagonal_m;
  }

  applyTheme(): void {
    const colour = themeColour(this.slipping_ ? "slip" : "stick");
    this.fill_.color.set(colour);
    this.rim_.color.set(colour);
  }

  /** `arrow_m`: length of the arrow of the whole force. */
  update(contacts: ContactPlane[], slipping: boolean, arrow_m: number): void {
    if (slipping !== this.slipping_) {
      this.slipping_ = slipping;
      this.applyTheme();
    }
    const shares = forceShares(contacts);
    this.cones_.forEach((cone, i) => this.place(cone, contacts[i], (shares[i] ?? 0) * arrow_m));
  }

  private place(cone: THREE.Group, contact: ContactPlane | undefined, side_m: number): void {
    const point = knownVec(contact?.point);
    const normal = knownVec(contact?.normal);
    const mu = contact?.staticFriction ?? 0;
    cone.visible = point !== undefined && normal !== undefined && mu > 0;
    if (point === undefined || normal === undefined) {
      return;
    }
    const { height_m, radius_m } = coneShape(mu, Math.max(side_m, this.shortest_m_));
    cone.position.set(point.x, point.y, point.z);
    cone.quaternion.setFromUnitVectors(kUp, new THREE.Vector3(normal.x, normal.y, normal.z).normalize());
    cone.scale.set(radius_m, height_m, radius_m);
  }
}
