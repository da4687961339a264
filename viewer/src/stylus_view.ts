// The stylus that the hand holds: a pen with its tip at the proxy, turned as the device reports; with a gripper, two
// fingers that open as its do. It is drawn as long as a hand is in the scene, so it is no size to measure by.

import * as THREE from "three";
import type { Stylus } from "./gen/hl_pb";
import { themeColour } from "./theme";
import { turnOf } from "./stylus_turn";
import type { Vec } from "./vec";

/** A pen, in lengths of its own: along +z from the tip. */
const kCone = 0.18;
const kRadius = 0.035;
const kFinger = { length: 0.3, thickness: 0.03 };
/** Of what the camera shows. */
const kShare = 0.3;
const kOpacity = 0.75;

export class StylusView {
  readonly group = new THREE.Group();
  private readonly material_ = new THREE.MeshStandardMaterial({ roughness: 0.5, transparent: true, opacity: kOpacity });
  private readonly pen_ = new THREE.Group();
  private readonly fingers_: readonly [THREE.Mesh, THREE.Mesh];
  private shown_ = true;

  constructor() {
    const along = (geometry: THREE.BufferGeometry, z: number) => geometry.rotateX(Math.PI / 2).translate(0, 0, z);
    const cone = along(new THREE.ConeGeometry(kRadius, kCone, 24).rotateX(Math.PI), kCone / 2);
    const shaft = along(new THREE.CylinderGeometry(kRadius, kRadius, 1 - kCone, 24), (1 + kCone) / 2);
    this.pen_.add(new THREE.Mesh(cone, this.material_), new THREE.Mesh(shaft, this.material_));
    const { length, thickness } = kFinger;
    const finger = new THREE.BoxGeometry(thickness, thickness, length).translate(0, 0, -length / 2);
    this.fingers_ = [new THREE.Mesh(finger, this.material_), new THREE.Mesh(finger, this.material_)];
    this.fingers_.forEach((mesh) => mesh.position.set(0, 0, length));
    this.group.add(this.pen_, ...this.fingers_);
    this.group.visible = false;
  }

  setShown(shown: boolean): void {
    this.shown_ = shown;
  }

  setDiagonal(diagonal_m: number): void {
    this.group.scale.setScalar(kShare * diagonal_m);
  }

  applyTheme(): void {
    this.material_.color.set(themeColour("stylus"));
  }

  /** How far the device's gripper opens; 0: it has none. */
  setGripper(most_rad: number): void {
    const hasGripper = most_rad > 0;
    this.fingers_.forEach((mesh) => (mesh.visible = hasGripper));
    // The fingers meet at the proxy when they are closed; the pen begins where they are hinged.
    this.pen_.position.z = hasGripper ? kFinger.length - kCone / 2 : 0;
  }

  /** At the proxy; undefined: the device has none. */
  update(at: Vec, stylus: Stylus | undefined): void {
    const turned = turnOf(stylus?.rotation);
    this.group.visible = this.shown_ && stylus !== undefined;
    if (stylus === undefined) return;
    this.group.position.set(at.x, at.y, at.z);
    if (turned !== undefined) this.group.quaternion.copy(turned);
    const open_rad = Number.isFinite(stylus.gripperRad) ? stylus.gripperRad / 2 : 0;
    this.fingers_.forEach((mesh, i) => (mesh.rotation.y = i === 0 ? open_rad : -open_rad));
  }
}
