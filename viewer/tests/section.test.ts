import { expect, test } from "vitest";
import { keeps, sectionOf } from "../src/section";

const kBounds = { min: { x: -1, y: 0, z: 2 }, max: { x: 3, y: 1, z: 4 } };

test("takes away the share that is asked for, from the side that is asked for", () => {
  const right = sectionOf("right", 0.25, kBounds)!;
  expect(keeps(right, { x: 1.9, y: 0, z: 0 })).toBe(true);
  expect(keeps(right, { x: 2.1, y: 0, z: 0 })).toBe(false);
  const below = sectionOf("below", 0.5, kBounds)!;
  expect(keeps(below, { x: 0, y: 0.6, z: 0 })).toBe(true);
  expect(keeps(below, { x: 0, y: 0.4, z: 0 })).toBe(false);
  const front = sectionOf("front", 0, kBounds)!;
  expect(keeps(front, { x: 0, y: 0, z: 4 })).toBe(true);
});

test("takes nothing away when it is off, or where there is nothing", () => {
  expect(sectionOf("off", 0.5, kBounds)).toBeUndefined();
  expect(sectionOf("left", 0.5, undefined)).toBeUndefined();
});
