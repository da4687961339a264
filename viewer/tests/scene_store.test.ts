// The scene as the page knows it: layouts replace each other, moves are differences from them, and missed ones do no harm.
import { create } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { PlacedMeshSchema } from "../src/gen/hl_pb";
import { kPoseNumbers, type Layout, type Mesh, type Moves } from "../src/scene_messages";
import { SceneStore } from "../src/scene_store";

/** Poses that shift along x. */
function poses(...xs: number[]): Float32Array {
  return Float32Array.from(xs.flatMap((x) => [1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0]));
}

function layout(number: number, meshes: number[], ...xs: number[]): Layout {
  const placed = meshes.map((mesh) => create(PlacedMeshSchema, { mesh }));
  return { number, name: "", bounds: undefined, proxyRadius_m: 0.001, worldPerDevice: 1, placed, poses: poses(...xs) };
}

function moves(number: number, indices: number[], ...xs: number[]): Moves {
  return { layout: number, indices, poses: poses(...xs) };
}

function mesh(number: number, triangles: number, points = 0): Mesh {
  return {
    number, positions: new Float32Array(9), normals: undefined, triangles: new Uint32Array(3 * triangles),
    segments: new Uint32Array(), points: new Uint32Array(points), texcoords: undefined, looks: [], triangleMaterials: new Uint16Array(), bounds: undefined,
  };
}

function xs(store: SceneStore): number[] {
  return Array.from({ length: store.poses.length / kPoseNumbers }, (_, i) => store.poses[kPoseNumbers * i + 3]!);
}

describe("moves", () => {
  test("put objects elsewhere until a state no longer names them", () => {
    const store = new SceneStore();
    store.setLayout(layout(1, [1, 1, 1], 0, 10, 20));
    expect([...store.move(moves(1, [1, 2], 11, 21))]).toEqual([1, 2]);
    expect(xs(store)).toEqual([0, 11, 21]);
    expect([...store.move(moves(1, [0, 2], 5, 22))].sort()).toEqual([0, 1, 2]);
    expect(xs(store)).toEqual([5, 10, 22]);
    expect([...store.move(moves(1, []))].sort()).toEqual([0, 2]);
    expect(xs(store)).toEqual([0, 10, 20]);
    expect(store.move(moves(1, []))).toEqual([]);
  });

  test("of another layout, or of objects that it has not, change nothing", () => {
    const store = new SceneStore();
    expect(store.move(moves(1, [0], 3))).toEqual([]);
    store.setLayout(layout(2, [1], 0));
    expect(store.move(moves(1, [0], 3))).toEqual([]);
    expect(store.move(moves(2, [1], 3))).toEqual([]);
    expect(xs(store)).toEqual([0]);
  });

  test("begin anew with each layout, and leave the layout itself alone", () => {
    const store = new SceneStore();
    const first = layout(1, [1], 0);
    store.setLayout(first);
    store.move(moves(1, [0], 9));
    expect(first.poses[3]).toBe(0);
    store.setLayout(layout(2, [1, 1], 4, 5));
    expect(xs(store)).toEqual([4, 5]);
    expect(store.move(moves(2, []))).toEqual([]);
  });
});

test("what is there is counted as often as it is placed; meshes can be forgotten", () => {
  const store = new SceneStore();
  store.add(mesh(1, 100));
  store.add(mesh(2, 5, 3));
  expect(store.counts()).toEqual({ objects: 0, triangles: 0, segments: 0, points: 0 });
  store.setLayout(layout(1, [1, 2, 1], 0, 0, 0));
  expect(store.counts()).toEqual({ objects: 3, triangles: 205, segments: 0, points: 3 });
  store.setLayout(layout(2, [1], 0));
  store.forget([2]);
  expect([...store.meshes.keys()]).toEqual([1]);
  store.clear();
  expect(store.counts().objects).toBe(0);
  expect(store.layout).toBeUndefined();
});

test("a cloud counts by its points, not by the discs that are drawn", () => {
  const store = new SceneStore();
  store.add({ ...mesh(1, 4000), cloudPoints: 7000 });
  store.add(mesh(2, 12));
  expect(store.ahead()).toEqual({ triangles: 12, points: 7000 });
  store.setLayout(layout(1, [1, 1, 2], 0, 1, 2));
  expect(store.counts()).toEqual({ objects: 3, triangles: 12, segments: 0, points: 14_000 });
  expect(store.ahead()).toEqual({ triangles: 0, points: 0 });
});
