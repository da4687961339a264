// The page without a server: names of scenes, quantities of the engine, and files as triangles.
import { describe, expect, test, vi } from "vitest";
import { readMesh } from "../src/local/mesh_file";
import { parseQuantities } from "../src/local/quantities";
import { pickableScenes } from "../src/local/scene_names";

test("scenes that need a number get one", () => {
  expect(pickableScenes("teapot[:N], walker, terrain:N, rough:N[:MEMBER]")).toEqual(
    ["teapot", "walker", "terrain:10000", "rough:10000"]);
});

test("quantities have their fields as in messages", () => {
  expect(parseQuantities("viscosity_Ns_m\tviscosity\tN s/m\t20\t0\tdrag\nstiffness\tstiffness\t\t1\t1\tspring\n")).toEqual([
    { field: "viscosityNsM", name: "viscosity", unit: "N s/m", usual: 20, otherwise: 0, words: "drag" },
    { field: "stiffness", name: "stiffness", unit: "", usual: 1, otherwise: 1, words: "spring" },
  ]);
});

describe("a file as triangles", () => {
  const bytes = (text: string) => new TextEncoder().encode(text).buffer as ArrayBuffer;

  test("OBJ: polygons are cut into triangles; lines and the material library are left out", () => {
    const mesh = readMesh(".obj", bytes("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4\nl 1 2\n"));
    expect(mesh.triangles.length).toBe(6);
    expect(mesh.positions.length % 3).toBe(0);
    expect(Math.max(...mesh.triangles)).toBeLessThan(mesh.positions.length / 3);
    expect(Math.max(...mesh.positions)).toBe(1);
  });

  test("STL and PLY", () => {
    const stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    expect([...readMesh(".stl", bytes(stl)).positions]).toEqual([0, 0, 0, 2, 0, 0, 0, 1, 0]);
    const ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0\n0 1 0\n3 0 1 2\n";
    const mesh = readMesh(".ply", bytes(ply));
    expect([...mesh.triangles]).toEqual([0, 1, 2]);
    expect(mesh.positions[3]).toBe(3);
  });

  test.each([
    [".obj", "hello", "there is no triangle in it"],
    [".obj", "", "there is no triangle in it"],
    [".obj", "v 0 0 0\nv 1 0 0\nv 0 x 0\nf 1 2 3\n", "a vertex of it is no number"],
    [".obj", "v 0 0 0\nf 1 2 3\n", "a vertex of it is no number"],
    [".stl", "solid x\n", "it cannot be understood"],
  ])("that is none is refused in a line: %s %j", (ending, content, line) => {
    expect(() => readMesh(ending, bytes(content))).toThrow(line);
  });

  test("of random bytes is triangles or an error", () => {
    vi.spyOn(console, "warn").mockImplementation(() => undefined); // what a reader does not know, line by line
    vi.spyOn(console, "error").mockImplementation(() => undefined);
    let seed = 1;
    const random = () => (seed = (seed * 48271) % 2147483647);
    for (let i = 0; i < 60; ++i) {
      const content = Uint8Array.from({ length: random() % 400 }, () => random() % 256);
      for (const ending of [".obj", ".stl", ".ply"]) {
        try {
          const mesh = readMesh(ending, content.buffer);
          expect(mesh.triangles.every((corner) => corner < mesh.positions.length / 3)).toBe(true);
        } catch (error) {
          expect(error).toBeInstanceOf(Error);
        }
      }
    }
  });
});
