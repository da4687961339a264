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
  _hlWebScene(): number;
  _hlWebPositions(): number;
  _hlWebNormals(): number;
  _hlWebTriangles(): number;
  _hlWebStep(steps: number): void;
  _hlWebState(): number;
  _hlWebFault(): number;
  _hlWebGoal(x: number, y: number, z: number): void;
  _hlWebRelease(): void;
  _hlWebPress(buttons: number): void;
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

  vec(): { x: number; y: number; z: number } {
    return { x: this.next(), y: this.next(), z: this.next() };
  }

  list(count: number): number[] {
    return Array.from({ length: count }, () => this.next());
  }
}

/** Throws with the engine's own words. */
export function loadBuiltin(module: Module, name: string): void {
  const text = module._malloc(kName_bytes);
  module.stringToUTF8(name, text, kName_bytes);
  const loaded = module._hlWebLoadBuiltin(text);
  module._free(text);
  if (loaded === 0) {
    throw new Error(module.UTF8ToString(module._hlWebError()));
  }
}
