// The lines that show a snap or a force field, in the frame of its object. Snaps: the place, and from where it takes the
// proxy. Fields: the region, and what they do there.

import type { FieldPlace, Place, SnapPlace } from "./felt_places";
import { FieldKind } from "./gen/hl_pb";
import { across, arrow, ball, both, circle, crossAt, square, type Line } from "./lines";
import { add, mix, scale, sub, unit, type Vec } from "./vec";

/** `size_m`: half the side of the square that stands for a plane. */
export function snapLines(place: SnapPlace, size_m: number): Line[] {
  const { snap, points, normal } = place;
  const [first, last] = [points[0]!, points.at(-1)!];
  if (normal !== undefined) {
    const taken = scale(unit(normal), snap.capture);
    return [square(first, normal, size_m), square(first, normal, size_m / 2), both(first, taken)];
  }
  if (points.length === 1) {
    return [...ball(first, snap.capture), ...crossAt(first, snap.capture)];
  }
  return [points, ...crossAt(first, snap.capture), ...crossAt(last, snap.capture)];
}

export function fieldLines(place: FieldPlace, size_m: number): Line[] {
  return [...regionLines(place, size_m), ...actLines(place, size_m)];
}

function regionLines({ field, points, normal }: FieldPlace, size_m: number): Line[] {
  const { reach } = field;
  if (normal !== undefined) {
    const up = scale(unit(normal), reach);
    const [top, bottom] = [1, -1].map((side) => square(add(points[0]!, scale(up, side)), normal, size_m));
    return [top!, bottom!, ...top!.slice(1).map((corner, i) => [corner, bottom![i + 1]!])];
  }
  const balls = points.flatMap((point) => ball(point, reach));
  const tubes = points.slice(1).flatMap((point, i) => tubeLines(points[i]!, point, reach));
  return points.length === 1 ? balls : [points, ...balls, ...tubes];
}

function tubeLines(from: Vec, to: Vec, radius: number): Line[] {
  const sides = across(sub(to, from)).flatMap((side) => [scale(side, radius), scale(side, -radius)]);
  return sides.map((side) => [add(from, side), add(to, side)]);
}

/** Arrows of a pull or push; of a drag circles or squares within each other. */
function actLines(place: FieldPlace, size_m: number): Line[] {
  const { field, points, normal } = place;
  const middle = middleOf(place);
  if (field.kind === FieldKind.CONSTANT) {
    const half = scale(unit(field.direction ?? kUp), field.reach / 2);
    return arrow(sub(middle, half), add(middle, half));
  }
  if (field.kind === FieldKind.DRAG) {
    const inner = [1 / 3, 2 / 3];
    return normal !== undefined
      ? inner.map((part) => square(points[0]!, normal, part * size_m))
      : inner.flatMap((part) => [kRight, kUp].map((axis) => circle(middle, axis, part * field.reach)));
  }
  return sidesOf(place).flatMap((side) =>
    arrow(add(middle, scale(side, field.reach)), add(middle, scale(side, field.reach / 3))));
}

/** Unit vectors to where a pull comes from. */
function sidesOf({ points, normal }: Place): Vec[] {
  if (normal !== undefined) {
    return [unit(normal), scale(unit(normal), -1)];
  }
  const axis = points.length > 1 ? sub(points[1]!, points[0]!) : kUp;
  const [u, v] = across(axis);
  const sides = points.length > 1 ? [u, v] : [u, v, kUp];
  return sides.flatMap((side) => [side, scale(side, -1)]);
}

/** Of its middle part. */
function middleOf({ points }: Place): Vec {
  const i = Math.floor((points.length - 1) / 2);
  return points.length % 2 === 1 ? points[i]! : mix(points[i]!, points[i + 1]!, 0.5);
}

const kUp: Vec = { x: 0, y: 1, z: 0 };
const kRight: Vec = { x: 1, y: 0, z: 0 };
