// When the camera is fitted by itself: for the first objects there are. After that it stays where it is while objects
// come, go and move; only a scene that begins anew, somewhere else or in another size, is fitted again.

import type { Bounds } from "./scene_messages";
import { add, length, scale, sub } from "./vec";

/** A new scene within this factor of the size, and within this share of the size beside the old one, is in view. */
const kSizes = 2;
const kBeside = 0.5;

export function diagonalOf(bounds: Bounds): number {
  return Math.max(1e-6, length(sub(bounds.max, bounds.min)));
}

/** Whether a camera fitted to `fitted` shows a scene that begins with `now` badly. */
export function needsFit(fitted: Bounds | undefined, now: Bounds): boolean {
  if (fitted === undefined) {
    return true;
  }
  const ratio = diagonalOf(now) / diagonalOf(fitted);
  const beside = length(sub(centreOf(now), centreOf(fitted))) / diagonalOf(fitted);
  return ratio > kSizes || ratio < 1 / kSizes || beside > kBeside;
}

function centreOf(bounds: Bounds) {
  return scale(add(bounds.min, bounds.max), 0.5);
}
