// OBJ, STL and PLY files as triangles, by three.js's own readers. Needs no page: it runs in a worker.

import { type BufferGeometry, Mesh } from "three";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";

export interface Triangles {
  readonly positions: Float64Array<ArrayBuffer>;
  readonly triangles: Uint32Array<ArrayBuffer>;
}

export const kMeshEndings = [".obj", ".stl", ".ply"] as const;

const kMaxTriangles = 1_000_000;

function geometriesOf(ending: string, bytes: ArrayBuffer): BufferGeometry[] {
  if (ending === ".stl") return [new STLLoader().parse(bytes)];
  if (ending === ".ply") return [new PLYLoader().parse(bytes)];
  const found: BufferGeometry[] = [];
  // The reader makes lines of all of an object that has any line or point.
  const faces = new TextDecoder().decode(bytes).replace(/^[ \t]*[lp][ \t].*$/gm, "");
  new OBJLoader().parse(faces).traverse((object) => {
    if (object instanceof Mesh) found.push(object.geometry as BufferGeometry);
  });
  return found;
}

function understood(ending: string, bytes: ArrayBuffer): BufferGeometry[] {
  try {
    return geometriesOf(ending, bytes).filter((part) => part.getAttribute("position") !== undefined);
  } catch (error) {
    throw new Error(`it cannot be understood (${error instanceof Error ? error.message : String(error)})`, { cause: error });
  }
}

/** Throws an Error with one line for a file that has no triangles, or too many. Side files are not asked for. */
export function readMesh(ending: string, bytes: ArrayBuffer): Triangles {
  const parts = understood(ending, bytes);
  const cornersOf = (part: BufferGeometry) => part.index?.count ?? part.getAttribute("position").count;
  const corners = parts.reduce((sum, part) => sum + cornersOf(part) - (cornersOf(part) % 3), 0);
  if (corners === 0) throw new Error("there is no triangle in it");
  if (corners > 3 * kMaxTriangles) throw new Error("it has more than a million triangles");
  const vertices = parts.reduce((sum, part) => sum + part.getAttribute("position").count, 0);
  const out: Triangles = { positions: new Float64Array(3 * vertices), triangles: new Uint32Array(corners) };
  let vertex = 0;
  let corner = 0;
  for (const part of parts) {
    const points = part.getAttribute("position");
    out.positions.set(points.array.subarray(0, 3 * points.count) as Float32Array, 3 * vertex);
    const count = cornersOf(part) - (cornersOf(part) % 3);
    for (let i = 0; i < count; ++i) out.triangles[corner + i] = vertex + (part.index?.getX(i) ?? i);
    vertex += points.count;
    corner += count;
  }
  if (out.positions.some((x) => !Number.isFinite(x))) throw new Error("a vertex of it is no number");
  return out;
}
