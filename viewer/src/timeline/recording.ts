// A recording as the page shows it.

import type { Mesh } from "../scene_messages";
import type { SurfaceSettings } from "../surfaces";
import type { BodyTrack } from "./body_tracks";
import type { Way } from "./recorded_values";
import type { Track } from "./track";

export interface RecordedInstance {
  /** Number of a mesh. */
  readonly mesh: number;
  readonly ways: readonly [Way, Way];
  /** Number of its track in Recording.bodies; -1: it is no body, or was not seen moving. */
  readonly body: number;
  readonly session: number;
  readonly object: number;
  readonly name: number;
  readonly materials: readonly SurfaceSettings[];
  /** What its file calls it; empty: nothing. */
  readonly label: string;
  /** Red, green and blue that its file gives it; empty: none. */
  readonly colour: Uint8Array;
}

export interface RecordedScene {
  readonly name: string;
  readonly instances: readonly RecordedInstance[];
}

/** Of ticks, from a moment on. */
export interface Scale {
  readonly from_s: number;
  readonly radius_m: number;
  readonly worldPerDevice: number;
}

/** Columns of Recording.steps. Finger: device frame. */
export const enum StepColumn {
  kForce_N, kPenetration_m, kForceX, kForceY, kForceZ, kFingerX, kFingerY, kFingerZ, kSafety,
  kTurnedX, kTurnedY, kTurnedZ, kTurnedW, kGripper_rad,
}
export const kStepColumns = 14;
/** Columns of Recording.ticks. World frame. */
export const enum TickColumn { kContacts, kScene, kProxyX, kProxyY, kProxyZ, kFingerX, kFingerY, kFingerZ }
export const kTickColumns = 8;

export interface Recording {
  readonly version: string;
  readonly device: string;
  readonly begin_unix_ms: number;
  readonly servoRate_Hz: number;
  readonly blackBox: boolean;
  /** Reason of a black box. */
  readonly fault: string;
  /** Why it ends. */
  readonly end: string;
  /** Times of the first and the last step; 0 is when the recording began, as in the table of `hl replay --csv`. */
  readonly begin_s: number;
  readonly end_s: number;
  readonly steps: Track;
  readonly ticks: Track;
  readonly scales: readonly Scale[];
  readonly meshes: readonly Mesh[];
  readonly scenes: readonly RecordedScene[];
  readonly bodies: readonly BodyTrack[];
}
