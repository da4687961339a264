import * as THREE from "three";
import { describe, expect, test } from "vitest";
import { turnedBy, turnOf } from "../src/stylus_turn";

const kNone = { right_rad: 0, down_rad: 0, roll_rad: 0 };
const straight = new THREE.Quaternion();
const shaftOf = (turned: THREE.Quaternion) => new THREE.Vector3(0, 0, 1).applyQuaternion(turned);
const rotation = (x: number, y: number, z: number, w: number) =>
  ({ $typeName: "hl.proto.Rotation" as const, x, y, z, w });

describe("the stylus", () => {
  test("is turned as the device says, whatever the length of its quaternion", () => {
    expect(turnOf(rotation(0, 0, 3, 4))!.angleTo(new THREE.Quaternion(0, 0, 0.6, 0.8))).toBeLessThan(1e-7);
  });

  test("is not known when that is none", () => {
    expect(turnOf(undefined)).toBeUndefined();
    expect(turnOf(rotation(0, 0, 0, 0))).toBeUndefined();
    expect(turnOf(rotation(NaN, 0, 0, 1))).toBeUndefined();
    expect(turnOf(rotation(0, 0, 0, Infinity))).toBeUndefined();
  });

  test("turns about the axes of the view", () => {
    const right = shaftOf(turnedBy(straight, { ...kNone, right_rad: Math.PI / 2 }, straight));
    expect(right.x).toBeCloseTo(1, 12);
    const down = shaftOf(turnedBy(straight, { ...kNone, down_rad: Math.PI / 2 }, straight));
    expect(down.y).toBeCloseTo(-1, 12);
    const fromTheSide = new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 1, 0), Math.PI / 2);
    const seen = shaftOf(turnedBy(straight, { ...kNone, down_rad: Math.PI / 2 }, fromTheSide));
    expect(seen.z).toBeCloseTo(1, 12);
  });

  test("rolls about its own shaft, wherever that points", () => {
    const turned = turnedBy(straight, { ...kNone, down_rad: 0.7 }, straight);
    const rolled = turnedBy(turned, { ...kNone, roll_rad: 1 }, straight);
    expect(shaftOf(rolled).distanceTo(shaftOf(turned))).toBeLessThan(1e-12);
    expect(rolled.angleTo(turned)).toBeCloseTo(1, 12);
  });
});
