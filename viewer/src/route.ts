// The way of the hand to a place: straight if nothing is in between, else the shortest way over places around it. The
// proxy cannot pass through what is touched, so a hand that went straight would be held on the wrong side.

import type { Bounds } from "./scene_messages";
import { add, length, mix, scale, sub, type Vec } from "./vec";

/** Whether nothing lies between two places. */
export type Free = (a: Vec, b: Vec) => boolean;

/** Corners, middles of edges and middles of faces of a box that is `margin_m` larger to each side. */
export function placesAround(bounds: Bounds, margin_m: number): Vec[] {
  const margin: Vec = { x: margin_m, y: margin_m, z: margin_m };
  const [low, high] = [sub(bounds.min, margin), add(bounds.max, margin)];
  const steps = [0, 0.5, 1];
  const at = (a: number, b: number, t: number) => a + (b - a) * t;
  const grid = steps.flatMap((i) => steps.flatMap((j) => steps.map((k) => [i, j, k] as const)));
  return grid.filter(([i, j, k]) => i !== 0.5 || j !== 0.5 || k !== 0.5)
    .map(([i, j, k]) => ({ x: at(low.x, high.x, i), y: at(low.y, high.y, j), z: at(low.z, high.z, k) }));
}

/** From `from` to `to` over some of `places` (Dijkstra); straight when there is no way at all. */
export function route(from: Vec, to: Vec, places: readonly Vec[], free: Free): Vec[] {
  if (free(from, to)) {
    return [from, to];
  }
  const nodes = [from, ...places, to];
  const way = nodes.map((_, i) => (i === 0 ? 0 : Infinity));
  const before = nodes.map(() => -1);
  const open = new Set(nodes.keys());
  while (open.size > 0) {
    const next = [...open].reduce((a, b) => (way[a]! <= way[b]! ? a : b));
    open.delete(next);
    if (way[next] === Infinity || next === nodes.length - 1) {
      break;
    }
    for (const other of open) {
      const reached = way[next]! + length(sub(nodes[other]!, nodes[next]!));
      if (reached < way[other]! && free(nodes[next]!, nodes[other]!)) {
        way[other] = reached;
        before[other] = next;
      }
    }
  }
  const path = [nodes.length - 1];
  while (before[path[0]!]! >= 0) {
    path.unshift(before[path[0]!]!);
  }
  return path[0] === 0 ? path.map((i) => nodes[i]!) : [from, to];
}

/** A hand on its way along a line of points: where it is to go next. */
export class Walk {
  private readonly points_: readonly Vec[];
  /** Length of the way up to each point. */
  private readonly ways_: number[] = [0];
  private done_m_ = 0;

  constructor(points: readonly Vec[]) {
    this.points_ = points;
    for (let i = 1; i < points.length; ++i) {
      this.ways_.push(this.ways_[i - 1]! + length(sub(points[i]!, points[i - 1]!)));
    }
  }

  get end(): Vec {
    return this.points_[this.points_.length - 1]!;
  }

  /** How far along the way the hand has come, m; it never goes back. */
  get done_m(): number {
    return this.done_m_;
  }

  /** The place `lead_m` ahead of the hand, which is at `hand`. */
  next(hand: Vec, lead_m: number): Vec {
    // Not farther ahead than two leads: another part of the way may pass close by.
    const last_m = this.done_m_ + 2 * lead_m;
    let nearest = Infinity;
    let come_m = this.done_m_;
    for (let i = 1; i < this.points_.length && this.ways_[i - 1]! <= last_m; ++i) {
      const at_m = Math.min(last_m, Math.max(this.done_m_, this.along(i, hand)));
      const off = length(sub(hand, this.at(at_m)));
      if (off < nearest) {
        nearest = off;
        come_m = at_m;
      }
    }
    this.done_m_ = come_m;
    return this.at(this.done_m_ + lead_m);
  }

  /** The way up to the point of segment `i` that is nearest to `hand`. */
  private along(i: number, hand: Vec): number {
    const [a, b] = [this.points_[i - 1]!, this.points_[i]!];
    const segment = sub(b, a);
    const size = length(segment);
    const offset = sub(hand, a);
    const share = size > 0 ? (offset.x * segment.x + offset.y * segment.y + offset.z * segment.z) / size ** 2 : 0;
    return this.ways_[i - 1]! + Math.min(1, Math.max(0, share)) * size;
  }

  private at(way_m: number): Vec {
    const i = this.ways_.findIndex((way) => way >= way_m);
    if (i < 0) {
      return this.end;
    }
    if (i === 0) {
      return this.points_[0]!;
    }
    const [from, to] = [this.ways_[i - 1]!, this.ways_[i]!];
    return mix(this.points_[i - 1]!, this.points_[i]!, to > from ? (way_m - from) / (to - from) : 1);
  }
}

/** Moved by `distance_m` along the unit vector. */
export function beside(point: Vec, direction: Vec, distance_m: number): Vec {
  return add(point, scale(direction, distance_m));
}
