// Friction cones: at each contact, about its normal, the directions in which static friction holds the proxy. While the
// force of the finger stays inside, the proxy sticks.

import * as THREE from "three";
import type { ContactPlane } from "./gen/hl_pb";
import { overlay } from "./overlay";
import { knownVec } from "./protocol";
import { themeColour } from "./theme";

const kMost = 8;
/** Height as a share of the model's diagonal. */
const kHeightShare = 0.12;
/** A cone of mu = 3 is nearly flat; wider ones would only hide the model. */
const kWidest = 3;

export class FrictionCones {
  readonly group = new THREE.Group();
  private readonly cones_: THREE.Mesh[] = [];
  private readonly fill_ = overlay(THREE.MeshBasicMaterial, 0.25, true);
  private height_m_ = 1;
  private slipping_ = false;

  constructor() {
    // Apex at the origin, opening along +y.
    const geometry = new THREE.ConeGeometry(1, 1, 48, 1, true).rotateX(Math.PI).translate(0, 0.5, 0);
    for (let i = 0; i < kMost; ++i) {
      const cone = new THREE.Mesh(geometry, this.fill_);
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
    this.height_m_ = kHeightShare * diagonal_m;
  }

  applyTheme(): void {
    this.fill_.color.set(themeColour(this.slipping_ ? "warn" : "plane"));
  }

  update(contacts: ContactPlane[], slipping: boolean): void {
    if (slipping !== this.slipping_) {
      this.slipping_ = slipping;
      this.applyTheme();
    }
    this.cones_.forEach((cone, i) => this.place(cone, contacts[i]));
  }

  private place(cone: THREE.Mesh, contact: ContactPlane | undefined): void {
    const point = knownVec(contact?.point);
    const normal = knownVec(contact?.normal);
    const mu = Math.min(contact?.staticFriction ?? 0, kWidest);
    cone.visible = point !== undefined && normal !== undefined && mu > 0;
    if (!cone.visible) {
      return;
    }
    cone.position.set(point!.x, point!.y, point!.z);
    const axis = new THREE.Vector3(normal!.x, normal!.y, normal!.z).normalize();
    cone.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis);
    cone.scale.set(mu * this.height_m_, this.height_m_, mu * this.height_m_);
  }
}
