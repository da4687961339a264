// The judge of the end-to-end test is judged by hand-made cases: over the face, beside an edge, beyond a corner.
import { expect, test } from "vitest";
import { distanceToTriangles } from "../test-support/closest_point";

const kPositions = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0);
const kTriangles = Uint32Array.of(0, 1, 2);

test.each([
  [{ x: 0.2, y: 0.2, z: 0.5 }, 0.5],
  [{ x: 0.2, y: 0.2, z: -0.5 }, 0.5],
  [{ x: 0.5, y: -3, z: 4 }, 5],
  [{ x: -3, y: -4, z: 0 }, 5],
  [{ x: 1, y: 1, z: 0 }, Math.SQRT1_2],
  [{ x: 0.2, y: 0.3, z: 0 }, 0],
])("%o is %f away", (point, distance) => {
  expect(distanceToTriangles(point, kPositions, kTriangles)).toBeCloseTo(distance, 12);
});

test("a degenerate triangle is its longest edge", () => {
  const line = Float32Array.of(0, 0, 0, 1, 0, 0, 2, 0, 0);
  expect(distanceToTriangles({ x: 1.5, y: 2, z: 0 }, line, kTriangles)).toBeCloseTo(2, 12);
});
