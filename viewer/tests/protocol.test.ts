// The wire: what a good server sends arrives whole; what a broken one sends is refused with a sentence, never drawn.
import { create, fromBinary, toBinary, type MessageInitShape } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import {
  ServerMessageSchema, SurfaceImageSchema, SurfacePartSchema, ViewerMessageSchema, type SceneLayout, type SceneMesh,
} from "../src/gen/hl_pb";
import {
  decodeServerMessage, encodeHandGoal, encodeRearm, encodeRelease, encodeSettings,
} from "../src/protocol";
import type { Layout, Mesh } from "../src/scene_messages";
import { knownVec, ProtocolError } from "../src/wire_values";

type Body = NonNullable<MessageInitShape<typeof ServerMessageSchema>["body"]>;
type MeshInit = Partial<Omit<SceneMesh, "$typeName" | "$unknown" | "boundsMin" | "boundsMax">>;

function encode(body: Body): Uint8Array {
  return toBinary(ServerMessageSchema, create(ServerMessageSchema, { body }));
}

function bytes(values: Float32Array | Uint32Array): Uint8Array {
  return new Uint8Array(values.buffer);
}

const kTriangle: MeshInit = {
  number: 7,
  positions: bytes(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 2, -3)),
  normals: bytes(Float32Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1)),
  triangles: bytes(Uint32Array.of(0, 1, 2)),
  segments: bytes(Uint32Array.of(0, 2)),
  points: bytes(Uint32Array.of(1)),
};

const kImage = create(SurfaceImageSchema, { width: 2, height: 1, texels: Uint8Array.of(0, 255) });
const kPart = create(SurfacePartSchema, { firstTriangle: 0, triangles: 1, image: 0 });
const kTextured: MeshInit = {
  texcoords: bytes(Float32Array.of(0, 0, 1, 0, 0, 1)), images: [kImage], parts: [kPart],
};

function decodeMesh(change: MeshInit = {}): Mesh {
  const message = decodeServerMessage(encode({ case: "mesh", value: { ...kTriangle, ...change } }));
  if (message.kind !== "mesh") throw new Error("not a mesh");
  return message.mesh;
}

describe("meshes", () => {
  test("arrive as typed arrays, whatever their alignment in the message", () => {
    const whole = encode({ case: "mesh", value: kTriangle });
    for (const shift of [0, 1, 2, 3]) {
      const shifted = new Uint8Array(whole.length + shift);
      shifted.set(whole, shift);
      const message = decodeServerMessage(shifted.subarray(shift));
      if (message.kind !== "mesh") throw new Error("not a mesh");
      const mesh = message.mesh;
      expect(Array.from(mesh.positions)).toEqual([0, 0, 0, 1, 0, 0, 0, 2, -3]);
      expect(Array.from(mesh.triangles)).toEqual([0, 1, 2]);
      expect(Array.from(mesh.segments)).toEqual([0, 2]);
      expect(Array.from(mesh.points)).toEqual([1]);
      expect(mesh.normals).toHaveLength(9);
      expect(mesh.number).toBe(7);
    }
  });

  test("may have no normals and no bounds", () => {
    const mesh = decodeMesh({ normals: new Uint8Array() });
    expect(mesh.normals).toBeUndefined();
    expect(mesh.bounds).toBeUndefined();
  });

  test("bring their textures and the runs of triangles that show them", () => {
    const { texcoords, looks } = decodeMesh(kTextured);
    expect(Array.from(texcoords!)).toEqual([0, 0, 1, 0, 0, 1]);
    expect(looks).toHaveLength(1);
    expect(looks[0]!.runs).toEqual([{ first: 0, count: 1 }]);
    expect(Array.from(looks[0]!.image.texels)).toEqual([0, 255]);
    expect(decodeMesh().looks).toEqual([]);
  });

  test("bring pictures, which the browser reads", () => {
    const picture = create(SurfaceImageSchema, { file: Uint8Array.of(0x89, 0x50) });
    expect(Array.from(decodeMesh({ ...kTextured, images: [picture] }).looks[0]!.image.file)).toEqual([0x89, 0x50]);
    const empty = create(SurfaceImageSchema);
    expect(() => decodeMesh({ ...kTextured, images: [empty] })).toThrow("a texture of the scene is cut short");
  });

  test("bring a colour for each vertex, or none", () => {
    const colours = Uint8Array.of(1, 2, 3, 4, 5, 6, 253, 254, 255);
    expect(Array.from(decodeMesh({ colours }).colours!)).toEqual(Array.from(colours));
    expect(decodeMesh().colours).toBeUndefined();
  });

  test("may be empty", () => {
    const none = new Uint8Array();
    const mesh = decodeMesh({ positions: none, normals: none, triangles: none, segments: none, points: none });
    expect(mesh.positions).toHaveLength(0);
  });

  test.each<[string, MeshInit]>([
    ["an index out of range", { triangles: bytes(Uint32Array.of(0, 1, 3)) }],
    ["a segment out of range", { segments: bytes(Uint32Array.of(0, 0xffffffff)) }],
    ["half a triangle", { triangles: bytes(Uint32Array.of(0, 1)) }],
    ["half a float", { positions: new Uint8Array(10) }],
    ["half a vertex", { positions: new Uint8Array(8), normals: new Uint8Array() }],
    ["a position that is not a number", { positions: bytes(Float32Array.of(0, 0, NaN, 0, 0, 0, 0, 0, 0)) }],
    ["textures without coordinates", { images: [kImage], parts: [kPart] }],
    ["two material numbers for one triangle", { triangleMaterials: Uint8Array.of(1, 0, 1, 0) }],
    ["a material number cut short", { triangleMaterials: Uint8Array.of(1) }],
    ["a texture cut short", { ...kTextured, images: [{ ...kImage, width: 3 }] }],
    ["a part without its texture", { ...kTextured, parts: [{ ...kPart, image: 1 }] }],
    ["a part beyond the triangles", { ...kTextured, parts: [{ ...kPart, triangles: 2 }] }],
    ["too few colours", { colours: Uint8Array.of(1, 2, 3) }],
    ["too few normals", { normals: bytes(Float32Array.of(0, 0, 1)) }],
  ])("with %s are refused", (_what, change) => {
    expect(() => decodeMesh(change)).toThrow(ProtocolError);
  });
});

