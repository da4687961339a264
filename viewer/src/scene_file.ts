// The scene as a scene file (docs/scene-files.md): everything where it is now, with the materials that are felt now.
// The geometry is in the file, so that it opens by itself.

import { bodyJson, mechanicsJson, transformJson } from "./saved_bodies";
import { placesJson } from "./saved_places";
import { kPoseNumbers, type Layout, type Mesh } from "./scene_messages";
import type { SceneStore } from "./scene_store";
import type { SurfaceSettings } from "./surfaces";

/** What hl takes of a scene file, bytes and objects (src/io/load_scene_file.cpp). */
const kMaxBytes = 64 * 2 ** 20;
const kMaxObjects = 60_000;
/** Numbers in one piece of text: a piece takes a few milliseconds. */
const kPiece = 20_000;
/** A float's digits. */
const kDigits = 9;

const kNoTextures = "The file has no textures: the page does not know them. What they change is as without them.";
const kNoPictures = "The file has no pictures.";
const kOneMaterial = "Bodies of several materials have only their first one in the file.";
const kUnmoved: ArrayLike<number> = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** Fields of a Material that are numbers. */
const kNumbers = [
  "stiffness", "staticFriction", "dynamicFriction", "viscosityNsM", "stribeckMS", "preslidingNM", "adhesionN",
  "complianceMN", "strengthN",
] as const;
/** Those that an image can change from place to place. */
const kTexturable = new Set<string>(["stiffness", "staticFriction", "dynamicFriction", "viscosityNsM"]);

export interface SceneFile {
  readonly content: Blob;
  /** In one line what of the scene is not in it; undefined: nothing. */
  readonly lacking: string | undefined;
}

/** `over`: what the user has set over all surfaces. Throws an Error of one line when there can be no file. */
export async function sceneFile(store: SceneStore, over: SurfaceSettings): Promise<SceneFile> {
  const parts: string[] = [];
  let bytes = 0;
  const lacking = new Set<string>();
  let began_ms = performance.now();
  for (const piece of pieces(store, over, lacking)) {
    parts.push(piece);
    bytes += piece.length;
    if (bytes > kMaxBytes) {
      throw new Error("The scene is too large for a scene file of 64 MB at most: put its meshes into model files.");
    }
    if (performance.now() - began_ms > kSlice_ms) {
      await new Promise((resolve) => setTimeout(resolve));
      began_ms = performance.now();
    }
  }
  return {
    content: new Blob(parts, { type: "application/json" }),
    lacking: lacking.size > 0 ? [...lacking].join(" ") : undefined,
  };
}

/** The page draws after so long. */
const kSlice_ms = 12;

function* pieces(store: SceneStore, over: SurfaceSettings, lacking: Set<string>): Generator<string> {
  const { layout } = store;
  if (layout === undefined || layout.placed.length === 0) {
    throw new Error("There is nothing to save yet: the scene has no objects.");
  }
  let objects = 0;
  const names = namesOf(layout);
  yield '{\n  "objects": [';
  for (const { name, mesh, pose, part, surface, fields } of objectsOf(layout, names, store, lacking)) {
    objects += 1;
    if (objects > kMaxObjects) {
      throw new Error(`The scene cannot be saved: a scene file has ${kMaxObjects} objects at most.`);
    }
    yield `${objects > 1 ? "," : ""}\n    {\n      "name": ${JSON.stringify(name)},\n      "primitives": {`;
    yield* primitives(mesh, pose, part);
    yield "\n      }";
    const material = materialOf(surface, over, () => lacking.add(kNoTextures));
    yield* fieldsOf({ ...fields, material }, "      ");
    yield "\n    }";
  }
  yield "\n  ]";
  yield* fieldsOf(mechanicsJson(layout, store.poses, (index) => names[index]!), "  ");
  yield "\n}\n";
}

/** Of each object what its scene calls it, or its number; no two the same, as joints name their bodies. */
function namesOf(layout: Layout): string[] {
  const used = new Set<string>();
  return layout.placed.map(({ label }, index) => {
    let name = label || `object ${index + 1}`;
    for (let copy = 2; used.has(name); ++copy) name = `${label || "object"} ${copy}`;
    used.add(name);
    return name;
  });
}

function* fieldsOf(fields: Record<string, unknown>, indent: string): Generator<string> {
  for (const [field, value] of Object.entries(fields)) {
    yield `,\n${indent}"${field}": ${JSON.stringify(value)}`;
  }
}

interface SavedObject {
  readonly name: string;
  readonly mesh: Mesh;
  /** Of the vertices as they are written. */
  readonly pose: ArrayLike<number>;
  readonly part: Part;
  readonly surface: SurfaceSettings;
  readonly fields: Record<string, unknown>;
}

