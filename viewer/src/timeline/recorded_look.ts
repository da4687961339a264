// What a recorded mesh looks like, as a live one does (src/page/surface_images.cpp): pictures on runs of triangles, and
// a colour for each vertex. Textures that are felt are not drawn of recordings.

import { create } from "@bufbuild/protobuf";
import { SurfaceImageSchema } from "../gen/hl_pb";
import type { RecordedPaint, RecordedPicture, RecordedShape } from "../gen/recording_pb";
import type { Mesh, SurfaceLook } from "../scene_messages";
import { RecordingError } from "./recording_blocks";

export interface RecordedLook {
  readonly texcoords: Float32Array;
  readonly vertexColours: Uint8Array;
  readonly trianglePaints: Uint16Array;
  readonly paints: readonly RecordedPaint[];
  readonly pictures: readonly RecordedPicture[];
}

const kWhite = 0xffffff;

export function lookOf(parts: readonly RecordedShape[]): RecordedLook {
  return {
    texcoords: Float32Array.from(parts.flatMap((part) => part.texcoords)),
    vertexColours: joined(parts.map((part) => part.vertexColours)),
    trianglePaints: Uint16Array.from(parts.flatMap((part) => part.trianglePaints)),
    paints: parts.flatMap((part) => part.paints),
    pictures: parts.flatMap((part) => part.pictures),
  };
}

function joined(lists: readonly Uint8Array[]): Uint8Array {
  const whole = new Uint8Array(lists.reduce((sum, list) => sum + list.length, 0));
  let at = 0;
  for (const list of lists) {
    whole.set(list, at);
    at += list.length;
  }
  return whole;
}

/** The mesh with its look; a vertex of triangles of several colours is there once for each. */
export function dressed(mesh: Mesh, look: RecordedLook): Mesh {
  check(mesh, look);
  const looks = look.texcoords.length > 0 ? picturesOn(look) : [];
  const texcoords = looks.length > 0 ? look.texcoords : undefined;
  const colours = look.vertexColours.length > 0 ? look.vertexColours : undefined;
  const painted = look.trianglePaints.length > 0 && look.paints.some(({ colour }) => colour !== kWhite);
  return painted ? coloured({ ...mesh, texcoords, looks, colours }, look) : { ...mesh, texcoords, looks, colours };
}

function check({ positions, triangles }: Mesh, look: RecordedLook): void {
  const vertices = positions.length / 3;
  const fits = (length: number, whole: number) => length === 0 || length === whole;
  if (!fits(look.texcoords.length, 2 * vertices) || !fits(look.vertexColours.length, 3 * vertices) ||
      !fits(look.trianglePaints.length, triangles.length / 3) ||
      look.trianglePaints.some((paint) => paint >= look.paints.length) ||
      look.paints.some(({ picture }) => picture !== undefined && picture >= look.pictures.length)) {
    throw new RecordingError("makes no sense: a mesh in it does not agree with its colours");
  }
}

function picturesOn({ trianglePaints, paints, pictures }: RecordedLook): SurfaceLook[] {
  const runs = pictures.map(() => [] as { first: number; count: number }[]);
  let before: number | undefined;
  trianglePaints.forEach((paint, first) => {
    const { picture } = paints[paint]!;
    if (picture !== undefined) {
      const own = runs[picture]!;
      picture === before ? ++own[own.length - 1]!.count : own.push({ first, count: 1 });
    }
    before = picture;
  });
  return pictures
    .map(({ file, clamp }, i) => ({ image: create(SurfaceImageSchema, { file, clamp }), runs: runs[i]! }))
    .filter((shown) => shown.runs.length > 0);
}

function coloured(mesh: Mesh, { trianglePaints, paints }: RecordedLook): Mesh {
  const own = mesh.colours;
  const vertices = mesh.positions.length / 3;
  const triangles = mesh.triangles.slice();
  const packed: (number | undefined)[] = new Array<undefined>(vertices).fill(undefined);
  const source = Array.from({ length: vertices }, (_, i) => i);
  const again = new Map<string, number>();
  triangles.forEach((v, corner) => {
    const paint = paints[trianglePaints[Math.floor(corner / 3)]!]!.colour;
    const colour = own === undefined ? paint : multiplied(paint, own, v);
    packed[v] ??= colour;
    if (packed[v] === colour) return;
    const key = `${v} ${colour}`;
    let copy = again.get(key);
    if (copy === undefined) {
      copy = packed.push(colour) - 1;
      source.push(v);
      again.set(key, copy);
    }
    triangles[corner] = copy;
  });
  const colours = new Uint8Array(3 * packed.length);
  packed.forEach((colour = kWhite, v) => colours.set([colour >> 16, colour >> 8, colour], 3 * v));
  const copied = <T extends Float32Array | undefined>(list: T, each: number) => list && repeated(list, each, source);
  return {
    ...mesh, triangles, colours,
    positions: repeated(mesh.positions, 3, source),
    normals: copied(mesh.normals, 3), texcoords: copied(mesh.texcoords, 2),
  };
}

function multiplied(paint: number, own: Uint8Array, v: number): number {
  const part = (shift: number, i: number) => Math.round((((paint >> shift) & 255) * own[3 * v + i]!) / 255) << shift;
  return part(16, 0) | part(8, 1) | part(0, 2);
}

function repeated(list: Float32Array, each: number, source: readonly number[]): Float32Array {
  const whole = new Float32Array(each * source.length);
  source.forEach((v, i) => whole.set(list.subarray(each * v, each * (v + 1)), each * i));
  return whole;
}
