// Triangles end up facing where their normals point, whichever way the file wound them.
import { expect, test } from "vitest";
import { orientTowardNormals } from "../src/winding";

const kPositions = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0);

test("a triangle against its normals is turned, one along them is kept", () => {
  const up = Float32Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1);
  const triangles = Uint32Array.of(0, 1, 2, 0, 2, 1);
  orientTowardNormals(kPositions, up, triangles);
  expect(Array.from(triangles)).toEqual([0, 1, 2, 0, 1, 2]);
});

test("without any direction nothing changes", () => {
  const triangles = Uint32Array.of(0, 2, 1);
  orientTowardNormals(kPositions, new Float32Array(9), triangles);
  expect(Array.from(triangles)).toEqual([0, 2, 1]);
});
