// Recording files for tests, block by block as src/record/recording_file.cpp writes them.

import { create, toBinary, type MessageInitShape } from "@bufbuild/protobuf";
import { crc32 } from "../src/timeline/recording_blocks";
import { deflateSync } from "node:zlib";
import { RecordingBlockSchema } from "../src/gen/recording_pb";

export type BlockBody = NonNullable<MessageInitShape<typeof RecordingBlockSchema>["body"]>;

export const kMagic = Buffer.from("HLREC2\r\n");

export function blockBytes(body: BlockBody): Buffer {
  const raw = toBinary(RecordingBlockSchema, create(RecordingBlockSchema, { body }));
  const packed = deflateSync(raw);
  const head = Buffer.alloc(12);
  [packed.length, raw.length, crc32(packed)].forEach((value, i) => head.writeUInt32LE(value, 4 * i));
  return Buffer.concat([head, packed]);
}

export const kIdentity = [1, 0, 0, 0, 1, 0, 0, 0, 1];
export const kSceneIdentity = 77n;
export const kBegin_ns = 5_000_000_000n;

/** Two screws: at rest, then from x = 0 to x = 1 between 1 s and 2 s of the recording. */
export const kMotion = {
  numbers: [...kIdentity, 0, 0, 0, ...kIdentity, 0, 0, 0, ...kIdentity, 0, 0, 0, ...kIdentity, 1, 0, 0],
  integers: [0n, 0n, kBegin_ns + 1_000_000_000n, kBegin_ns + 2_000_000_000n],
};

export const kStart: BlockBody = {
  case: "start",
  value: { version: "1", deviceName: "a device", beginUnixMs: 1_700_000_000_000n, beginNs: kBegin_ns, servoRateHz: 10 },
};
export const kShape: BlockBody = {
  case: "shape",
  value: { id: 1n, positions: [0, 0, 0, 1, 0, 0, 0, 2, 0], triangles: [0, 1, 2], materials: 1 },
};
const kNoTextures = Array.from({ length: 8 }, () => 0xffffffffn);
export const kSurfaces: BlockBody = {
  case: "surfaces",
  value: {
    id: 1n,
    materials: [{ numbers: [0.5, 0.4, 0.3, 0, 0, 0, 2, ...Array(16).fill(0)], integers: [1n, ...kNoTextures] }],
  },
};
export const kScene: BlockBody = {
  case: "scene",
  value: {
    identity: kSceneIdentity, number: 1n, name: "a scene",
    instances: [{ shape: 1n, surfaces: 1n, motion: kMotion, session: 1, object: 2, name: 3, label: "bolt", colour: 0x0102fa }],
  },
};

/** The hand's metre is ten of the scene, whose origin is at x = 1. */
export const kContext = {
  numbers: [0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 10, 0.02, 1000, 0.1],
  integers: [0n, 0n, 0n, 0n, 0n, 0n, 0n, 0n, 0n, 1n, 0n, 0n, 1n, kSceneIdentity],
};

const times = (count: number) => Array.from({ length: count }, (_, i) => (i === 0 ? kBegin_ns : 100_000_000n));

/** One every tenth of a second: the finger moves along x, the proxy stays 0.1 m above it, and the force rises. */
export function ticks(count: number): BlockBody {
  const each = (make: (i: number) => number[]) => Array.from({ length: count }, (_, i) => make(i)).flat();
  return {
    case: "ticks",
    value: {
      timeNs: times(count), commands: [{ at: 0, values: kContext }], finger: each((i) => [0.01 * i, 0, 0]),
      proxy: each((i) => [1 + 0.1 * i, 0.1, 0]), contacts: each(() => [1]),
    },
  };
}

export function steps(count: number): BlockBody {
  const each = (make: (i: number) => number[]) => Array.from({ length: count }, (_, i) => make(i)).flat();
  return {
    case: "steps",
    value: {
      timeNs: times(count), position: each((i) => [0.01 * i, 0, 0]), targetProxy: each((i) => [0.01 * i, 0.01, 0]),
      forceN: each((i) => [0, 0.1 * i, 0]), flags: each(() => [(2 << 6) | (1 << 5)]),
    },
  };
}

export function fileOf(...bodies: BlockBody[]): Blob {
  return new Blob([kMagic, ...bodies.map(blockBytes)] as BlobPart[]);
}

export const kEnd: BlockBody = { case: "end", value: { reason: "stopped" } };
export const kWhole = [kStart, kShape, kSurfaces, kScene, ticks(31), steps(31), kEnd];
