// What a page shows of a server with several devices: one row for each, the first one included. No DOM: it can be
// tested alone.

import { SafetyState, type Hello, type State } from "./gen/hl_pb";
import type { HandChoice } from "./moved_hands";
import { formatFixed } from "./units";
import { length } from "./vec";
import { knownVec } from "./wire_values";

export interface DeviceRow {
  readonly label: string;
  /** The maker and the model. */
  readonly model: string;
  readonly safety: SafetyState;
  readonly force: string;
  /** Why it is in fault; "": it is not. */
  readonly fault: string;
}

type Reported = Pick<State, "forceN" | "safety" | "fault">;

function rowOf(label: string, model: string, reported: Reported): DeviceRow {
  const force = knownVec(reported.forceN);
  return {
    label, model, safety: reported.safety, force: formatFixed(force && length(force), "N", 2),
    fault: reported.safety === SafetyState.FAULT ? reported.fault || "The server gave no reason." : "",
  };
}

/** None: the server has one device. */
export function deviceRows(hello: Hello | undefined, state: State | undefined): DeviceRow[] {
  const devices = hello?.devices ?? [];
  if (devices.length < 2 || state === undefined) {
    return [];
  }
  return devices.flatMap((device, number) => {
    const reported = number === 0 ? state : state.others[number - 1];
    return reported === undefined ? [] : [rowOf(device.label, device.name, reported)];
  });
}

/** What the control says that lets the hands explore which the page moves; `label` of the chosen one. */
export function exploreText({ simulated, together }: HandChoice, label: string): string {
  if (simulated.length < 2) {
    return "Explore by itself";
  }
  return together ? "All explore by themselves" : `Explore by itself: ${label}`;
}
