// Bodies and joints in a scene file: where they are now, with coordinates counted from there.
import { create, type MessageInitShape } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { BodyShape, JointKind, JointSchema, PlacedJointSchema, PlacedMeshSchema } from "../src/gen/hl_pb";
import { bodyJson, mechanicsJson, transformJson } from "../src/saved_bodies";
import type { Layout } from "../src/scene_messages";

const bytesOf = (pose: readonly number[]) => new Uint8Array(Float32Array.from(pose).buffer);
const kHere = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
/** A quarter of a turn about z, then moved to 1 2 3. */
const kQuarter = [0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3];

/** Two bodies, which began at the first two poses and are at the others; the second one is the joint's b if `toB`. */
function mechanicsOf(
  joint: MessageInitShape<typeof JointSchema>, starts: readonly number[][], now: readonly number[][], toB = false,
): any {
  const placed = starts.map((start) => create(PlacedMeshSchema, { body: {}, start: bytesOf(start) }));
  const bodies = toB ? { bodyA: 0, bodyB: 1 } : { bodyA: 0 };
  const joints = [create(PlacedJointSchema, { joint, ...bodies })];
  const scale = { bounds: undefined, proxyRadius_m: 1, worldPerDevice: 1 };
  const poses = Float32Array.from(now.flat());
  const mechanics = { gravity_m_s2: { x: 0, y: -9.81, z: 0 }, joints };
  const layout: Layout = { number: 1, name: "", ...scale, placed, poses, mechanics };
  return mechanicsJson(layout, poses, (index) => `object ${index + 1}`);
}

const at = (angle: number, x = 0, y = 0) =>
  [Math.cos(angle), -Math.sin(angle), 0, x, Math.sin(angle), Math.cos(angle), 0, y, 0, 0, 1, 0];
const kAtOrigin = { x: 0, y: 0, z: 0 };

describe("a body in a scene file", () => {
  test("says what it is, and no motion", () => {
    const body = { shape: BodyShape.BOX, massKg: 0.1, densityKgM3: 1000, velocityMS: { x: 1 }, spinRadS: { y: 2 } };
    expect(bodyJson(create(PlacedMeshSchema, { body }))).toEqual({ shape: "BOX", massKg: 0.1, densityKgM3: 1000 });
  });

  test("has a transform that is its pose", () => {
    expect(transformJson(kHere)).toEqual({ translate: { x: 0, y: 0, z: 0 } });
    const { axis, degrees, translate } = transformJson(kQuarter) as any;
    expect(degrees).toBeCloseTo(90, 12);
    expect([axis.x, axis.y, Math.sign(axis.z)]).toEqual([0, 0, 1]);
    expect(translate).toEqual({ x: 1, y: 2, z: 3 });
  });

  test("that is turned by nearly half a turn about any axis keeps this axis", () => {
    for (const [x, y, z] of [[0.6, 0.8, 0], [0, 0.6, -0.8], [-0.48, 0.6, 0.64]] as const) {
      for (const angle of [Math.PI, Math.PI - 1e-4, 3.01, 2.9]) {
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        const d = 1 - c;
        const pose = [
          c + d * x * x, d * x * y - s * z, d * x * z + s * y, 0, d * x * y + s * z, c + d * y * y, d * y * z - s * x, 0,
          d * x * z - s * y, d * y * z + s * x, c + d * z * z, 0,
        ];
        const { axis, degrees } = transformJson(pose) as any;
        const length = Math.hypot(axis.x, axis.y, axis.z);
        const along = (axis.x * x + axis.y * y + axis.z * z) / length;
        expect(Math.abs(along)).toBeCloseTo(1, 12);
        expect((degrees * Math.PI) / 180).toBeCloseTo(along > 0 ? angle : 2 * Math.PI - angle, 9);
      }
    }
  });
});

describe("joints in a scene file", () => {
  test("have gravity with them, and nothing where there are no bodies", () => {
    expect(mechanicsOf({ anchor: kAtOrigin }, [kHere], [kHere])).toEqual({
      gravityMS2: { x: 0, y: -9.81, z: 0 }, joints: [{ anchor: {}, bodyA: "object 1" }],
    });
    const scale = { bounds: undefined, proxyRadius_m: 1, worldPerDevice: 1 };
    expect(mechanicsJson({ number: 1, name: "", ...scale, placed: [], poses: new Float32Array() },
      new Float32Array(), String)).toEqual({});
  });

  test("of a hinge count from the angle where it is", () => {
    const hinge = {
      kind: JointKind.HINGE, anchor: { x: 1, y: 0, z: 0 }, axis: { x: 0, y: 0, z: 2 }, low: -0.5, high: 2, rest: 0.25,
      spring: 3, table: { position: [0, 1], force: [4, 5] },
    };
    // About the line through 1 0 0 by 0.7 rad: the origin of the body goes to (1 - cos, -sin).
    const now = at(0.7, 1 - Math.cos(0.7), -Math.sin(0.7));
    const [joint] = mechanicsOf(hinge, [kHere], [now]).joints;
    expect(joint).toMatchObject({ kind: "HINGE", axis: { z: 2 }, spring: 3, bodyA: "object 1" });
    expect(joint.low).toBeCloseTo(-1.2, 6);
    expect(joint.high).toBeCloseTo(1.3, 6);
    expect(joint.rest).toBeCloseTo(-0.45, 6);
    expect(joint.table.position[1]).toBeCloseTo(0.3, 6);
    expect(joint.table.force).toEqual([4, 5]);
    expect(joint.anchor.x).toBeCloseTo(1, 6);
    expect(joint.anchor.y ?? 0).toBeCloseTo(0, 6);
  });

  test("of a hinge are within limits beyond half a turn", () => {
    const hinge = { kind: JointKind.HINGE, anchor: kAtOrigin, axis: { x: 0, y: 0, z: 1 }, low: 0, high: 5 };
    const [joint] = mechanicsOf(hinge, [kHere], [at(4)]).joints;
    expect(joint.low).toBeCloseTo(-4, 6);
    expect(joint.high).toBeCloseTo(1, 6);
    expect(joint.rest, "it has no spring").toBeUndefined();
  });

  test("of a slider between two bodies count from the way that a has gone along the axis of b", () => {
    const slider = { kind: JointKind.SLIDER, anchor: kAtOrigin, axis: { x: 1, y: 0, z: 0 }, low: 0, high: 0.1 };
    // Both are turned by a quarter; a has gone 0.04 along the turned axis.
    const quarter = Math.PI / 2;
    const [joint] = mechanicsOf(slider, [kHere, at(0, 3)], [at(quarter, 0, 0.04), at(quarter, 0, 3)], true).joints;
    expect(joint).toMatchObject({ kind: "SLIDER", bodyA: "object 1", bodyB: "object 2" });
    expect(joint.axis.y).toBeCloseTo(1, 6);
    expect(joint.low).toBeCloseTo(-0.04, 6);
    expect(joint.high).toBeCloseTo(0.06, 6);
    expect(joint.anchor.y).toBeCloseTo(0.04, 6);
  });

  test("of a distance keep it, and each anchor goes with its body", () => {
    const rod = {
      kind: JointKind.DISTANCE, anchor: { x: 1, y: 0, z: 0 }, anchorB: { x: 2, y: 0, z: 0 }, low: 1, high: 1,
    };
    const [joint] = mechanicsOf(rod, [kHere, kHere], [at(0, 0, 5), at(0, 0, 7)], true).joints;
    expect(joint).toMatchObject({ anchor: { x: 1, y: 5 }, anchorB: { x: 2, y: 7 }, low: 1, high: 1 });
  });
});
