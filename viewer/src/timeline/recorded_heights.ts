// A height field of a recording as the page draws it: put together from its parts, with every n-th sample where all
// would be too many triangles. Normals are left to the mesh: flat triangles of a screen's size.

import type { RecordedHeights } from "../gen/recording_pb";
import type { Mesh } from "../scene_messages";
import { RecordingError } from "./recording_blocks";
import { boundsOf } from "./recorded_mesh";

type Part = Pick<RecordedHeights, "columns" | "rows" | "kind" | "axes" | "origin" | "samples" | "continues"> &
  { readonly missing?: number | undefined };
const kMaxTriangles = 1_000_000;
const kReaders = [
  { bytes: 2, read: (view: DataView, at: number) => view.getInt16(at, true) },
  { bytes: 2, read: (view: DataView, at: number) => view.getUint16(at, true) },
  { bytes: 4, read: (view: DataView, at: number) => view.getFloat32(at, true) },
] as const;

export class HeightParts {
  private parts_: Part[] = [];

  /** The whole field as a mesh after its last part; undefined before. */
  add(number: number, part: Part): Mesh | undefined {
    this.parts_.push(part);
    if (part.continues) {
      return undefined;
    }
    const parts = this.parts_;
    this.parts_ = [];
    return meshOf(number, parts);
  }
}

function meshOf(number: number, parts: readonly Part[]): Mesh {
  const head = parts[0]!;
  const reader = kReaders[head.kind];
  const bytes = parts.reduce((sum, part) => sum + part.samples.length, 0);
  if (reader === undefined || head.axes.length !== 9 || head.origin.length !== 3 || head.columns < 2 ||
      head.rows < 2 || bytes !== head.columns * head.rows * reader.bytes) {
    throw new RecordingError("makes no sense: a height field in it does not agree with itself");
  }
  const whole = new Uint8Array(bytes);
  let at = 0;
  for (const part of parts) {
    whole.set(part.samples, at);
    at += part.samples.length;
  }
  const view = new DataView(whole.buffer);
  return new Drawn(head, (place) => reader.read(view, place * reader.bytes)).mesh(number);
}

/** The samples that are drawn: every n-th, and those of the last column and row. */
class Drawn {
  private readonly columns_: number[];
  private readonly rows_: number[];
  private last_ = 0;

  constructor(private readonly head_: Part, private readonly read_: (place: number) => number) {
    let step = 1;
    const cells = (side: number) => Math.floor((side - 2) / step) + 1;
    while (2 * cells(head_.columns) * cells(head_.rows) > kMaxTriangles) {
      step += 1;
    }
    const places = (side: number) => Array.from({ length: cells(side) + 1 }, (_, i) => Math.min(i * step, side - 1));
    this.columns_ = places(head_.columns);
    this.rows_ = places(head_.rows);
  }

  mesh(number: number): Mesh {
    const positions = new Float32Array(3 * this.columns_.length * this.rows_.length);
    const there = this.rows_.flatMap((row, j) => this.columns_.map((column, i) => this.place(column, row,
      positions.subarray(3 * (j * this.columns_.length + i), 3 * (j * this.columns_.length + i) + 3))));
    return {
      number, positions, normals: undefined, triangles: this.triangles(there), segments: new Uint32Array(),
      points: new Uint32Array(), texcoords: undefined, looks: [], triangleMaterials: new Uint16Array(),
      bounds: boundsOf(positions),
    };
  }

  /** Whether there is a sample; where there is none the place has the height of the last, and nothing uses it. */
  private place(column: number, row: number, out: Float32Array): boolean {
    const { axes, origin, missing, columns } = this.head_;
    const value = this.read_(row * columns + column);
    const there = Number.isFinite(value) && value !== missing;
    this.last_ = there ? value : this.last_;
    for (let k = 0; k < 3; ++k) {
      out[k] = origin[k]! + column * axes[k]! + row * axes[3 + k]! + this.last_ * axes[6 + k]!;
    }
    return there;
  }

  private triangles(there: readonly boolean[]): Uint32Array {
    const width = this.columns_.length;
    const list: number[] = [];
    for (let j = 0; j + 1 < this.rows_.length; ++j) {
      for (let i = 0; i + 1 < width; ++i) {
        const [a, b, c, d] = [j * width + i, j * width + i + 1, (j + 1) * width + i, (j + 1) * width + i + 1] as const;
        if (there[a]! && there[b]! && there[c]! && there[d]!) {
          list.push(a, d, b, a, c, d);
        }
      }
    }
    return Uint32Array.from(list);
  }
}
