// Turning a stylus in the view: angles about the axes of the camera, and about the shaft.

import * as THREE from "three";
import type { Rotation } from "./gen/hl_pb";

/** The pointer turns it by this for one pixel, a wheel pixel about its shaft. */
export const kTurn_rad_px = 0.006;

/** Absent, zero or not finite: it is not known. */
export function turnOf(rotation: Rotation | undefined): THREE.Quaternion | undefined {
  if (rotation === undefined) return undefined;
  const { x, y, z, w } = rotation;
  const turned = new THREE.Quaternion(x, y, z, w);
  const length = turned.length();
  return Number.isFinite(length) && length > 0 ? turned.normalize() : undefined;
}

/** In the axes of the view: `right` about the upright one, `down` about the one to the right; `roll` about the shaft. */
export interface Turn {
  readonly right_rad: number;
  readonly down_rad: number;
  readonly roll_rad: number;
}

export function turnedBy(turned: THREE.Quaternion, turn: Turn, camera: THREE.Quaternion): THREE.Quaternion {
  const axis = (x: number, y: number) => new THREE.Vector3(x, y, 0).applyQuaternion(camera);
  const yaw = new THREE.Quaternion().setFromAxisAngle(axis(0, 1), turn.right_rad);
  const pitch = new THREE.Quaternion().setFromAxisAngle(axis(1, 0), turn.down_rad);
  const roll = new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), turn.roll_rad);
  return yaw.multiply(pitch).multiply(turned).multiply(roll).normalize();
}
