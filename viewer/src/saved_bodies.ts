// Rigid bodies and joints as a scene file has them: where they are now, and at rest. A joint's coordinate is 0 where its
// file has the bodies, so limits, rest and table count from where it is now.

import { clone, create, toJson } from "@bufbuild/protobuf";
import {
  BodySchema, JointKind, JointSchema, Vec3Schema, type Joint, type PlacedJoint, type PlacedMesh,
} from "./gen/hl_pb";
import { dot, inverse, kIdentity, moved, product, tripleOf, turned, vecOf, type Rigid, type Triple } from "./rigid";
import { kPoseNumbers, type Layout } from "./scene_messages";
import type { Vec } from "./vec";
import { floats } from "./wire_values";

type Json = Record<string, unknown>;
/** By so much a limit is passed, as a part of a turn: what rounding and the step leave. */
const kSlack_rad = 0.01;

/** What a scene file says of a body, without where it is. */
export function bodyJson(placed: PlacedMesh): Json {
  const { velocityMS: _, spinRadS: __, ...rest } = toJson(BodySchema, placed.body!) as Json;
  return rest;
}

/** The pose as a Transform of a scene file. */
export function transformJson(pose: Rigid): Json {
  const { axis, angle } = turnOf(pose);
  const translate = vecJson([pose[3]!, pose[7]!, pose[11]!]);
  return angle === 0 ? { translate } : { axis: vecJson(axis), degrees: (180 / Math.PI) * angle, translate };
}

/** Gravity and joints: fields of the scene. `nameOf`: the name of a placed mesh in the file. */
export function mechanicsJson(layout: Layout, poses: Float32Array, nameOf: (index: number) => string): Json {
  if (layout.mechanics === undefined) {
    return {};
  }
  const { x, y, z } = layout.mechanics.gravity_m_s2;
  const gravityMS2 = vecJson([x, y, z]);
  const joints = layout.mechanics.joints.map((placed) => jointJson(placed, layout.placed, poses, nameOf));
  return joints.length === 0 ? { gravityMS2 } : { gravityMS2, joints };
}

function jointJson(
  { joint, bodyA, bodyB }: PlacedJoint, placed: readonly PlacedMesh[], poses: Float32Array,
  nameOf: (index: number) => string,
): Json {
  const a = wayOf(placed, poses, bodyA);
  const b = bodyB === undefined ? kIdentity : wayOf(placed, poses, bodyB);
  const moved = movedJoint(joint!, a, b);
  const bodies = bodyB === undefined ? { bodyA: nameOf(bodyA) } : { bodyA: nameOf(bodyA), bodyB: nameOf(bodyB) };
  return { ...(toJson(JointSchema, moved) as Json), ...bodies };
}

/** The motion of a body from its start, in the world. */
function wayOf(placed: readonly PlacedMesh[], poses: Float32Array, index: number): Rigid {
  const now = poses.subarray(kPoseNumbers * index, kPoseNumbers * (index + 1));
  return product(now, inverse(floats(placed[index]!.start, "start")));
}

/** The joint that has its coordinate 0 after body a has moved by `a`, and b by `b`. */
function movedJoint(joint: Joint, a: Rigid, b: Rigid): Joint {
  const coordinate = coordinateOf(joint, product(inverse(b), a));
  const out = clone(JointSchema, joint);
  out.anchor = create(Vec3Schema, vecOf(moved(a, placeOf(joint.anchor))));
  if (joint.anchorB !== undefined) out.anchorB = create(Vec3Schema, vecOf(moved(b, joint.anchorB)));
  if (joint.axis !== undefined) out.axis = create(Vec3Schema, vecOf(turned(b, tripleOf(joint.axis))));
  if (out.low !== undefined) out.low -= coordinate;
  if (out.high !== undefined) out.high -= coordinate;
  if (out.spring > 0) out.rest -= coordinate;
  if (out.table !== undefined) out.table.position = out.table.position.map((each) => each - coordinate);
  return out;
}

/** By which the coordinate of a joint is not 0 any more, after a has moved by `relative` as b sees it. */
function coordinateOf(joint: Joint, relative: Rigid): number {
  const axis = tripleOf(placeOf(joint.axis));
  const length = Math.hypot(...axis);
  const unit: Triple = [axis[0] / length, axis[1] / length, axis[2] / length];
  if (joint.kind === JointKind.SLIDER) {
    const anchor = placeOf(joint.anchor);
    return dot(unit, moved(relative, anchor)) - dot(unit, tripleOf(anchor));
  }
  return joint.kind === JointKind.HINGE ? withinLimits(angleAbout(unit, relative), joint) : 0;
}

/** The page does not know whole turns: of those that make sense the one within the limits. */
function withinLimits(angle: number, { low = -Infinity, high = Infinity }: Joint): number {
  const turns = [0, -1, 1].map((turn) => angle + 2 * Math.PI * turn);
  return turns.find((each) => each >= low - kSlack_rad && each <= high + kSlack_rad) ?? angle;
}

function angleAbout(unit: Triple, pose: Rigid): number {
  return Math.atan2(dot(unit, twiceSine(pose)), trace(pose) - 1);
}

/** Axis and angle, rad, of a pose's rotation. */
function turnOf(pose: Rigid): { axis: Triple; angle: number } {
  const twice = twiceSine(pose);
  const length = Math.hypot(...twice);
  const angle = Math.atan2(length, trace(pose) - 1);
  const kHalfTurn_rad = 3;
  const axis = angle > kHalfTurn_rad ? axisOfHalfTurn(pose, twice) : twice;
  return length === 0 && angle < kHalfTurn_rad ? { axis, angle: 0 } : { axis, angle };
}

/** Where the sine is next to 0 the symmetric part has the axis: (R + R^T) / 2 - cos I = (1 - cos) axis axis^T. */
function axisOfHalfTurn(pose: Rigid, twice: Triple): Triple {
  const cosine = (trace(pose) - 1) / 2;
  const entry = (row: number, column: number) =>
    (pose[4 * row + column]! + pose[4 * column + row]!) / 2 - (row === column ? cosine : 0);
  const columns = [0, 1, 2].map((column): Triple => [entry(0, column), entry(1, column), entry(2, column)]);
  const longest = columns.reduce((best, each) => (Math.hypot(...each) > Math.hypot(...best) ? each : best));
  return dot(longest, twice) < 0 ? [-longest[0], -longest[1], -longest[2]] : longest;
}

const trace = (pose: Rigid) => pose[0]! + pose[5]! + pose[10]!;
/** 2 sin(angle) axis. */
const twiceSine = (pose: Rigid): Triple => [pose[9]! - pose[6]!, pose[2]! - pose[8]!, pose[4]! - pose[1]!];
const placeOf = (v: Vec | undefined): Vec => v ?? { x: 0, y: 0, z: 0 };
const vecJson = ([x, y, z]: Triple): Json => ({ x, y, z });
