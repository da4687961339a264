// Rays against placed meshes: where they are, however long the ray's direction is.
import { expect, test } from "vitest";
import { ModelView } from "../src/model_view";
import type { Layout, Mesh } from "../src/scene_messages";

/** A square of side 2 in the plane z = 0. */
const kSquare: Mesh = {
  number: 1,
  positions: Float32Array.of(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0),
  normals: undefined,
  triangles: Uint32Array.of(0, 1, 2, 0, 2, 3),
  segments: new Uint32Array(),
  points: new Uint32Array(),
  texcoords: undefined,
  looks: [],
  triangleMaterials: Uint16Array.of(3, 4),
  bounds: { min: { x: -1, y: -1, z: 0 }, max: { x: 1, y: 1, z: 0 } },
};

/** Squares at these heights, the second one twice as large. */
function model(heights: number[]): ModelView {
  const poses = Float32Array.from(heights.flatMap((z, i) => [1 + i, 0, 0, 0, 0, 1 + i, 0, 0, 0, 0, 1 + i, z]));
  const placed = heights.map(() => ({ mesh: 1 })) as unknown as Layout["placed"];
  const view = new ModelView();
  view.add(kSquare);
  view.setLayout({ number: 1, name: "", bounds: undefined, proxyRadius_m: 1, worldPerDevice: 1, placed, poses }, poses);
  return view;
}

test("the nearest of several places, and which it is", () => {
  const view = model([0, 2]);
  const down = view.cast({ x: 0.5, y: 0.5, z: 9 }, { x: 0, y: 0, z: -1 })!;
  expect(down.object).toBe(1);
  expect(down.material).toBe(3);
  expect(down.distance).toBeCloseTo(7, 6);
  expect(down.point.z).toBeCloseTo(2, 6);
  expect(Math.abs(down.normal.z)).toBeCloseTo(1, 6);
  const up = view.cast({ x: 0.5, y: 0.5, z: -1 }, { x: 0, y: 0, z: 1 })!;
  expect(up.object).toBe(0);
  expect(view.cast({ x: 1.5, y: 0, z: -1 }, { x: 0, y: 0, z: 1 })!.object).toBe(1);
});

test("a segment meets what lies on it, whether it is short or long, and nothing beyond its end", () => {
  const view = model([0]);
  for (const size of [0.01, 1, 1000]) {
    const from = { x: 0.2, y: 0.1, z: 100 };
    const direction = { x: 0, y: 0, z: -size };
    expect(view.cast(from, direction, 101 / size)?.distance).toBeCloseTo(100 / size, 6);
    expect(view.cast(from, direction, 99 / size)).toBeUndefined();
  }
});

test("points that are not accepted are looked through, in the world's frame", () => {
  const view = model([0, 2]);
  const seen = view.cast({ x: 0, y: 0.1, z: 9 }, { x: 0, y: 0, z: -1 }, Infinity, ({ z }) => z < 1)!;
  expect(seen.object).toBe(0);
});
