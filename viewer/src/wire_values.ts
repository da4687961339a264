// Numbers of the wire, checked: little-endian byte arrays as typed arrays, vectors that are known or not. What is broken
// is refused with a sentence for the user.

import type { Vec3 } from "./gen/hl_pb";
import { isFiniteVec, type Vec } from "./vec";

/** Its message is a sentence for the user. */
export class ProtocolError extends Error {}

/** Absent or non-finite vectors become undefined: not known, so not drawn. */
export function knownVec(v: Vec3 | undefined): Vec | undefined {
  return v !== undefined && isFiniteVec(v) ? { x: v.x, y: v.y, z: v.z } : undefined;
}

/** The wire is little-endian, as every browser's typed arrays are. Copies only when the bytes are not aligned. */
function aligned(bytes: Uint8Array, what: string): { buffer: ArrayBuffer; offset: number; count: number } {
  if (bytes.byteLength % 4 !== 0) {
    throw new ProtocolError(`the scene's ${what} are cut short`);
  }
  const usable = bytes.byteOffset % 4 === 0 && bytes.buffer instanceof ArrayBuffer ? bytes : new Uint8Array(bytes);
  return { buffer: usable.buffer as ArrayBuffer, offset: usable.byteOffset, count: bytes.byteLength / 4 };
}

export function floats(bytes: Uint8Array, what: string): Float32Array {
  const { buffer, offset, count } = aligned(bytes, what);
  const values = new Float32Array(buffer, offset, count);
  if (!values.every(Number.isFinite)) {
    throw new ProtocolError(`the scene's ${what} contain a value that is not a number`);
  }
  return values;
}

/** Whole groups of `corners` indices, each of a vertex that exists. */
export function indices(bytes: Uint8Array, corners: number, vertices: number, what: string): Uint32Array {
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

/** Whole numbers of two bytes. */
export function shorts(bytes: Uint8Array, what: string): Uint16Array {
  if (bytes.byteLength % 2 !== 0) {
    throw new ProtocolError(`the scene's ${what} are cut short`);
  }
  const own = new Uint8Array(bytes);
  return new Uint16Array(own.buffer, 0, own.byteLength / 2);
}
