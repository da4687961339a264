// The tree against asking every triangle, on random soups, and on meshes that cannot be split.
import { expect, test } from "vitest";
import { RayTree } from "../src/ray_tree";
import type { Vec } from "../src/vec";

/** Numbers 0..1 that are the same in every run. */
function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

function soup(count: number, random: () => number): [Float32Array, Uint32Array] {
  const positions: number[] = [];
  for (let i = 0; i < count; ++i) {
    const centre = [random(), random(), random()];
    for (let corner = 0; corner < 3; ++corner) {
      positions.push(...centre.map((value) => value + 0.1 * (random() - 0.5)));
    }
  }
  return [Float32Array.from(positions), Uint32Array.from({ length: 3 * count }, (_, i) => i)];
}

/** One triangle at a time: a tree of one leaf asks it without any box but its own. */
function nearest(positions: Float32Array, triangles: Uint32Array, origin: Vec, direction: Vec): number {
  let best = Infinity;
  for (let i = 0; i < triangles.length; i += 3) {
    const alone = new RayTree(positions, triangles.slice(i, i + 3));
    best = Math.min(best, alone.cast(origin, direction, Infinity)?.distance ?? Infinity);
  }
  return best;
}

test("finds the nearest triangle of random soups", () => {
  const random = randomNumbers(7);
  const [positions, triangles] = soup(400, random);
  const tree = new RayTree(positions, triangles);
  let met = 0;
  for (let i = 0; i < 200; ++i) {
    const origin = { x: 3 * random() - 1, y: 3 * random() - 1, z: 3 * random() - 1 };
    const to = { x: random(), y: random(), z: random() };
    const direction = { x: to.x - origin.x, y: to.y - origin.y, z: to.z - origin.z };
    const expected = nearest(positions, triangles, origin, direction);
    const hit = tree.cast(origin, direction, Infinity);
    expect(hit?.distance ?? Infinity).toBe(expected);
    met += hit === undefined ? 0 : 1;
  }
  expect(met).toBeGreaterThan(40);
});

test("a ray along an axis, from either side, and no farther than asked", () => {
  const positions = Float32Array.of(-1, -1, 0, 1, -1, 0, 0, 1, 0);
  const tree = new RayTree(positions, Uint32Array.of(0, 1, 2));
  const down = { x: 0, y: 0, z: -1 };
  expect(tree.cast({ x: 0, y: 0, z: 2 }, down, Infinity)).toMatchObject({ distance: 2, triangle: 0 });
  expect(tree.cast({ x: 0, y: 0, z: -2 }, { x: 0, y: 0, z: 1 }, Infinity)?.distance).toBe(2);
  expect(tree.cast({ x: 0, y: 0, z: 2 }, down, 1.9)).toBeUndefined();
  expect(tree.cast({ x: 2, y: 0, z: 2 }, down, Infinity)).toBeUndefined();
});

test("triangles that are all alike do not stop it, and what is not accepted is looked through", () => {
  const positions = Float32Array.of(-1, -1, 0, 1, -1, 0, 0, 1, 0, -1, -1, -1, 1, -1, -1, 0, 1, -1);
  const many = Uint32Array.from({ length: 300 }, (_, i) => i % 3);
  const tree = new RayTree(positions, Uint32Array.from([...many, 3, 4, 5]));
  const [from, down] = [{ x: 0, y: 0, z: 2 }, { x: 0, y: 0, z: -1 }];
  expect(tree.cast(from, down, Infinity)?.distance).toBe(2);
  expect(tree.cast(from, down, Infinity, ({ z }) => z < -0.5)?.distance).toBe(3);
});

test("of no triangles nothing is met", () => {
  const tree = new RayTree(new Float32Array(), new Uint32Array());
  expect(tree.cast({ x: 0, y: 0, z: 0 }, { x: 1, y: 0, z: 0 }, Infinity)).toBeUndefined();
});
