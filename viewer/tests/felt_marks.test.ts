// Marks of what is felt and not seen: where their lines are.
import { create, type MessageInitShape } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import type { FieldPlace, SnapPlace } from "../src/felt_places";
import {
  FieldKind, FieldSchema, JointKind, JointSchema, PlacedJointSchema, PlacedMeshSchema, SnapSchema,
} from "../src/gen/hl_pb";
import { FeltMarks } from "../src/felt_marks";
import { jointLines } from "../src/joint_lines";
import { placeEnds } from "../src/line_set";
import { across, type Line } from "../src/lines";
import { fieldLines, snapLines } from "../src/place_lines";
import type { Layout } from "../src/scene_messages";
import { add, cross, dot, length, scale, sub, unit, type Vec } from "../src/vec";

const at = (x: number, y = 0, z = 0): Vec => ({ x, y, z });
const kHere = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
const bytesOf = (pose: readonly number[]) => new Uint8Array(Float32Array.from(pose).buffer);
const snapAt = (points: Vec[], normal?: Vec, placed = 0): SnapPlace =>
  ({ placed, points, normal, snap: create(SnapSchema, { capture: 0.01 }) });
const fieldAt = (kind: FieldKind, points: Vec[], normal?: Vec): FieldPlace =>
  ({ placed: 0, points, normal, field: create(FieldSchema, { kind, reach: 0.1, direction: at(0, 0, 2) }) });
const jointOf = (joint: MessageInitShape<typeof JointSchema>) => create(JointSchema, joint);

/** Distance of a place from a line through `points`. */
function distanceTo(points: readonly Vec[], place: Vec): number {
  const toPiece = (from: Vec, to: Vec) => {
    const way = sub(to, from);
    const part = Math.min(1, Math.max(0, dot(sub(place, from), way) / dot(way, way)));
    return length(sub(place, add(from, scale(way, part))));
  };
  return points.length === 1
    ? length(sub(place, points[0]!))
    : Math.min(...points.slice(1).map((to, i) => toPiece(points[i]!, to)));
}
const farthest = (lines: readonly Line[], points: Vec[]) =>
  Math.max(...lines.flat().map((place) => distanceTo(points, place)));

test("two directions across any axis are a right-handed frame with it", () => {
  for (const axis of [at(1), at(0, -3), at(0, 0, 1e-9), at(1, 1, 1), at(-0.6, 0.8)]) {
    for (const toward of [at(0), at(1, 2, 3), axis]) {
      const [u, v] = across(axis, toward);
      expect(Math.abs(dot(u, axis)) + Math.abs(dot(v, axis))).toBeLessThan(1e-12);
      expect(length(sub(cross(u, v), unit(axis)))).toBeLessThan(1e-12);
    }
  }
});

describe("snaps", () => {
  test("are shown to their capture distance and no farther", () => {
    for (const points of [[at(1)], [at(1), at(1, 1)], [at(1), at(1, 1), at(2, 1, 1)]]) {
      expect(farthest(snapLines(snapAt(points), 1), points)).toBeCloseTo(0.01, 12);
    }
  });
  test("of a plane are a square in it, and the distance along its normal", () => {
    const heights = snapLines(snapAt([at(5)], at(0, 0, -4)), 2).flat().map(({ z }) => Math.abs(z));
    expect(Math.max(...heights)).toBeCloseTo(0.01, 12);
    expect(farthest(snapLines(snapAt([at(5)], at(0, 0, 1)), 2), [at(5)])).toBeCloseTo(2 * Math.SQRT2, 12);
  });
});

describe("fields", () => {
  const kKinds = [FieldKind.MAGNET, FieldKind.SPRING, FieldKind.CONSTANT, FieldKind.DRAG];
  test("of each kind are shown to their reach and no farther", () => {
    for (const kind of kKinds) {
      for (const points of [[at(1)], [at(1), at(1, 1)], [at(1), at(1, 1), at(2, 1, 1)]]) {
        expect(farthest(fieldLines(fieldAt(kind, points), 1), points)).toBeCloseTo(0.1, 9);
      }
      const slab = fieldLines(fieldAt(kind, [at(0)], at(0, 3)), 1).flat();
      expect(Math.max(...slab.map(({ y }) => y))).toBeCloseTo(0.1, 12);
    }
  });
  test("differ by kind, but for the two that pull", () => {
    const drawn = kKinds.map((kind) => JSON.stringify(fieldLines(fieldAt(kind, [at(0)]), 1)));
    expect(new Set(drawn).size).toBe(3);
  });
});

