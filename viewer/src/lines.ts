// Lines through places, from which marks are drawn: circles, balls, arrows.

import { add, cross, dot, length, scale, sub, unit, type Vec } from "./vec";

/** From place to place. */
export type Line = readonly Vec[];

const kCircleParts = 48;
/** Of an arrow: its head is so long, as a part of the whole, and half as wide. */
const kHead = 0.3;

/** Two unit vectors across `axis` and each other: with it right-handed. The first lies along `toward`, if that can be. */
export function across(axis: Vec, toward: Vec = { x: 0, y: 0, z: 0 }): readonly [Vec, Vec] {
  const along = unit(axis);
  const flat = sub(toward, scale(along, dot(toward, along)));
  const kSmall = 1e-6;
  const other = Math.abs(along.x) < 0.6 ? { x: 1, y: 0, z: 0 } : { x: 0, y: 1, z: 0 };
  const first = length(flat) > kSmall * length(toward) && length(flat) > 0 ? unit(flat) : unit(cross(other, along));
  return [first, cross(along, first)];
}

/** About `centre` from angle `from` to `to`, rad, where `first` is 0 and `second` a quarter of a turn. */
export function arc(centre: Vec, [first, second]: readonly [Vec, Vec], radius: number, from: number, to: number): Line {
  const parts = Math.max(1, Math.ceil((kCircleParts * Math.abs(to - from)) / (2 * Math.PI)));
  return Array.from({ length: parts + 1 }, (_, i) => {
    const angle = from + ((to - from) * i) / parts;
    return add(centre, add(scale(first, radius * Math.cos(angle)), scale(second, radius * Math.sin(angle))));
  });
}

export function circle(centre: Vec, axis: Vec, radius: number): Line {
  return arc(centre, across(axis), radius, 0, 2 * Math.PI);
}

export function ball(centre: Vec, radius: number): Line[] {
  return kAxes.map((axis) => circle(centre, axis, radius));
}

export function crossAt(centre: Vec, half: number): Line[] {
  return kAxes.map((axis) => both(centre, scale(axis, half)));
}

/** To both sides of `centre`. */
export function both(centre: Vec, half: Vec): Line {
  return [sub(centre, half), add(centre, half)];
}

export function square(centre: Vec, normal: Vec, half: number): Line {
  const [u, v] = across(normal);
  return [[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]].map(([a, b]) =>
    add(centre, add(scale(u, a! * half), scale(v, b! * half))));
}

export function arrow(from: Vec, to: Vec): Line[] {
  const way = sub(to, from);
  const [u] = across(way);
  const neck = sub(to, scale(way, kHead));
  const side = scale(u, (kHead / 2) * length(way));
  return [[from, to], [add(neck, side), to, sub(neck, side)]];
}

const kAxes: readonly Vec[] = [{ x: 1, y: 0, z: 0 }, { x: 0, y: 1, z: 0 }, { x: 0, y: 0, z: 1 }];
