// Between bytes of the WebSocket and values the page can trust. Generated code does the wire format; here lengths,
// indices and numbers are checked, so that no broken message reaches the renderer.

import { create, fromBinary, toBinary } from "@bufbuild/protobuf";
import {
  ServerMessageSchema,
  ViewerMessageSchema,
  type Hello,
  type LedgerMode,
  type Notice,
  type SceneMesh,
  type SurfaceImage,
  type State,
  type Vec3,
} from "./gen/hl_pb";
import type { SurfaceSettings } from "./surfaces";
import { isFiniteVec, kZero, type Vec } from "./vec";

/** Must equal the server's; see Hello.protocol_version. */
export const kProtocolVersion = 1;

/** SceneMesh with its byte arrays as typed arrays and every index proven to be in range. */
/** A texture to show, and the runs of triangles that show it. */
export interface SurfaceLook {
  readonly image: SurfaceImage;
  readonly runs: readonly { readonly first: number; readonly count: number }[];
}

export interface Scene {
  readonly name: string;
  readonly positions: Float32Array;
  readonly normals: Float32Array | undefined;
  readonly triangles: Uint32Array;
  readonly segments: Uint32Array;
  readonly points: Uint32Array;
  readonly texcoords: Float32Array | undefined;
  readonly looks: readonly SurfaceLook[];
  readonly boundsMin: Vec;
  readonly boundsMax: Vec;
  readonly proxyRadius_m: number;
  readonly worldPerDevice: number;
}

export type Incoming =
  | { readonly kind: "hello"; readonly hello: Hello }
  | { readonly kind: "scene"; readonly scene: Scene }
  | { readonly kind: "state"; readonly state: State }
  | { readonly kind: "notice"; readonly notice: Notice }
  | { readonly kind: "unknown" };

/** Throws ProtocolError, with a sentence for the user, on anything malformed. */
export class ProtocolError extends Error {}

export function decodeServerMessage(bytes: Uint8Array): Incoming {
  let body;
  try {
    body = fromBinary(ServerMessageSchema, bytes).body;
  } catch (error) {
    throw new ProtocolError(`the server sent a message that cannot be read (${String(error)})`);
  }
  switch (body.case) {
    case "hello":
      return { kind: "hello", hello: body.value };
    case "scene":
      return { kind: "scene", scene: checkScene(body.value) };
    case "state":
      return { kind: "state", state: body.value };
    case "notice":
      return { kind: "notice", notice: body.value };
    default:
      return { kind: "unknown" };
  }
}

/** Absent or non-finite vectors become undefined: not known, so not drawn. */
export function knownVec(v: Vec3 | undefined): Vec | undefined {
  return v !== undefined && isFiniteVec(v) ? { x: v.x, y: v.y, z: v.z } : undefined;
}

function checkScene(mesh: SceneMesh): Scene {
  const positions = floats(mesh.positions, "positions");
  if (positions.length % 3 !== 0) {
    throw new ProtocolError("the scene's positions are not whole vertices");
  }
  const vertices = positions.length / 3;
  const normals = mesh.normals.length === 0 ? undefined : floats(mesh.normals, "normals");
  if (normals !== undefined && normals.length !== positions.length) {
    throw new ProtocolError("the scene has not one normal per vertex");
  }
  return {
    name: mesh.name,
    positions,
    normals,
    triangles: indices(mesh.triangles, 3, vertices, "triangles"),
    segments: indices(mesh.segments, 2, vertices, "segments"),
    points: indices(mesh.points, 1, vertices, "points"),
    ...checkLooks(mesh, vertices),
    ...checkBounds(mesh, positions),
    proxyRadius_m: mesh.proxyRadius > 0 && Number.isFinite(mesh.proxyRadius) ? mesh.proxyRadius : 0,
    worldPerDevice: mesh.worldPerDevice,
  };
}

