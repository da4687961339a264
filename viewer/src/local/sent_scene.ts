// The scene as it is sent to the page: meshes and a layout for each new scene, and what of it moves, from the engine's
// numbers in the order of web/hl_web.h.

import type { MessageInitShape } from "@bufbuild/protobuf";
import {
  JointKind, type PlacedFieldSchema, type PlacedJointSchema, type PlacedMeshSchema, type PlacedSnapSchema,
} from "../gen/hl_pb";
import { kPoseNumbers } from "../scene_messages";
import { encode } from "./encode";
import { Numbers, type Module } from "./engine";

type Bytes = Uint8Array<ArrayBuffer>;

/** Numbers of HlWebScene before those of the scene. */
const kOfDevice = 5;
/** HlWebObject::body of one that moves. */
const kMoves = 2;

const bytesOf = (values: Float32Array | Uint32Array): Uint8Array =>
  new Uint8Array(values.buffer, values.byteOffset, values.byteLength);

export class SentScene {
  private layout_ = 0;
  private lastMesh_ = 0;
  private meshes_: readonly number[] = [];
  private moving_: readonly number[] = [];
  private triangles_ = 0;
  private worldPerDevice_ = 1;

  /** Number of the layout; 0: there is none yet. */
  get layout(): number {
    return this.layout_;
  }

  get triangles(): number {
    return this.triangles_;
  }

  get worldPerDevice(): number {
    return this.worldPerDevice_;
  }

  /** Of a scene that has taken the place of the one before, whose meshes are forgotten. */
  messages(module: Module, name: string): Bytes[] {
    const n = new Numbers(module, module._hlWebScene());
    n.list(kOfDevice);
    const [boundsMin, boundsMax, proxyRadius, worldPerDevice] = [n.vec(), n.vec(), n.next(), n.next()];
    const gravity = n.vec();
    const [objects, joints, snaps, fields] = n.list(4) as [number, number, number, number];
    const gone = this.meshes_;
    this.layout_ += 1;
    this.worldPerDevice_ = worldPerDevice;
    this.triangles_ = 0;
    this.meshes_ = numbers(objects).map(() => ++this.lastMesh_);
    const described = this.meshes_.map((mesh, i) => this.describe(module, i, mesh));
    const placed = described.map((each) => each.placed);
    this.moving_ = numbers(objects).filter((i) => described[i]!.moves);
    const mechanics = placed.some(({ body }) => body !== undefined)
      ? { gravityMS2: gravity, joints: numbers(joints).map((i) => jointOf(module, i)) }
      : {};
    const layout = encode({ case: "layout", value: {
      number: this.layout_, name, boundsMin, boundsMax, proxyRadius, worldPerDevice, placed, ...mechanics,
      poses: bytesOf(posesAt(module._hlWebStarts(), module, numbers(objects))),
      snaps: numbers(snaps).map((i) => snapOf(module, i)),
      fields: numbers(fields).map((i) => fieldOf(module, snaps + i)) } });
    const forget = gone.length > 0 ? [encode({ case: "forget", value: { meshes: [...gone] } })] : [];
    return [...described.map(({ bytes }) => bytes), layout, ...forget];
  }

  /** Fields of a state. */
  moves(module: Module): { moved: number[]; movedPoses: Uint8Array } {
    return { moved: [...this.moving_], movedPoses: bytesOf(posesAt(module._hlWebPoses(), module, this.moving_)) };
  }

  private describe(module: Module, object: number, mesh: number) {
    const n = new Numbers(module, module._hlWebObject(object));
    const [vertices, normals, triangles, segments, body] = n.list(5) as [number, number, number, number, number];
    this.triangles_ += triangles;
    const positions = floats(module, module._hlWebPositions(object), vertices);
    const bytes = encode({ case: "mesh", value: {
      number: mesh, ...boundsOf(positions), positions: bytesOf(positions),
      normals: bytesOf(floats(module, module._hlWebNormals(object), normals)),
      triangles: bytesOf(indices(module, module._hlWebTriangles(object), 3 * triangles)),
      segments: bytesOf(indices(module, module._hlWebSegments(object), 2 * segments)) } });
    const start = bytesOf(posesAt(module._hlWebStarts(), module, [object]));
    const placed: MessageInitShape<typeof PlacedMeshSchema> =
      body === 0 ? { mesh } : { mesh, body: { fixed: body !== kMoves }, start };
    return { bytes, placed, moves: body === kMoves };
  }
}

function numbers(count: number): number[] {
  return Array.from({ length: count }, (_, i) => i);
}

/** As many vectors. */
function floats(module: Module, pointer: number, count: number): Float32Array {
  return count === 0 ? new Float32Array() : Float32Array.from(module.HEAPF64.subarray(pointer / 8, pointer / 8 + 3 * count));
}

function indices(module: Module, pointer: number, count: number): Uint32Array {
  return count === 0 ? new Uint32Array() : module.HEAPU32.slice(pointer / 4, pointer / 4 + count);
}

function posesAt(pointer: number, module: Module, objects: readonly number[]): Float32Array {
  const poses = new Float32Array(kPoseNumbers * objects.length);
  objects.forEach((object, i) => {
    const at = pointer / 8 + kPoseNumbers * object;
    poses.set(module.HEAPF64.subarray(at, at + kPoseNumbers), kPoseNumbers * i);
  });
  return poses;
}

function boundsOf(positions: Float32Array) {
  if (positions.length === 0) {
    return {};
  }
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  positions.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3]!, value);
    high[i % 3] = Math.max(high[i % 3]!, value);
  });
  const vec = ([x, y, z]: number[]) => ({ x: x!, y: y!, z: z! });
  return { boundsMin: vec(low), boundsMax: vec(high) };
}

function jointOf(module: Module, joint: number): MessageInitShape<typeof PlacedJointSchema> {
  const n = new Numbers(module, module._hlWebJoint(joint));
  const [kind, bodyA, bodyB] = [n.next(), n.next(), n.next()];
  const [anchor, anchorB, axis] = [n.vec(), n.vec(), n.vec()];
  const hasAxis = kind === JointKind.HINGE || kind === JointKind.SLIDER;
  const places = { anchor, ...(kind === JointKind.DISTANCE ? { anchorB } : {}), ...(hasAxis ? { axis } : {}) };
  const [low, high] = [n.known(), n.known()];
  const said = { kind, ...places, ...(low === undefined ? {} : { low }), ...(high === undefined ? {} : { high }) };
  return bodyB < 0 ? { joint: said, bodyA } : { joint: said, bodyA, bodyB };
}

function placeOf(module: Module, place: number) {
  const n = new Numbers(module, module._hlWebPlace(place));
  const [placed, count, kind, reach, strength] = n.list(5) as [number, number, number, number, number];
  const [normal, direction] = [n.vec(), n.vec()];
  const points = new Numbers(module, module._hlWebPoints(place)).list(3 * count);
  const plane = normal.x !== 0 || normal.y !== 0 || normal.z !== 0;
  return { placed, kind, reach, strength, direction, place: plane ? { points, normal } : { points } };
}

function snapOf(module: Module, number: number): MessageInitShape<typeof PlacedSnapSchema> {
  const { placed, place, reach, strength } = placeOf(module, number);
  return { placed, snap: { ...place, capture: reach, releaseN: strength } };
}

function fieldOf(module: Module, number: number): MessageInitShape<typeof PlacedFieldSchema> {
  const { placed, place, kind, reach, strength, direction } = placeOf(module, number);
  return { placed, field: { ...place, kind, reach, forceN: strength, direction } };
}
