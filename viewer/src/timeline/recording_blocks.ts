// The blocks of a recording file (proto/recording.proto): its head, their sizes and checksums. A block that is cut
// short or damaged ends the recording: what is before it is good. Reads the file piece by piece.

import { fromBinary } from "@bufbuild/protobuf";
import { RecordingBlockSchema, type RecordingBlock } from "../gen/recording_pb";

const kMagic = "HLREC2\r\n";
const kFirstForm = "HLREC1\r\n";
const kHead_bytes = 12;
/** As in src/record/recording_file.cpp: more than deflate can pack is a damaged head. */
const kMaxPacking = 1100;
/** A block that a page can unpack. */
const kMaxBlock_bytes = 2 ** 29;
/** Read in one piece. */
const kPiece_bytes = 2 ** 20;

export class RecordingError extends Error {}

/** A file from its begin to its end. */
class Pieces {
  private piece_ = new Uint8Array();
  private at_ = 0;
  private read_ = 0;

  constructor(private readonly file_: Blob) {}

  /** Bytes that have not been taken. */
  get left(): number {
    return this.file_.size - this.read_ + this.piece_.length - this.at_;
  }

  /** The next bytes; no more than are left. */
  async take(bytes: number): Promise<Uint8Array<ArrayBuffer>> {
    if (this.piece_.length - this.at_ < bytes) {
      const from = this.read_ - (this.piece_.length - this.at_);
      this.read_ = Math.min(this.file_.size, from + Math.max(bytes, kPiece_bytes));
      this.piece_ = new Uint8Array(await this.file_.slice(from, this.read_).arrayBuffer());
      this.at_ = 0;
    }
    this.at_ += bytes;
    return this.piece_.slice(this.at_ - bytes, this.at_);
  }
}

/** Calls `take` with each block and the share of the file that is read. Gives what is wrong with its end, in a line. */
export async function readBlocks(
  file: Blob, take: (block: RecordingBlock, share: number) => void,
): Promise<string | undefined> {
  const pieces = new Pieces(file);
  await checkMagic(pieces);
  while (pieces.left > 0) {
    const { left } = pieces;
    const block = await nextBlock(pieces);
    if (block === undefined) {
      return `its last ${left} bytes are cut short or damaged`;
    }
    take(block, 1 - pieces.left / file.size);
  }
  return undefined;
}

async function checkMagic(pieces: Pieces): Promise<void> {
  const magic = String.fromCharCode(...(await pieces.take(Math.min(pieces.left, kMagic.length))));
  if (magic === kFirstForm) {
    throw new RecordingError(
      "is a recording of form 1, and this page reads form 2: use the version of HL that made it");
  }
  if (magic !== kMagic) {
    throw new RecordingError("is no recording of HL");
  }
}

async function nextBlock(pieces: Pieces): Promise<RecordingBlock | undefined> {
  if (pieces.left < kHead_bytes) {
    return undefined;
  }
  const head = new DataView((await pieces.take(kHead_bytes)).buffer);
  const [packed, raw, checksum] = [0, 4, 8].map((at) => head.getUint32(at, true)) as [number, number, number];
  if (packed > pieces.left || raw > kMaxPacking * packed) {
    return undefined;
  }
  if (raw > kMaxBlock_bytes) {
    throw new RecordingError("has a mesh that is too large for the page: use hl replay");
  }
  const bytes = await pieces.take(packed);
  if (crc32(bytes) !== checksum) {
    return undefined;
  }
  try {
    return fromBinary(RecordingBlockSchema, await unpack(bytes, raw));
  } catch {
    return undefined;
  }
}

/** Exactly `size` bytes, or an error: a wrong block takes no more memory than its head says. */
async function unpack(packed: Uint8Array<ArrayBuffer>, size: number): Promise<Uint8Array> {
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const reader = stream.getReader();
  const raw = new Uint8Array(size);
  let filled = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) {
      break;
    }
    if (filled + value.length > size) {
      await reader.cancel();
      throw new RecordingError("has a damaged block");
    }
    raw.set(value, filled);
    filled += value.length;
  }
  if (filled !== size) {
    throw new RecordingError("has a damaged block");
  }
  return raw;
}

const kCrcTable = Uint32Array.from({ length: 256 }, (_, n) => {
  let crc = n;
  for (let bit = 0; bit < 8; ++bit) {
    crc = crc & 1 ? 0xedb88320 ^ (crc >>> 1) : crc >>> 1;
  }
  return crc;
});

/** As zlib's. */
export function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc = kCrcTable[(crc ^ byte) & 0xff]! ^ (crc >>> 8);
  }
  return (crc ^ 0xffffffff) >>> 0;
}
