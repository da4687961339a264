// The wire: what a good server sends arrives whole; what a broken one sends is refused with a sentence, never drawn.
import { create, fromBinary, toBinary, type MessageInitShape } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import {
  ServerMessageSchema, SurfaceImageSchema, SurfacePartSchema, ViewerMessageSchema, type SceneMesh,
} from "../src/gen/hl_pb";
import {
  decodeServerMessage, encodeHandGoal, encodeRearm, encodeRelease, encodeSettings, knownVec, ProtocolError, type Scene,
} from "../src/protocol";

type Body = NonNullable<MessageInitShape<typeof ServerMessageSchema>["body"]>;
type SceneInit = Partial<Omit<SceneMesh, "$typeName" | "$unknown" | "boundsMin" | "boundsMax">>;

function encode(body: Body): Uint8Array {
  return toBinary(ServerMessageSchema, create(ServerMessageSchema, { body }));
}

function bytes(values: Float32Array | Uint32Array): Uint8Array {
  return new Uint8Array(values.buffer);
}

const kTriangle: SceneInit = {
  name: "one triangle",
  positions: bytes(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 2, -3)),
  normals: bytes(Float32Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1)),
  triangles: bytes(Uint32Array.of(0, 1, 2)),
  segments: bytes(Uint32Array.of(0, 2)),
  points: bytes(Uint32Array.of(1)),
  proxyRadius: 0.001,
  worldPerDevice: 2,
};

const kImage = create(SurfaceImageSchema, { width: 2, height: 1, texels: Uint8Array.of(0, 255) });
const kPart = create(SurfacePartSchema, { firstTriangle: 0, triangles: 1, image: 0 });
const kTextured: SceneInit = {
  texcoords: bytes(Float32Array.of(0, 0, 1, 0, 0, 1)), images: [kImage], parts: [kPart],
};

function decodeScene(change: SceneInit = {}): Scene {
  const message = decodeServerMessage(encode({ case: "scene", value: { ...kTriangle, ...change } }));
  if (message.kind !== "scene") throw new Error("not a scene");
  return message.scene;
}

describe("scenes", () => {
  test("arrive as typed arrays, whatever their alignment in the message", () => {
    for (const name of ["a", "ab", "abc", "abcd"]) {
      const scene = decodeScene({ name });
      expect(Array.from(scene.positions)).toEqual([0, 0, 0, 1, 0, 0, 0, 2, -3]);
      expect(Array.from(scene.triangles)).toEqual([0, 1, 2]);
      expect(Array.from(scene.segments)).toEqual([0, 2]);
      expect(Array.from(scene.points)).toEqual([1]);
      expect(scene.normals).toHaveLength(9);
      expect(scene).toMatchObject({ name, proxyRadius_m: 0.001, worldPerDevice: 2 });
    }
  });

  test("without bounds get those of their vertices, without normals none", () => {
    const scene = decodeScene({ normals: new Uint8Array() });
    expect(scene.normals).toBeUndefined();
    expect(scene.boundsMin).toEqual({ x: 0, y: 0, z: -3 });
    expect(scene.boundsMax).toEqual({ x: 1, y: 2, z: 0 });
  });

  test("bring their textures and the runs of triangles that show them", () => {
    const { texcoords, looks } = decodeScene(kTextured);
    expect(Array.from(texcoords!)).toEqual([0, 0, 1, 0, 0, 1]);
    expect(looks).toHaveLength(1);
    expect(looks[0]!.runs).toEqual([{ first: 0, count: 1 }]);
    expect(Array.from(looks[0]!.image.texels)).toEqual([0, 255]);
    expect(decodeScene().looks).toEqual([]);
  });

  test("may be empty", () => {
    const none = new Uint8Array();
    const scene = decodeScene({ positions: none, normals: none, triangles: none, segments: none, points: none });
    expect(scene.positions).toHaveLength(0);
    expect(scene.boundsMax).toEqual({ x: 0, y: 0, z: 0 });
  });

  test.each<[string, SceneInit]>([
    ["an index out of range", { triangles: bytes(Uint32Array.of(0, 1, 3)) }],
    ["a segment out of range", { segments: bytes(Uint32Array.of(0, 0xffffffff)) }],
    ["half a triangle", { triangles: bytes(Uint32Array.of(0, 1)) }],
    ["half a float", { positions: new Uint8Array(10) }],
    ["half a vertex", { positions: new Uint8Array(8), normals: new Uint8Array() }],
    ["a position that is not a number", { positions: bytes(Float32Array.of(0, 0, NaN, 0, 0, 0, 0, 0, 0)) }],
    ["textures without coordinates", { images: [kImage], parts: [kPart] }],
    ["a texture cut short", { ...kTextured, images: [{ ...kImage, width: 3 }] }],
    ["a part without its texture", { ...kTextured, parts: [{ ...kPart, image: 1 }] }],
    ["a part beyond the triangles", { ...kTextured, parts: [{ ...kPart, triangles: 2 }] }],
    ["too few normals", { normals: bytes(Float32Array.of(0, 0, 1)) }],
  ])("with %s are refused", (_what, change) => {
    expect(() => decodeScene(change)).toThrow(ProtocolError);
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