/** A body is one object in its own frame; of anything else each material is one, in the world, and so are its snaps and fields. */
function* objectsOf(
  layout: Layout, names: readonly string[], store: SceneStore, lacking: Set<string>,
): Generator<SavedObject> {
  for (const [index, placed] of layout.placed.entries()) {
    const mesh = store.meshes.get(placed.mesh);
    const { body, materials } = placed;
    if (mesh === undefined || materials.length === 0) {
      throw new Error("The scene cannot be saved: the page was not told all its meshes and materials.");
    }
    const name = names[index]!;
    if (mesh.looks.some(({ image }) => image.file.length > 0)) lacking.add(kNoPictures);
    const colour = placed.colour.length === 3 ? { colour: Array.from(placed.colour) } : {};
    const pose = store.poses.subarray(kPoseNumbers * index, kPoseNumbers * (index + 1));
    if (body !== undefined) {
      if (materials.length > 1) lacking.add(kOneMaterial);
      const own = { transform: transformJson(pose), body: bodyJson(placed), ...placesJson(layout, index, kUnmoved) };
      const fields = { ...colour, ...own };
      yield { name, mesh, pose: kUnmoved, part: wholeOf(mesh), surface: materials[0]!, fields };
      continue;
    }
    const places = placesJson(layout, index, pose);
    if (Object.keys(places).length > 0) {
      yield { name: `${name}, places`, mesh, pose, part: kNothing, surface: materials[0]!, fields: places };
    }
    for (const [material, surface] of materials.entries()) {
      const part = partOf(mesh, material);
      const full = materials.length > 1 ? `${name}, material ${material + 1}` : name;
      if (part !== undefined) yield { name: full, mesh, pose, part, surface, fields: colour };
    }
  }
}

/** The elements of a mesh that have one material, and the vertices that they use. */
interface Part {
  readonly triangles: Uint32Array;
  readonly segments: Uint32Array;
  readonly points: Uint32Array;
  readonly vertices: Uint32Array;
}

const kNone = new Uint32Array();
/** Of an object that has places alone. */
const kNothing: Part = { triangles: kNone, segments: kNone, points: kNone, vertices: kNone };

/** Undefined: nothing has this material. Lines and points have the first: the page does not get theirs. */
function partOf(mesh: Mesh, material: number): Part | undefined {
  const { triangleMaterials: materials } = mesh;
  const [segments, points] = material === 0 ? [mesh.segments, mesh.points] : [kNone, kNone];
  const mixed = materials.some((each) => each !== material);
  const all = materials.length === 0 ? material === 0 : !mixed;
  const triangles = all ? mesh.triangles : mesh.triangles.filter((_, i) => materials[Math.floor(i / 3)] === material);
  const own = materials.length === 0 && material !== 0 ? kNone : triangles;
  if (own.length + segments.length + points.length === 0) {
    return undefined;
  }
  return renumbered(mesh.positions.length / 3, own, segments, points);
}

function wholeOf({ positions, triangles, segments, points }: Mesh): Part {
  return renumbered(positions.length / 3, triangles, segments, points);
}

function renumbered(count: number, ...lists: [Uint32Array, Uint32Array, Uint32Array]): Part {
  const numbers = new Int32Array(count).fill(-1);
  lists.forEach((list) => list.forEach((vertex) => (numbers[vertex] = 0)));
  let used = 0;
  const vertices = new Uint32Array(count);
  numbers.forEach((mark, vertex) => {
    if (mark === 0) {
      vertices[used] = vertex;
      numbers[vertex] = used++;
    }
  });
  const [triangles, segments, points] = lists.map((list) => list.map((vertex) => numbers[vertex]!)) as typeof lists;
  return { triangles, segments, points, vertices: vertices.subarray(0, used) };
}

function* primitives(mesh: Mesh, pose: ArrayLike<number>, part: Part): Generator<string> {
  const { vertices } = part;
  yield* list("vertices", 3 * vertices.length, (i) => moved(mesh.positions, vertices, pose, i, 1));
  if (mesh.normals !== undefined) {
    const normals = mesh.normals;
    yield ",";
    yield* list("normals", 3 * vertices.length, (i) => moved(normals, vertices, pose, i, 0));
  }
  const { colours } = mesh;
  if (colours !== undefined) {
    yield ",";
    yield* list("colours", 3 * vertices.length, (i) => colours[3 * vertices[Math.floor(i / 3)]! + (i % 3)]!);
  }
  for (const name of ["triangles", "segments", "points"] as const) {
    const indices = part[name];
    if (indices.length > 0) {
      yield ",";
      yield* list(name, indices.length, (i) => indices[i]!);
    }
  }
}

/** Coordinate `i` of the used vertices at the pose; `weight` of its origin: 1 for places, 0 for directions. */
function moved(values: Float32Array, used: Uint32Array, pose: ArrayLike<number>, i: number, weight: number): number {
  const at = 3 * used[Math.floor(i / 3)]!;
  const row = 4 * (i % 3);
  const [x, y, z] = [values[at]!, values[at + 1]!, values[at + 2]!];
  const value = pose[row]! * x + pose[row + 1]! * y + pose[row + 2]! * z + weight * pose[row + 3]!;
  return Number(value.toPrecision(kDigits));
}

function* list(name: string, count: number, at: (index: number) => number): Generator<string> {
  yield `\n        ${JSON.stringify(name)}: [`;
  for (let first = 0; first < count; first += kPiece) {
    const size = Math.min(kPiece, count - first);
    yield (first > 0 ? "," : "") + Array.from({ length: size }, (_, i) => at(first + i)).join(",");
  }
  yield "]";
}

type MaterialJson = Record<string, number | string>;

/** As a Material of the schema. A quantity that only an image gives is left out: then `textured` is called. */
function materialOf(surface: SurfaceSettings, over: SurfaceSettings, textured: () => void): MaterialJson {
  const felt: SurfaceSettings = { ...surface, ...over };
  const material: MaterialJson = {};
  for (const field of kNumbers) {
    const value = felt[field];
    if (value !== undefined) {
      material[field] = value;
    } else if (kTexturable.has(field)) {
      textured();
    }
  }
  if (felt.smooth !== undefined) {
    material.shade = felt.smooth ? "SMOOTH" : "FLAT";
  }
  return material;
}
