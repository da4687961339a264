// The scene as it is sent to the page: meshes and a layout for each new scene, and what of it moves, from the engine's
// numbers in the order of web/hl_web.h.

import type { MessageInitShape } from "@bufbuild/protobuf";
import {
  JointKind, type PlacedFieldSchema, type PlacedJointSchema, type PlacedMeshSchema, type PlacedSnapSchema,
  type PlacedVolumeSchema,
} from "../gen/hl_pb";
import { kPoseNumbers } from "../scene_messages";
import { encode } from "./encode";
import { Numbers, type Module } from "./engine";

type Bytes = Uint8Array<ArrayBuffer>;
type Placed = MessageInitShape<typeof PlacedMeshSchema>;

/** Numbers of HlWebScene before those of the scene. */
const kOfDevice = 5;
const kBeforeObjects = kOfDevice + 11;
/** HlWebObject::body of one that moves. */
const kMoves = 2;

/** Of a surface that is no mesh so many triangles are drawn, or a few more. */
const kDrawn = 300_000;
/** Of one that changes at once, perhaps again and again. */
const kDrawnSoon = 60_000;

const bytesOf = (values: Float32Array | Uint32Array): Uint8Array =>
  new Uint8Array(values.buffer, values.byteOffset, values.byteLength);

export class SentScene {
  private layout_ = 0;
  private lastMesh_ = 0;
  private name_ = "";
  /** Numbers of the meshes of the objects, and the objects as placed. */
  private meshes_: number[] = [];
  private placed_: Placed[] = [];
  private moving_: readonly number[] = [];
  private triangles_ = 0;
  private volumes_ = 0;
  private worldPerDevice_ = 1;

  /** Number of the layout; 0: there is none yet. */
  get layout(): number {
    return this.layout_;
  }

  get triangles(): number {
    return this.triangles_;
  }

  /** How many surfaces of volumes there are. */
  get volumes(): number {
    return this.volumes_;
  }

  get worldPerDevice(): number {
    return this.worldPerDevice_;
  }

  /** Of a scene that has taken the place of the one before, whose meshes are forgotten. */
  messages(module: Module, name: string): Bytes[] {
    const gone = this.meshes_;
    this.name_ = name;
    const n = new Numbers(module, module._hlWebScene());
    n.list(kBeforeObjects);
    const objects = numbers(n.next());
    this.meshes_ = objects.map(() => ++this.lastMesh_);
    const described = objects.map((object) => this.describe(module, object, kDrawn));
    this.triangles_ = described.reduce((sum, { triangles }) => sum + triangles, 0);
    this.placed_ = described.map(({ placed }) => placed);
    this.moving_ = objects.filter((object) => described[object]!.moves);
    return [...described.map(({ bytes }) => bytes), this.layoutMessage(module), ...forgotten(gone)];
  }

  /** Of an object whose surface is another one: coarsely at first, `soon`, as it may change again and again. */
  changed(module: Module, object: number, soon: boolean): Bytes[] {
    const gone = this.meshes_[object]!;
    this.meshes_[object] = ++this.lastMesh_;
    const { bytes, placed } = this.describe(module, object, soon ? kDrawnSoon : kDrawn);
    this.placed_[object] = placed;
    return [bytes, this.layoutMessage(module), ...forgotten([gone])];
  }

  private layoutMessage(module: Module): Bytes {
    const n = new Numbers(module, module._hlWebScene());
    n.list(kOfDevice);
    const [boundsMin, boundsMax, proxyRadius, worldPerDevice] = [n.vec(), n.vec(), n.next(), n.next()];
    const gravity = n.vec();
    const [objects, joints, snaps, fields, volumes] = n.list(5) as [number, number, number, number, number];
    this.layout_ += 1;
    this.worldPerDevice_ = worldPerDevice;
    this.volumes_ = volumes;
    const placed = this.placed_;
    const mechanics = placed.some(({ body }) => body !== undefined)
      ? { gravityMS2: gravity, joints: numbers(joints).map((i) => jointOf(module, i)) }
      : {};
    return encode({ case: "layout", value: {
      number: this.layout_, name: this.name_, boundsMin, boundsMax, proxyRadius, worldPerDevice, placed, ...mechanics,
      poses: bytesOf(posesAt(module._hlWebStarts(), module, numbers(objects))),
      snaps: numbers(snaps).map((i) => snapOf(module, i)),
      fields: numbers(fields).map((i) => fieldOf(module, snaps + i)),
      volumes: numbers(volumes).map((i) => volumeOf(module, i)) } });
  }

  /** Fields of a state. */
  moves(module: Module): { moved: number[]; movedPoses: Uint8Array } {
    return { moved: [...this.moving_], movedPoses: bytesOf(posesAt(module._hlWebPoses(), module, this.moving_)) };
  }

  private describe(module: Module, object: number, most: number) {
    const mesh = this.meshes_[object]!;
    module._hlWebDraw(object, most);
    const n = new Numbers(module, module._hlWebObject(object));
    const [vertices, normals, triangles, segments] = n.list(4) as [number, number, number, number];
    const [body, coloured, cloudPoints] = [n.next(), n.next(), BigInt(n.next())];
    const positions = floats(module, module._hlWebPositions(object), vertices);
    const bytes = encode({ case: "mesh", value: {
      number: mesh, cloudPoints, ...boundsOf(positions), positions: bytesOf(positions),
      normals: bytesOf(floats(module, module._hlWebNormals(object), normals)),
      triangles: bytesOf(indices(module, module._hlWebTriangles(object), 3 * triangles)),
      segments: bytesOf(indices(module, module._hlWebSegments(object), 2 * segments)),
      colours: octets(module, module._hlWebColours(object), coloured === 0 ? 0 : 3 * vertices) } });
    const start = bytesOf(posesAt(module._hlWebStarts(), module, [object]));
    const label = module.UTF8ToString(module._hlWebName(object));
    const placed: Placed =
      body === 0 ? { mesh, label } : { mesh, label, body: { fixed: body !== kMoves }, start };
    return { bytes, placed, triangles, moves: body === kMoves };
  }
}

function forgotten(meshes: readonly number[]): Bytes[] {
  return meshes.length > 0 ? [encode({ case: "forget", value: { meshes: [...meshes] } })] : [];
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

function octets(module: Module, pointer: number, count: number): Uint8Array {
  return count === 0 ? new Uint8Array() : new Uint8Array(module.HEAPU32.buffer).slice(pointer, pointer + count);
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

/** The number of a volume, from 1 on, is what the page calls its surface by. */
function volumeOf(module: Module, volume: number): MessageInitShape<typeof PlacedVolumeSchema> {
  const n = new Numbers(module, module._hlWebVolume(volume));
  const [placed, iso, low, high, below] = [n.next(), n.next(), n.next(), n.next(), n.next()];
  return { placed, surface: BigInt(volume + 1), iso, low, high, below: below !== 0 };
}
