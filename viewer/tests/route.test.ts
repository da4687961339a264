// The hand's way around a ball that is in between, and how a walk leads it there.
import { expect, test } from "vitest";
import { placesAround, route, Walk } from "../src/route";
import { dot, length, scale, sub, type Vec } from "../src/vec";

const kBounds = { min: { x: -1, y: -1, z: -1 }, max: { x: 1, y: 1, z: 1 } };

/** Whether the segment keeps out of the unit ball. */
function outsideBall(a: Vec, b: Vec): boolean {
  const way = sub(b, a);
  const t = Math.min(1, Math.max(0, -dot(a, way) / dot(way, way)));
  return length({ x: a.x + t * way.x, y: a.y + t * way.y, z: a.z + t * way.z }) >= 1;
}

test("straight where nothing is in between", () => {
  const [a, b] = [{ x: -2, y: 2, z: 0 }, { x: 2, y: 2, z: 0 }];
  expect(route(a, b, placesAround(kBounds, 0.2), outsideBall)).toEqual([a, b]);
});

test("around what is in between, and not much longer than need be", () => {
  const [a, b] = [{ x: -1.1, y: 0, z: 0.1 }, { x: 1.1, y: 0.1, z: 0 }];
  const way = route(a, b, placesAround(kBounds, 0.2), outsideBall);
  expect(way[0]).toEqual(a);
  expect(way.at(-1)).toEqual(b);
  const legs = way.slice(1).map((point, i) => [way[i]!, point] as const);
  expect(legs.every(([from, to]) => outsideBall(from, to))).toBe(true);
  expect(legs.reduce((sum, [from, to]) => sum + length(sub(to, from)), 0)).toBeLessThan(5);
});

test("straight when there is no way at all", () => {
  const [a, b] = [{ x: 0, y: 0, z: 0 }, { x: 2, y: 0, z: 0 }];
  expect(route(a, b, placesAround(kBounds, 0.2), () => false)).toEqual([a, b]);
});

test("a walk leads ahead of the hand, stops at its end, and never goes back", () => {
  const walk = new Walk([{ x: 0, y: 0, z: 0 }, { x: 1, y: 0, z: 0 }, { x: 1, y: 1, z: 0 }]);
  expect(walk.next({ x: 0, y: 0, z: 0 }, 0.3)).toEqual({ x: 0.3, y: 0, z: 0 });
  expect(walk.next({ x: 0.5, y: 0.1, z: 0 }, 0.3).x).toBeCloseTo(0.8, 12);
  expect(walk.done_m).toBeCloseTo(0.5, 12);
  expect(walk.next({ x: 0.2, y: 0, z: 0 }, 0.3).x).toBeCloseTo(0.8, 12);
  const round = walk.next({ x: 0.95, y: 0, z: 0 }, 0.3);
  expect(round.x).toBeCloseTo(1, 12);
  expect(round.y).toBeCloseTo(0.25, 12);
  expect(walk.next({ x: 1, y: 0.5, z: 0 }, 0.3).y).toBeCloseTo(0.8, 12);
  expect(walk.next({ x: 1, y: 0.9, z: 0 }, 0.3)).toEqual(walk.end);
  expect(scale(walk.end, 1)).toEqual({ x: 1, y: 1, z: 0 });
});
