// Where a recorded object was: on a screw from one pose to another, as src/scene/motion.h has it.

import { kPoseNumbers } from "../scene_messages";
import type { Pose, Way } from "./recorded_values";

/** Turned by less than this (rad) a motion is a slide. */
const kNoTurn = 1e-9;

export function moves({ from, to }: Way): boolean {
  return from.some((value, i) => value !== to[i]);
}

/** In succession: the second way counts from its begin. A pose of a layout: 3 x 4, row by row. */
export function poseAt([earlier, last]: readonly [Way, Way], time_s: number): number[] {
  return rows(onWay(time_s < last.begin_s ? earlier : last, time_s));
}

function rows(pose: Pose): number[] {
  return Array.from({ length: kPoseNumbers }, (_, i) => {
    const [row, column] = [Math.floor(i / 4), i % 4];
    return pose[3 * column + row]!;
  });
}

function onWay(way: Way, time_s: number): Pose {
  const { from, to, begin_s, end_s } = way;
  if (time_s <= begin_s || !moves(way)) {
    return time_s <= begin_s ? from : to;
  }
  return time_s >= end_s ? to : part(from, to, (time_s - begin_s) / (end_s - begin_s));
}

type Triple = [number, number, number];
const dot = (a: Triple, b: Triple) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Triple, b: Triple): Triple =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const combined = (a: Triple, s: number, b: Triple): Triple => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const column = (pose: Pose, i: number): Triple => [pose[3 * i]!, pose[3 * i + 1]!, pose[3 * i + 2]!];

/** The share `u` of the screw X with to = X from: a turn about an axis, and a slide along it. */
function part(from: Pose, to: Pose, u: number): Pose {
  const turn = (v: Triple) => fromColumns(to, toColumns(from, v));
  const origin = column(from, 3);
  const slide = combined(column(to, 3), -1, turn(origin));
  const { axis, angle } = axisOf(turn);
  const turned = (v: Triple) => rotated(v, axis, u * angle);
  const columns = [0, 1, 2].map((i) => turned(column(from, i)));
  if (angle < kNoTurn) {
    return [...columns.flat(), ...combined(origin, u, combined(column(to, 3), -1, origin))];
  }
  // A point of the axis, c = (s + cot(angle / 2) axis x s) / 2 with s the part of the slide across the axis.
  const along = dot(slide, axis);
  const across = combined(slide, -along, axis);
  const centre = combined([0, 0, 0], 0.5, combined(across, 1 / Math.tan(angle / 2), cross(axis, across)));
  const place = combined(combined(centre, 1, turned(combined(origin, -1, centre))), u * along, axis);
  return [...columns.flat(), ...place];
}

function toColumns(pose: Pose, v: Triple): Triple {
  return [dot(column(pose, 0), v), dot(column(pose, 1), v), dot(column(pose, 2), v)];
}

function fromColumns(pose: Pose, v: Triple): Triple {
  return [0, 1, 2].reduce<Triple>((sum, i) => combined(sum, v[i]!, column(pose, i)), [0, 0, 0]);
}

/** Of a rotation, from what it makes of the unit vectors. */
function axisOf(turn: (v: Triple) => Triple): { axis: Triple; angle: number } {
  const [x, y, z] = [turn([1, 0, 0]), turn([0, 1, 0]), turn([0, 0, 1])] as const;
  const twice: Triple = [y[2] - z[1], z[0] - x[2], x[1] - y[0]];
  const sine = Math.hypot(...twice) / 2;
  const cosine = (x[0] + y[1] + z[2] - 1) / 2;
  const angle = Math.atan2(sine, cosine);
  if (sine > kNoTurn) {
    return { axis: combined([0, 0, 0], 1 / (2 * sine), twice), angle };
  }
  // Half a circle, or no turn: the axis is the longest column of R + 1.
  const candidates = [combined(x, 1, [1, 0, 0]), combined(y, 1, [0, 1, 0]), combined(z, 1, [0, 0, 1])];
  const longest = candidates.reduce((a, b) => (Math.hypot(...a) >= Math.hypot(...b) ? a : b));
  return { axis: combined([0, 0, 0], 1 / Math.hypot(...longest), longest), angle };
}

/** Rodrigues' formula. */
function rotated(v: Triple, axis: Triple, angle: number): Triple {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const sideways = combined(combined([0, 0, 0], c, v), s, cross(axis, v));
  return combined(sideways, (1 - c) * dot(axis, v), axis);
}
