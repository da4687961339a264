// The camera is fitted to what it would show badly, and left alone otherwise.
import { expect, test } from "vitest";
import { diagonalOf, needsFit } from "../src/fit";
import type { Bounds } from "../src/scene_messages";

function cube(side: number, x = 0): Bounds {
  return { min: { x: x - side / 2, y: -side / 2, z: -side / 2 }, max: { x: x + side / 2, y: side / 2, z: side / 2 } };
}

test("the first scene is fitted, the same one again is not", () => {
  expect(needsFit(undefined, cube(1))).toBe(true);
  expect(needsFit(cube(1), cube(1))).toBe(false);
  expect(needsFit(cube(1), cube(1.3, 0.2))).toBe(false);
});

test("another size or another place is", () => {
  expect(needsFit(cube(1), cube(3))).toBe(true);
  expect(needsFit(cube(1), cube(0.3))).toBe(true);
  expect(needsFit(cube(1), cube(1, 2))).toBe(true);
});

test("a single point has a size", () => {
  expect(diagonalOf(cube(0))).toBeGreaterThan(0);
  expect(needsFit(cube(0), cube(0))).toBe(false);
});
