// Between bytes of the WebSocket and values the page can trust. Generated code does the wire format; scene_messages
// checks lengths, indices and numbers, so that no broken message reaches the renderer.

import { create, fromBinary, toBinary } from "@bufbuild/protobuf";
import {
  ServerMessageSchema,
  ViewerMessageSchema,
  type Hello,
  type LedgerMode,
  type Notice,
  type State,
} from "./gen/hl_pb";
import { checkLayout, checkMesh, checkMoves, type Layout, type Mesh, type Moves } from "./scene_messages";
import type { SurfaceSettings } from "./surfaces";
import type { Vec } from "./vec";
import { ProtocolError } from "./wire_values";

/** Must equal the server's; see Hello.protocol_version. */
export const kProtocolVersion = 2;

export type Incoming =
  | { readonly kind: "hello"; readonly hello: Hello }
  | { readonly kind: "mesh"; readonly mesh: Mesh }
  | { readonly kind: "layout"; readonly layout: Layout }
  | { readonly kind: "forget"; readonly meshes: readonly number[] }
  | { readonly kind: "state"; readonly state: State; readonly moves: Moves }
  | { readonly kind: "notice"; readonly notice: Notice }
  | { readonly kind: "unknown" };

/** Throws ProtocolError on anything malformed. */
export function decodeServerMessage(bytes: Uint8Array): Incoming {
  let body;
  try {
    body = fromBinary(ServerMessageSchema, bytes).body;
  } catch (error) {
    throw new ProtocolError(`the server sent a message that cannot be read (${String(error)})`);
  }
  switch (body.case) {
    case "hello":
      return { kind: "hello", hello: body.value };
    case "mesh":
      return { kind: "mesh", mesh: checkMesh(body.value) };
    case "layout":
      return { kind: "layout", layout: checkLayout(body.value) };
    case "forget":
      return { kind: "forget", meshes: body.value.meshes };
    case "state":
      return { kind: "state", state: body.value, moves: checkMoves(body.value) };
    case "notice":
      return { kind: "notice", notice: body.value };
    default:
      return { kind: "unknown" };
  }
}

/** A unit quaternion. */
export interface Turned {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  readonly w: number;
}

export interface SettingsChange {
  explore?: boolean;
  handFirm?: boolean;
  stiffnessNM?: number;
  surfaces?: SurfaceSettings;
  ledger?: LedgerMode;
}

// `device`: number of one of several, whose hand, settings or fault the message is about.

export function encodeHandGoal(position: Vec, device = 0): Uint8Array<ArrayBuffer> {
  return encode({ case: "handGoal", value: { position } }, device);
}

/** The page is there: what it has left in a simulated hand is held on. */
export function encodeHere(): Uint8Array<ArrayBuffer> {
  return toBinary(ViewerMessageSchema, create(ViewerMessageSchema)) as Uint8Array<ArrayBuffer>;
}

export function encodeRelease(device = 0): Uint8Array<ArrayBuffer> {
  return encode({ case: "release", value: {} }, device);
}

/** Absent: as it is. */
export function encodeHandTurn(
  turned: Turned | undefined, gripper_rad: number | undefined, device = 0,
): Uint8Array<ArrayBuffer> {
  const rotation = turned && { x: turned.x, y: turned.y, z: turned.z, w: turned.w };
  return encode({ case: "handTurn", value: {
    ...(rotation && { rotation }), ...(gripper_rad !== undefined && { gripperRad: gripper_rad }) } }, device);
}

/** Bit i: button i of the device is down. */
export function encodePress(buttons: number, device = 0): Uint8Array<ArrayBuffer> {
  return encode({ case: "press", value: { buttons } }, device);
}

export function encodeRearm(device = 0): Uint8Array<ArrayBuffer> {
  return encode({ case: "rearm", value: {} }, device);
}

/** Begins or ends the recording with the number `owner`. */
export function encodeRecord(on: boolean, owner: number): Uint8Array<ArrayBuffer> {
  return encode({ case: "record", value: { on, owner } });
}

/** Another iso value for a surface of a volume, as a layout names it, and whether its matter is below it. */
export function encodeIso(surface: bigint, value: number, below: boolean): Uint8Array<ArrayBuffer> {
  return encode({ case: "iso", value: { surface, value, below } });
}

export function encodeSettings(change: SettingsChange, device = 0): Uint8Array<ArrayBuffer> {
  return encode({ case: "settings", value: change }, device);
}

type ViewerBody = NonNullable<Parameters<typeof create<typeof ViewerMessageSchema>>[1]>["body"];

function encode(body: NonNullable<ViewerBody>, device = 0): Uint8Array<ArrayBuffer> {
  return toBinary(ViewerMessageSchema, create(ViewerMessageSchema, { body, device })) as Uint8Array<ArrayBuffer>;
}
