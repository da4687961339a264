// The engine as WebAssembly (web/hl_web.h): names for its numbers, and copies of its arrays.

export interface Module {
  readonly HEAPF64: Float64Array;
  readonly HEAPU32: Uint32Array;
  UTF8ToString(pointer: number): string;
  stringToUTF8(text: string, pointer: number, bytes: number): void;
  _malloc(bytes: number): number;
  _free(pointer: number): void;
  _hlWebError(): number;
  _hlWebLoadBuiltin(name: number): number;
  _hlWebLoadMesh(name: number, positions: number, vertices: number, indices: number, triangles: number): number;
  _hlWebScenes(): number;
  _hlWebQuantities(): number;
  _hlWebScene(): number;
  _hlWebName(object: number): number;
  _hlWebDraw(object: number, triangles: number): void;
  _hlWebObject(object: number): number;
  _hlWebPositions(object: number): number;
  _hlWebNormals(object: number): number;
  _hlWebTriangles(object: number): number;
  _hlWebSegments(object: number): number;
  _hlWebColours(object: number): number;
  _hlWebStarts(): number;
  _hlWebPoses(): number;
  _hlWebJoint(joint: number): number;
  _hlWebPlace(place: number): number;
  _hlWebPoints(place: number): number;
  _hlWebVolume(volume: number): number;
  _hlWebIso(volume: number, value: number, below: number): number;
  _hlWebStep(steps: number): void;
  _hlWebState(): number;
  _hlWebFault(): number;
  _hlWebGoal(x: number, y: number, z: number): void;
  _hlWebRelease(): void;
  _hlWebPress(buttons: number): void;
  _hlWebTurn(x: number, y: number, z: number, w: number): void;
  _hlWebRearm(): void;
  _hlWebExplore(on: number): void;
  _hlWebFirm(firm: number): void;
  _hlWebStiffness(stiffness_N_m: number): void;
  _hlWebLedger(mode: number): void;
  _hlWebSurface(quantity: number, value: number): void;
  _hlWebLook(smooth: number, textures: number): void;
}

const kName_bytes = 256;

/** Reads the numbers of a structure one after the other. */
export class Numbers {
  private at_: number;

  constructor(private readonly module_: Module, pointer: number) {
    this.at_ = pointer / 8;
  }

  next(): number {
    return this.module_.HEAPF64[this.at_++]!;
  }

  /** Absent: it is no number. */
  known(): number | undefined {
    const value = this.next();
    return Number.isNaN(value) ? undefined : value;
  }

  vec(): { x: number; y: number; z: number } {
    return { x: this.next(), y: this.next(), z: this.next() };
  }

  list(count: number): number[] {
    return Array.from({ length: count }, () => this.next());
  }
}

/** Calls with memory of the engine's; it is given back. Throws with the engine's own words when the call gives 0. */
function load(module: Module, name: string, bytes: readonly ArrayBufferView[], call: (at: number[]) => number): void {
  const sizes = [kName_bytes, ...bytes.map(({ byteLength }) => byteLength)];
  const at = sizes.map((size) => module._malloc(size));
  try {
    if (at.includes(0)) throw new Error("this browser has no memory for it");
    module.stringToUTF8(name, at[0]!, kName_bytes);
    bytes.forEach(({ buffer, byteOffset, byteLength }, i) =>
      new Uint8Array(module.HEAPU32.buffer).set(new Uint8Array(buffer, byteOffset, byteLength), at[i + 1]!));
    if (call(at) === 0) throw new Error(module.UTF8ToString(module._hlWebError()));
  } finally {
    at.forEach((pointer) => module._free(pointer));
  }
}

/** Throws with the engine's own words; then the scene before goes on. */
export function loadBuiltin(module: Module, name: string): void {
  load(module, name, [], ([text]) => module._hlWebLoadBuiltin(text!));
}

/** The same of triangles: 3 numbers a vertex, 3 indices a triangle. */
export function loadMesh(module: Module, name: string, positions: Float64Array, triangles: Uint32Array): void {
  load(module, name, [positions, triangles], ([text, points, corners]) =>
    module._hlWebLoadMesh(text!, points!, positions.length / 3, corners!, triangles.length / 3));
}
