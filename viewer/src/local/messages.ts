// The messages of a server, made from the engine's numbers in the order of web/hl_web.h.

import { create, toBinary } from "@bufbuild/protobuf";
import { ServerMessageSchema, type ServerMessage } from "../gen/hl_pb";
import { kProtocolVersion } from "../protocol";
import { Numbers, type Module } from "./engine";
import type { EngineQuantity } from "./quantities";

type Body = NonNullable<NonNullable<Parameters<typeof create<typeof ServerMessageSchema>>[1]>["body"]>;

const kContacts = 3;
/** Numbers of HlWebScene before those of the scene. */
const kOfDevice = 5;
const kRow = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

function encode(body: Body): Uint8Array<ArrayBuffer> {
  const message: ServerMessage = create(ServerMessageSchema, { body });
  return toBinary(ServerMessageSchema, message) as Uint8Array<ArrayBuffer>;
}

const bytesOf = (values: Float32Array | Uint32Array) => new Uint8Array(values.buffer, values.byteOffset, values.byteLength);

/** What a page is told first. */
export function helloMessage(
  module: Module, name: string, quantities: readonly EngineQuantity[],
): Uint8Array<ArrayBuffer> {
  const n = new Numbers(module, module._hlWebScene());
  const [forceMaxN, stiffnessNM, stiffnessMaxNM, dampingNsM, rate] = [n.next(), n.next(), n.next(), n.next(), n.next()];
  const device = {
    name: "simulated device in this browser", forceMaxN, stiffnessNM, stiffnessMaxNM, dampingNsM, servoRateHz: rate,
    proxyRateHz: rate, simulatedHand: true,
  };
  return encode({ case: "hello", value: {
    protocolVersion: kProtocolVersion, serverVersion: "browser", sceneName: name, device,
    quantities: quantities.filter(({ usual }) => usual > 0) } });
}

/** The mesh of the scene and its layout, both of this number; the one before is forgotten. */
export function sceneMessages(module: Module, name: string, number: number): Uint8Array<ArrayBuffer>[] {
  const n = new Numbers(module, module._hlWebScene());
  n.list(kOfDevice);
  const [boundsMin, boundsMax, proxyRadius, worldPerDevice] = [n.vec(), n.vec(), n.next(), n.next()];
  const [vertices, normals, triangles] = [n.next(), n.next(), n.next()];
  const floats = (pointer: number, count: number) =>
    bytesOf(Float32Array.from(module.HEAPF64.subarray(pointer / 8, pointer / 8 + 3 * count)));
  const first = module._hlWebTriangles() / 4;
  return [
    encode({ case: "mesh", value: {
      number, boundsMin, boundsMax, positions: floats(module._hlWebPositions(), vertices),
      normals: floats(normals > 0 ? module._hlWebNormals() : 0, normals),
      triangles: bytesOf(module.HEAPU32.slice(first, first + 3 * triangles)) } }),
    encode({ case: "layout", value: {
      number, name, boundsMin, boundsMax, proxyRadius, worldPerDevice, placed: [{ mesh: number }],
      poses: bytesOf(Float32Array.from(kRow)) } }),
    ...(number > 1 ? [encode({ case: "forget", value: { meshes: [number - 1] } })] : []),
  ];
}

export interface Sample { timeS: number; forceN: number; penetrationM: number; tickUs: number }

/** The rate is of the real clock. */
export function stateMessage(
  module: Module, samples: readonly Sample[], rateHz: number, surfaces: object, layout: number,
): Uint8Array<ArrayBuffer> {
  const n = new Numbers(module, module._hlWebState());
  const value = {
    timeS: n.next(), finger: n.vec(), proxy: n.vec(), forceN: n.vec(), safety: n.next(), fault: "",
  };
  const [fault, , slipping, exploring, firm, buttons, stiffnessNM] = n.list(7) as [
    number, number, number, number, number, number, number];
  const [limitNM, alarms, vibrationJ] = [n.next(), BigInt(n.next()), n.next()];
  const ledger = {
    tankJ: n.next(), injectedJ: n.next(), dissipatedJ: n.next(), shadingJ: n.next(), stiffnessJ: n.next(),
    textureJ: n.next(), movingJ: n.next(), lateJ: n.next(),
  };
  const big = () => BigInt(n.next());
  const ticksEnded = {
    reached: big(), stationary: big(), settled: big(), stalled: big(), postponed: big(), noEnergy: big(),
    crowded: big(), capped: big(), outOfWork: big(), unplaced: big(), invalid: big(),
  };
  const [steps, count] = [big(), n.next()];
  const contacts = Array.from({ length: kContacts }, () => ({
    point: n.vec(), normal: n.vec(), multiplierM: n.next(), staticFriction: n.next(), stiffness: n.next(),
  })).slice(0, count);
  if (fault !== 0) value.fault = module.UTF8ToString(module._hlWebFault());
  return encode({ case: "state", value: {
    ...value, contacts, slipping: slipping !== 0, exploring: exploring !== 0, handFirm: firm !== 0, buttons, stiffnessNM,
    vibration: { limitNM, alarms, dissipatedJ: vibrationJ }, ledger, ticksEnded, iterationCaps: ticksEnded.capped,
    unplacedTicks: ticksEnded.unplaced, servo: { rateHz, steps }, proxyLoop: { rateHz, steps }, layout,
    samples: [...samples], surfaces, touched: count > 0 ? [0] : [],
  } });
}