describe("joints", () => {
  test("a hinge has its axis, an arc from limit to limit, and a pointer to its body", () => {
    const hinge = jointOf({ kind: JointKind.HINGE, anchor: at(1), axis: at(0, 2), low: 0, high: Math.PI / 2 });
    const { ofA, ofB } = jointLines(hinge, at(4, 9), 0.1);
    expect(length(sub(ofA[0]![1]!, at(1.055)))).toBeLessThan(1e-12);
    expect(ofB[0]!.map(({ y }) => y)).toEqual([-0.1, 0.1]);
    const arc = ofB[1]!;
    expect(length(sub(arc[0]!, at(1.05)))).toBeLessThan(1e-12);
    // About +y a quarter of a turn takes x to -z.
    expect(length(sub(arc.at(-1)!, at(1, 0, -0.05)))).toBeLessThan(1e-12);
  });
  test("a slider has a bar from limit to limit", () => {
    const slider = jointOf({ kind: JointKind.SLIDER, anchor: at(1), axis: at(3), low: -0.2, high: 0.5 });
    const [from, to] = jointLines(slider, at(0), 0.1).ofB[0]!;
    expect(from!.x).toBeCloseTo(0.8, 12);
    expect(to!.x).toBeCloseTo(1.5, 12);
  });
  test("a distance goes from anchor to anchor, its limits about that of b", () => {
    const rope = jointOf({ kind: JointKind.DISTANCE, anchor: at(0), anchorB: at(0, 1), high: 2 });
    const { ofB, between } = jointLines(rope, at(0), 0.1);
    expect(between).toMatchObject([at(0), at(0, 1)]);
    for (const place of ofB.at(-1)!) expect(length(sub(place, at(0, 1)))).toBeCloseTo(2, 12);
  });
  test("every kind is shown near its anchor, with nothing that is no number", () => {
    for (const kind of [JointKind.BALL_JOINT, JointKind.HINGE, JointKind.SLIDER, JointKind.FIXED, JointKind.DISTANCE]) {
      const { ofA, ofB } = jointLines(jointOf({ kind }), at(0), 0.1);
      expect([...ofA, ...ofB].flat().length).toBeGreaterThan(0);
      expect(farthest([...ofA, ...ofB], [at(0)])).toBeLessThan(0.11);
    }
  });
});

test("lines follow the object whose frame they are in", () => {
  const turned = [0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7];
  const out = new Float32Array(6);
  placeEnds([{ frame: 1, place: at(1) }, { frame: -1, place: at(1, 2, 3) }], Float32Array.from([...kHere, ...turned]), out);
  expect([...out]).toEqual([5, 7, 7, 1, 2, 3]);
});

/** A body that began at x = 1, hinged to the world at its origin, with a snap above it. */
function doorLayout(now: readonly number[]): { layout: Layout; poses: Float32Array } {
  const start = bytesOf([1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0]);
  const placed = [create(PlacedMeshSchema, { body: {}, start })];
  const joint = { kind: JointKind.BALL_JOINT, anchor: at(1) };
  const mechanics = { gravity_m_s2: at(0), joints: [create(PlacedJointSchema, { joint, bodyA: 0 })] };
  const poses = Float32Array.from(now);
  const felt = { snaps: [snapAt([at(0, 1)])], fields: [] };
  const scaleOf = { bounds: undefined, proxyRadius_m: 1, worldPerDevice: 1 };
  return { layout: { number: 1, name: "", ...scaleOf, placed, poses, mechanics, felt }, poses };
}

test("the snap that holds is drawn once more, and one that does not exist is not", () => {
  const marks = new FeltMarks();
  const { layout, poses } = doorLayout(kHere);
  marks.setLayout(layout, poses);
  const drawn = () => marks.group.children.map((lines) => lines.visible);
  expect(drawn()).toEqual([true, false, false, true]);
  marks.setHeld(0);
  expect([marks.held, ...drawn()]).toEqual([0, true, true, false, true]);
  marks.setHeld(1);
  expect(marks.held).toBeUndefined();
  marks.clear();
  expect(drawn()).toEqual([false, false, false, false]);
});

test("a joint's lines of the world stay, and those of the body go with it from its start", () => {
  const marks = new FeltMarks();
  const { layout, poses } = doorLayout([1, 0, 0, 3, 0, 1, 0, 0, 0, 0, 1, 0]);
  marks.setLayout(layout, poses);
  const joints = marks.group.children[3] as unknown as { geometry: { getAttribute(name: string): { array: Float32Array } } };
  const xs = [...joints.geometry.getAttribute("position").array].filter((_, i) => i % 3 === 0);
  // The cross of the body is twice as large as the ball of the world.
  expect(Math.min(...xs)).toBeCloseTo(1 - 0.00125, 6);
  expect(Math.max(...xs)).toBeCloseTo(3 + 0.0025, 6);
});
