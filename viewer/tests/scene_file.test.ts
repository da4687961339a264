// The scene as a scene file: geometry where it is now, materials as they are felt now.
import { create } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { BodySchema, PlacedMeshSchema, SurfaceImageSchema } from "../src/gen/hl_pb";
import type { Mesh } from "../src/scene_messages";
import { sceneFile } from "../src/scene_file";
import { SceneStore } from "../src/scene_store";

const kMaterial = { stiffness: 1, staticFriction: 0.5, dynamicFriction: 0.3, viscosityNsM: 0, smooth: true };
const kTurned = Float32Array.of(0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30);

function meshOf(change: Partial<Mesh> = {}): Mesh {
  return {
    number: 1,
    positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0.1, 1, 0),
    normals: Float32Array.of(1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0),
    triangles: Uint32Array.of(0, 1, 2, 3, 2, 1),
    segments: new Uint32Array(), points: new Uint32Array(), texcoords: undefined, looks: [],
    triangleMaterials: new Uint16Array(), bounds: undefined, ...change,
  };
}

function storeOf(mesh: Mesh, materials: object[], pose: Float32Array = kTurned): SceneStore {
  const store = new SceneStore();
  store.add(mesh);
  const placed = [create(PlacedMeshSchema, { mesh: 1, materials })];
  const scale = { bounds: undefined, proxyRadius_m: 1, worldPerDevice: 1 };
  store.setLayout({ number: 1, name: "a", ...scale, placed, poses: pose });
  return store;
}

const parsed = async (...args: Parameters<typeof sceneFile>) =>
  JSON.parse(await (await sceneFile(...args)).content.text());

describe("a scene file", () => {
  test("has every object where it is now, in the world", async () => {
    const { objects } = await parsed(storeOf(meshOf(), [kMaterial]), {});
    expect(objects).toHaveLength(1);
    expect(objects[0].primitives).toEqual({
      vertices: [10, 20, 30, 10, 21, 30, 9, 20, 30, 9, 20.1, 30],
      normals: [0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0],
      triangles: [0, 1, 2, 3, 2, 1],
    });
  });

  test("has the scene's materials, and over them what the user has set", async () => {
    const over = { staticFriction: 0.9, adhesionN: 2, smooth: false };
    const { objects } = await parsed(storeOf(meshOf(), [kMaterial]), over);
    expect(objects[0].material).toEqual({
      stiffness: 1, staticFriction: 0.9, dynamicFriction: 0.3, viscosityNsM: 0, adhesionN: 2, shade: "FLAT",
    });
  });

  test("parts a mesh by its materials, with the vertices that each part uses", async () => {
    const mesh = meshOf({ triangleMaterials: Uint16Array.of(0, 1), points: Uint32Array.of(3) });
    const { objects } = await parsed(storeOf(mesh, [kMaterial, { ...kMaterial, stiffness: 0.5 }]), {});
    expect(objects).toMatchObject([
      { primitives: { triangles: [0, 1, 2], points: [3] }, material: { stiffness: 1 } },
      { primitives: { triangles: [2, 1, 0] }, material: { stiffness: 0.5 } },
    ]);
    expect(objects[1].primitives.vertices).toHaveLength(9);
  });

  test("has a body in its own frame, whole, with its first material", async () => {
    const store = storeOf(meshOf({ triangleMaterials: Uint16Array.of(0, 1) }), [kMaterial, kMaterial]);
    Object.assign(store.layout!.placed[0]!, {
      body: create(BodySchema, { massKg: 0.2 }), start: new Uint8Array(kTurned.buffer),
    });
    Object.assign(store.layout!, { mechanics: { gravity_m_s2: { x: 0, y: 0, z: -1 }, joints: [] } });
    const { content, lacking } = await sceneFile(store, {});
    const { objects, gravityMS2 } = JSON.parse(await content.text());
    expect(gravityMS2).toEqual({ x: 0, y: 0, z: -1 });
    expect(objects).toMatchObject([{
      name: "object 1", body: { massKg: 0.2 }, transform: { degrees: 90, translate: { x: 10, y: 20, z: 30 } },
      primitives: { vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0.100000001, 1, 0], triangles: [0, 1, 2, 3, 2, 1] },
    }]);
    expect(lacking).toMatch(/only their first one/);
  });

  test("calls objects as their scene does, no two the same, each with its colour", async () => {
    const store = storeOf(meshOf(), [kMaterial]);
    const placed = ["lid", "", "lid", "object 2"].map((label) =>
      create(PlacedMeshSchema, { mesh: 1, materials: [kMaterial], label, colour: Uint8Array.of(1, 2, 3) }));
    store.setLayout({ ...store.layout!, placed, poses: Float32Array.from(placed.flatMap(() => [...kTurned])) });
    const { content, lacking } = await sceneFile(store, {});
    const { objects } = JSON.parse(await content.text()) as { objects: { name: string; colour: number[] }[] };
    expect(objects.map(({ name }) => name)).toEqual(["lid", "object 2", "lid 2", "object 2 2"]);
    expect(objects.map(({ colour }) => colour)).toEqual(Array(4).fill([1, 2, 3]));
    expect(lacking).toBeUndefined();
  });

  test("has the colours of the vertices that it has, and says that pictures are not in it", async () => {
    const colours = Uint8Array.of(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12);
    const image = create(SurfaceImageSchema, { file: Uint8Array.of(0x89) });
    const mesh = meshOf({ colours, triangles: Uint32Array.of(0, 2, 3), looks: [{ image, runs: [] }] });
    const { content, lacking } = await sceneFile(storeOf(mesh, [kMaterial]), {});
    expect(JSON.parse(await content.text()).objects[0].primitives.colours).toEqual([1, 2, 3, 7, 8, 9, 10, 11, 12]);
    expect(lacking).toBe("The file has no pictures.");
  });

  test("says that textures are not in it, unless the user has set a number in their place", async () => {
    const { stiffness: _, ...unset } = kMaterial;
    expect((await sceneFile(storeOf(meshOf(), [unset]), {})).lacking).toMatch(/no textures/);
    expect((await sceneFile(storeOf(meshOf(), [unset]), { stiffness: 0.4 })).lacking).toBeUndefined();
  });

  test("is refused in one line for a scene that is empty or not known", async () => {
    await expect(sceneFile(new SceneStore(), {})).rejects.toThrow("There is nothing to save yet");
    await expect(sceneFile(storeOf(meshOf(), []), {})).rejects.toThrow("was not told all");
  });
});
