// window.__hl: what the page knows, read-only, for tests and for the curious in the browser's console.

import { LedgerMode, SafetyState, type State } from "./gen/hl_pb";
import type { LinkState } from "./connection";
import { handOf, type HandState } from "./hand_state";
import type { LiveScene } from "./live_scene";
import type { SampleRing } from "./samples";
import type { HandChoice } from "./moved_hands";
import { settingsOf, type SurfaceSettings } from "./surfaces";
import { turnOf } from "./stylus_turn";
import { length, sub, type Vec } from "./vec";
import { kPoseNumbers } from "./scene_messages";
import { knownVec } from "./wire_values";

export interface DebugSources {
  link(): LinkState;
  scene(): LiveScene;
  state(): State | undefined;
  samples(): SampleRing;
  holding(): boolean;
  choice(): HandChoice;
  recording(): RecordingShown | undefined;
  project(point: Vec): { x: number; y: number; depth_m: number };
}

export interface RecordingShown {
  readonly begin_s: number;
  readonly end_s: number;
  readonly time_s: number;
  readonly playing: boolean;
}

export interface DebugState {
  readonly link: LinkState;
  readonly sceneName: string | undefined;
  /** Of all objects in the scene, each counted. */
  readonly triangles: number;
  readonly objects: number;
  /** Kinds of objects that the page keeps. */
  readonly meshes: number;
  readonly layout: number | undefined;
  /** Indices of the objects that are touched. */
  readonly touched: readonly number[];
  readonly boundsMin: Vec | undefined;
  readonly boundsMax: Vec | undefined;
  readonly proxyRadius_m: number | undefined;
  readonly worldPerDevice: number | undefined;
  readonly time_s: number | undefined;
  readonly finger: Vec | undefined;
  readonly proxy: Vec | undefined;
  readonly force_N: Vec | undefined;
  /** How the stylus is turned: x y z w. */
  readonly stylus: readonly number[] | undefined;
  readonly gripper_rad: number | undefined;
  /** World distance between proxy and finger. */
  readonly separation_m: number | undefined;
  readonly contacts: number;
  /** Which hand the page moves. */
  readonly choice: HandChoice;
  /** Of each device of the server, by number. */
  readonly hands: readonly HandState[];
  /** Hands of other servers of a shared world. */
  readonly remoteHands: readonly { readonly server: string; readonly proxy: Vec | undefined }[];
  /** Index of the layout's snap that holds the proxy. */
  readonly snap: number | undefined;
  readonly safety: string;
  /** Why the force is off, in the server's words; empty where nothing is wrong. */
  readonly fault: string;
  readonly exploring: boolean;
  /** What the user has set over the scene's surfaces. */
  readonly surfaces: SurfaceSettings;
  readonly ledger: string;
  readonly holding: boolean;
  /** The recording that is shown in the place of the live session. */
  readonly recording: RecordingShown | undefined;
  readonly samples: number;
  /** Where the origin of an object is now. */
  originOf(object: number): Vec;
  /** Largest force and penetration among the samples of the last `window_s` seconds. */
  peak(window_s: number): { force_N: number; penetration_m: number };
  /** Where a world point is on the canvas, CSS pixels, and how far along the view. */
  project(point: Vec): { x: number; y: number; depth_m: number };
}

declare global {
  interface Window {
    readonly __hl: DebugState;
  }
}

export function publishDebugState(sources: DebugSources): void {
  Object.defineProperty(window, "__hl", { value: Object.freeze(makeDebugState(sources)) });
}

function makeDebugState(sources: DebugSources): DebugState {
  return {
    get link() { return sources.link(); },
    get sceneName() { return sources.scene().layout?.name; },
    get triangles() { return sources.scene().store.counts().triangles; },
    get objects() { return sources.scene().store.counts().objects; },
    get meshes() { return sources.scene().store.meshes.size; },
    get layout() { return sources.scene().layout?.number; },
    get touched() { return sources.scene().touched; },
    get boundsMin() { return sources.scene().layout?.bounds?.min; },
    get boundsMax() { return sources.scene().layout?.bounds?.max; },
    get proxyRadius_m() { return sources.scene().layout?.proxyRadius_m; },
    get worldPerDevice() { return sources.scene().layout?.worldPerDevice; },
    get time_s() { return sources.state()?.timeS; },
    get finger() { return knownVec(sources.state()?.finger); },
    get proxy() { return knownVec(sources.state()?.proxy); },
    get force_N() { return knownVec(sources.state()?.forceN); },
    get gripper_rad() { return sources.state()?.stylus?.gripperRad; },
    get stylus() { return turnOf(sources.state()?.stylus?.rotation)?.toArray(); },
    get separation_m() {
      const proxy = knownVec(sources.state()?.proxy);
      const finger = knownVec(sources.state()?.finger);
      return proxy === undefined || finger === undefined ? undefined : length(sub(proxy, finger));
    },
    get remoteHands() {
      return (sources.state()?.remote ?? []).map(({ server, proxy }) => ({ server, proxy: knownVec(proxy) }));
    },
    get choice() { return sources.choice(); },
    get hands() {
      const state = sources.state();
      return state === undefined ? [] : [state, ...state.others].map((_, device) => handOf(state, device)!);
    },
    get contacts() { return sources.state()?.contacts.length ?? 0; },
    get snap() { return sources.scene().marks.held; },
    get safety() { return SafetyState[sources.state()?.safety ?? SafetyState.OFF] ?? "OFF"; },
    get fault() { return sources.state()?.fault ?? ""; },
    get surfaces() { return settingsOf(sources.state()?.surfaces); },
    get ledger() { return LedgerMode[sources.state()?.ledger?.mode ?? LedgerMode.TANK]; },
    get exploring() { return sources.state()?.exploring ?? false; },
    get holding() { return sources.holding(); },
    get recording() { return sources.recording(); },
    get samples() { return sources.samples().size; },
    originOf: (object) => {
      const [x, y, z] = [3, 7, 11].map((i) => sources.scene().store.poses[kPoseNumbers * object + i] ?? NaN);
      return { x: x!, y: y!, z: z! };
    },
    peak: (window_s) => {
      const ring = sources.samples();
      const from_s = (ring.latestTime ?? 0) - window_s;
      return { force_N: ring.maximum(0, from_s), penetration_m: ring.maximum(1, from_s) };
    },
    project: (point) => sources.project(point),
  };
}
