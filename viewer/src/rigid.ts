// Rigid poses: 3 x 4 numbers, row by row, from one frame to another.

import type { Vec } from "./vec";

export type Triple = readonly [number, number, number];
/** 3 x 4, row by row. */
export type Rigid = ArrayLike<number>;

export const kIdentity: Rigid = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

export const dot = (a: Triple, b: Triple): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const tripleOf = ({ x, y, z }: Vec): Triple => [x, y, z];
export const vecOf = ([x, y, z]: Triple): Vec => ({ x, y, z });

const row = (pose: Rigid, i: number): Triple => [pose[4 * i]!, pose[4 * i + 1]!, pose[4 * i + 2]!];
const column = (pose: Rigid, i: number): Triple => [pose[i]!, pose[4 + i]!, pose[8 + i]!];

/** A direction. */
export function turned(pose: Rigid, v: Triple): Triple {
  return [dot(row(pose, 0), v), dot(row(pose, 1), v), dot(row(pose, 2), v)];
}

/** A place. */
export function moved(pose: Rigid, place: Vec): Triple {
  const [u, v, w] = turned(pose, tripleOf(place));
  return [u + pose[3]!, v + pose[7]!, w + pose[11]!];
}

/** First `b`, then `a`. */
export function product(a: Rigid, b: Rigid): number[] {
  const columns = [0, 1, 2].map((i) => turned(a, column(b, i)));
  const origin = moved(a, vecOf(column(b, 3)));
  return [0, 1, 2].flatMap((i) => [columns[0]![i]!, columns[1]![i]!, columns[2]![i]!, origin[i]!]);
}

export function inverse(pose: Rigid): number[] {
  const origin = column(pose, 3);
  return [0, 1, 2].flatMap((i) => [...column(pose, i), -dot(column(pose, i), origin)]);
}