function checkLooks(mesh: SceneMesh, vertices: number): { texcoords: Float32Array | undefined; looks: SurfaceLook[] } {
  if (mesh.parts.length === 0) {
    return { texcoords: undefined, looks: [] };
  }
  const texcoords = floats(mesh.texcoords, "texture coordinates");
  if (texcoords.length !== 2 * vertices) {
    throw new ProtocolError("the scene has not one texture coordinate per vertex");
  }
  const looks = mesh.images.map((image) => {
    if (image.width < 1 || image.height < 1 || image.texels.length !== image.width * image.height) {
      throw new ProtocolError("a texture of the scene is cut short");
    }
    return { image, runs: [] as { first: number; count: number }[] };
  });
  const triangles = mesh.triangles.length / 12;
  for (const { firstTriangle, triangles: count, image } of mesh.parts) {
    const look = looks[image];
    if (look === undefined || firstTriangle + count > triangles) {
      throw new ProtocolError("a part of the scene has a texture or a triangle that does not exist");
    }
    look.runs.push({ first: firstTriangle, count });
  }
  return { texcoords, looks };
}

/** The bounds as sent, or those of the vertices when they are missing. */
function checkBounds(mesh: SceneMesh, positions: Float32Array): { boundsMin: Vec; boundsMax: Vec } {
  const boundsMin = knownVec(mesh.boundsMin);
  const boundsMax = knownVec(mesh.boundsMax);
  if (boundsMin !== undefined && boundsMax !== undefined) {
    return { boundsMin, boundsMax };
  }
  if (positions.length === 0) {
    return { boundsMin: kZero, boundsMax: kZero };
  }
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3]!, value);
    high[i % 3] = Math.max(high[i % 3]!, value);
  });
  return { boundsMin: { x: low[0]!, y: low[1]!, z: low[2]! }, boundsMax: { x: high[0]!, y: high[1]!, z: high[2]! } };
}

/** The wire is little-endian, as every browser's typed arrays are. Copies only when the bytes are not aligned. */
function aligned(bytes: Uint8Array, what: string): { buffer: ArrayBuffer; offset: number; count: number } {
  if (bytes.byteLength % 4 !== 0) {
    throw new ProtocolError(`the scene's ${what} are cut short`);
  }
  const usable = bytes.byteOffset % 4 === 0 && bytes.buffer instanceof ArrayBuffer ? bytes : new Uint8Array(bytes);
  return { buffer: usable.buffer as ArrayBuffer, offset: usable.byteOffset, count: bytes.byteLength / 4 };
}

function floats(bytes: Uint8Array, what: string): Float32Array {
  const { buffer, offset, count } = aligned(bytes, what);
  const values = new Float32Array(buffer, offset, count);
  if (!values.every(Number.isFinite)) {
    throw new ProtocolError(`the scene's ${what} contain a value that is not a number`);
  }
  return values;
}

function indices(bytes: Uint8Array, corners: number, vertices: number, what: string): Uint32Array {
  const { buffer, offset, count } = aligned(bytes, what);
  const values = new Uint32Array(buffer, offset, count);
  if (count % corners !== 0) {
    throw new ProtocolError(`the scene's ${what} are cut short`);
  }
  if (!values.every((index) => index < vertices)) {
    throw new ProtocolError(`the scene's ${what} name a vertex that does not exist`);
  }
  return values;
}

export interface SettingsChange {
  explore?: boolean;
  handFirm?: boolean;
  stiffnessNM?: number;
  surfaces?: SurfaceSettings;
  ledger?: LedgerMode;
}

export function encodeHandGoal(position: Vec): Uint8Array<ArrayBuffer> {
  return encode({ case: "handGoal", value: { position } });
}

export function encodeRelease(): Uint8Array<ArrayBuffer> {
  return encode({ case: "release", value: {} });
}

export function encodeRearm(): Uint8Array<ArrayBuffer> {
  return encode({ case: "rearm", value: {} });
}

export function encodeSettings(change: SettingsChange): Uint8Array<ArrayBuffer> {
  return encode({ case: "settings", value: change });
}

type ViewerBody = NonNullable<Parameters<typeof create<typeof ViewerMessageSchema>>[1]>["body"];

function encode(body: NonNullable<ViewerBody>): Uint8Array<ArrayBuffer> {
  return toBinary(ViewerMessageSchema, create(ViewerMessageSchema, { body })) as Uint8Array<ArrayBuffer>;
}
