// A mesh of a recording as the page draws one: put together from its parts, with every index proven to be in range.

import type { RecordedShape } from "../gen/recording_pb";
import type { Bounds, Mesh } from "../scene_messages";
import { dressed, lookOf } from "./recorded_look";
import { RecordingError } from "./recording_blocks";

const kLists = ["positions", "normals", "triangles", "segments", "points", "triangleMaterials"] as const;

export class MeshParts {
  private parts_: RecordedShape[] = [];

  /** The whole mesh after its last part; undefined before. */
  add(number: number, part: RecordedShape): Mesh | undefined {
    this.parts_.push(part);
    if (part.continues) {
      return undefined;
    }
    const parts = this.parts_;
    this.parts_ = [];
    return meshOf(number, parts);
  }
}

function meshOf(number: number, parts: readonly RecordedShape[]): Mesh {
  const joined = <T extends { set(from: number[], at: number): void }>(
    list: (typeof kLists)[number], make: (length: number) => T,
  ): T => {
    const whole = make(parts.reduce((sum, part) => sum + part[list].length, 0));
    let at = 0;
    for (const part of parts) {
      whole.set(part[list], at);
      at += part[list].length;
    }
    return whole;
  };
  const floats = (length: number) => new Float32Array(length);
  const indices = (length: number) => new Uint32Array(length);
  const positions = joined("positions", floats);
  const normals = joined("normals", floats);
  const mesh = {
    number, positions,
    normals: normals.length === 0 ? undefined : normals,
    triangles: joined("triangles", indices),
    segments: joined("segments", indices),
    points: joined("points", indices),
    texcoords: undefined, looks: [],
    triangleMaterials: joined("triangleMaterials", (length) => new Uint16Array(length)),
    bounds: boundsOf(positions),
  };
  check(mesh);
  return dressed(mesh, lookOf(parts));
}

function check(mesh: Mesh): void {
  const vertices = mesh.positions.length / 3;
  const good = (list: Uint32Array, each: number) => list.length % each === 0 && list.every((index) => index < vertices);
  const materials = mesh.triangleMaterials.length;
  if (!Number.isInteger(vertices) || (mesh.normals !== undefined && mesh.normals.length !== 3 * vertices) ||
      !good(mesh.triangles, 3) || !good(mesh.segments, 2) || !good(mesh.points, 1) ||
      (materials !== 0 && materials !== mesh.triangles.length / 3)) {
    throw new RecordingError("makes no sense: a mesh in it does not agree with itself");
  }
}

export function boundsOf(positions: Float32Array): Bounds | undefined {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, i) => {
    if (Number.isFinite(value)) {
      min[i % 3] = Math.min(min[i % 3]!, value);
      max[i % 3] = Math.max(max[i % 3]!, value);
    }
  });
  const vec = ([x, y, z]: number[]) => ({ x: x!, y: y!, z: z! });
  return min.every((value, i) => value <= max[i]!) ? { min: vec(min), max: vec(max) } : undefined;
}
