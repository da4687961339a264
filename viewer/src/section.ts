// A section plane: it takes away, in the picture alone, what lies on one side, so that hollows can be looked into.

import type { Bounds } from "./scene_messages";
import { dot, type Vec } from "./vec";

/** From which side material is taken away. */
export const kSides = ["off", "right", "left", "above", "below", "front", "back"] as const;
export type Side = (typeof kSides)[number];

/** What is drawn: points with normal . p + constant >= 0. */
export interface Section {
  readonly normal: Vec;
  readonly constant_m: number;
}

const kAxes: Readonly<Record<Exclude<Side, "off">, readonly ["x" | "y" | "z", 1 | -1]>> = {
  right: ["x", -1], left: ["x", 1], above: ["y", -1], below: ["y", 1], front: ["z", -1], back: ["z", 1],
};

/** `share` of the size of `bounds` is taken away from this side. */
export function sectionOf(side: Side, share: number, bounds: Bounds | undefined): Section | undefined {
  if (side === "off" || bounds === undefined) {
    return undefined;
  }
  const [axis, sign] = kAxes[side];
  const [low, high] = [bounds.min[axis], bounds.max[axis]];
  const at = sign < 0 ? high - share * (high - low) : low + share * (high - low);
  return { normal: { x: 0, y: 0, z: 0, [axis]: sign }, constant_m: -sign * at };
}

export function keeps({ normal, constant_m }: Section, point: Vec): boolean {
  return dot(normal, point) + constant_m >= 0;
}