type LayoutInit = Partial<Omit<SceneLayout, "$typeName" | "$unknown" | "boundsMin" | "boundsMax" | "placed">>;

function decodeLayout(change: LayoutInit = {}): Layout {
  const poses = bytes(Float32Array.of(1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7));
  const value = { number: 3, name: "one", proxyRadius: 0.001, worldPerDevice: 2, placed: [{ mesh: 7 }], poses };
  const message = decodeServerMessage(encode({ case: "layout", value: { ...value, ...change } }));
  if (message.kind !== "layout") throw new Error("not a layout");
  return message.layout;
}

describe("layouts", () => {
  test("have one pose for each object", () => {
    const layout = decodeLayout();
    expect(layout).toMatchObject({ number: 3, name: "one", proxyRadius_m: 0.001, worldPerDevice: 2 });
    expect(layout.placed.map(({ mesh }) => mesh)).toEqual([7]);
    expect([3, 7, 11].map((i) => layout.poses[i])).toEqual([5, 6, 7]);
    expect(layout.bounds).toBeUndefined();
  });

  test.each<[string, LayoutInit]>([
    ["a pose too few", { poses: new Uint8Array() }],
    ["half a pose", { poses: new Uint8Array(24) }],
    ["a pose that is not a number", { poses: bytes(new Float32Array(12).fill(NaN)) }],
  ])("with %s are refused", (_what, change) => {
    expect(() => decodeLayout(change)).toThrow(ProtocolError);
  });

  test("so are states whose moves lack a pose", () => {
    expect(() => decodeServerMessage(encode({ case: "state", value: { layout: 3, moved: [0] } }))).toThrow(ProtocolError);
    const poses = bytes(new Float32Array(12));
    const message = decodeServerMessage(encode({ case: "state", value: { layout: 3, moved: [4], movedPoses: poses } }));
    if (message.kind !== "state") throw new Error("not a state");
    expect(message.moves).toMatchObject({ layout: 3, indices: [4] });
  });
});

test("garbage is refused, an unknown message is passed over", () => {
  expect(() => decodeServerMessage(Uint8Array.of(0x12, 0xff, 0x01))).toThrow(ProtocolError);
  expect(decodeServerMessage(new Uint8Array())).toEqual({ kind: "unknown" });
  expect(decodeServerMessage(Uint8Array.of(0xf8, 0x01, 0x05))).toEqual({ kind: "unknown" });
});

test("states keep samples in order and 64-bit counts whole", () => {
  const samples = [{ timeS: 1, forceN: 0.5 }, { timeS: 2, forceN: 1.5 }];
  const message = decodeServerMessage(
    encode({ case: "state", value: { timeS: 2, samples, proxyLoop: { deadlinesMissed: 2n ** 60n } } }),
  );
  if (message.kind !== "state") throw new Error("not a state");
  expect(message.state.samples.map((s) => s.timeS)).toEqual([1, 2]);
  expect(message.state.proxyLoop?.deadlinesMissed).toBe(2n ** 60n);
});

test("vectors that are absent or not finite are not known", () => {
  expect(knownVec(undefined)).toBeUndefined();
  const message = decodeServerMessage(
    encode({ case: "state", value: { finger: { x: NaN, y: 0, z: 0 }, proxy: { x: 1, y: 2, z: 3 } } }),
  );
  if (message.kind !== "state") throw new Error("not a state");
  expect(knownVec(message.state.finger)).toBeUndefined();
  expect(knownVec(message.state.proxy)).toEqual({ x: 1, y: 2, z: 3 });
});

test("what the page sends can be read back, and only what was changed is in it", () => {
  const read = (sent: Uint8Array) => fromBinary(ViewerMessageSchema, sent).body;
  expect(read(encodeHandGoal({ x: 1, y: -2, z: 0.5 }))).toMatchObject({
    case: "handGoal", value: { position: { x: 1, y: -2, z: 0.5 } },
  });
  expect(read(encodeRelease()).case).toBe("release");
  expect(read(encodeRearm()).case).toBe("rearm");
  const settings = read(encodeSettings({ explore: false }));
  if (settings.case !== "settings") throw new Error("not settings");
  expect(settings.value.explore).toBe(false);
  expect(settings.value.handFirm).toBeUndefined();
  expect(settings.value.stiffnessNM).toBeUndefined();
});
