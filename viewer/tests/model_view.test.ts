// Rays against placed meshes: where they are, however long the ray's direction is.
import * as THREE from "three";
import { expect, test } from "vitest";
import { MeshView, type Palette } from "../src/mesh_view";
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

test("colours of vertices are drawn as a screen shows them, in the place of the model's colour", () => {
  const palette = {
    model: new THREE.Color(0.2, 0.3, 0.4), tint: new THREE.Color(), pointed: new THREE.Color(),
  } as unknown as Palette;
  const colours = Uint8Array.of(0, 128, 255, 1, 2, 3, 4, 5, 6, 7, 8, 9);
  const drawn = (mesh: Mesh) => {
    const view = new MeshView(mesh, palette);
    view.setCount(1);
    return view.group.children[0] as THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial[]>;
  };
  const coloured = drawn({ ...kSquare, colours });
  expect(coloured.material[0]!.vertexColors).toBe(true);
  expect(coloured.material[0]!.color.getHex()).toBe(0xffffff);
  const shown = new THREE.Color().fromBufferAttribute(coloured.geometry.getAttribute("color"), 0);
  expect(shown.getHexString(THREE.SRGBColorSpace)).toBe("0080ff");
  const plain = drawn(kSquare);
  expect(plain.material[0]!.vertexColors).toBe(false);
  expect(plain.material[0]!.color.equals(palette.model)).toBe(true);
});

test("an object has the colour of its file, unless it is touched", () => {
  const palette = {
    model: new THREE.Color(0.2, 0.25, 0.4), tint: new THREE.Color(2, 1, 1), pointed: new THREE.Color(1, 2, 1),
  } as unknown as Palette;
  const view = new MeshView(kSquare, palette);
  view.setCount(2);
  const surface = view.group.children[0] as THREE.InstancedMesh<THREE.BufferGeometry, THREE.MeshStandardMaterial[]>;
  const seen = (place: number) => {
    const factor = new THREE.Color();
    surface.getColorAt(place, factor);
    return factor.multiply(surface.material[0]!.color).getHexString(THREE.SRGBColorSpace);
  };
  view.setColour(1, new THREE.Color(0xc01020));
  expect(seen(0)).toBe(palette.model.getHexString());
  expect(seen(1)).toBe("c01020");
  view.setMark(1, "touched");
  expect(seen(1)).toBe(palette.model.clone().multiply(palette.tint).getHexString());
  view.setMark(1, "none");
  palette.model.setRGB(0.8, 0.7, 0.6);
  view.applyTheme();
  expect(seen(1)).toBe("c01020");
  view.setColour(1, undefined);
  expect(seen(1)).toBe(palette.model.getHexString());
});
