// Three numbers in the world frame, and the few operations the page needs on them. Plain objects, so that protocol
// messages, tests and the debug state use them without three.js.

export interface Vec {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

export const kZero: Vec = { x: 0, y: 0, z: 0 };

export function add(a: Vec, b: Vec): Vec {
  return { x: a.x + b.x, y: a.y + b.y, z: a.z + b.z };
}

export function sub(a: Vec, b: Vec): Vec {
  return { x: a.x - b.x, y: a.y - b.y, z: a.z - b.z };
}

export function scale(a: Vec, s: number): Vec {
  return { x: a.x * s, y: a.y * s, z: a.z * s };
}

export function dot(a: Vec, b: Vec): number {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

export function cross(a: Vec, b: Vec): Vec {
  return { x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x };
}

export function length(a: Vec): number {
  return Math.hypot(a.x, a.y, a.z);
}

export function isFiniteVec(a: Vec): boolean {
  return Number.isFinite(a.x) && Number.isFinite(a.y) && Number.isFinite(a.z);
}

/** Of length 1; of a zero vector: itself. */
export function unit(a: Vec): Vec {
  const size = length(a);
  return size > 0 ? scale(a, 1 / size) : a;
}

/** From `a` at 0 to `b` at 1. */
export function mix(a: Vec, b: Vec, t: number): Vec {
  return add(a, scale(sub(b, a), t));
}
