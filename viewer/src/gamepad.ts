// A gamepad as the hand. Of a usual one the left stick moves in the plane of the view and the right one in depth; of a
// SpaceMouse, where the browser shows it as a gamepad, the cap's three translations do. Buttons are the device's.

import { kZero, type Vec } from "./vec";

/** What the page needs of the browser's Gamepad. */
export interface Pad {
  readonly id: string;
  readonly connected: boolean;
  readonly axes: readonly number[];
  readonly buttons: readonly { readonly pressed: boolean }[];
}

export interface PadState {
  /** x right, y up, z away from the viewer; each -1..1. */
  readonly direction: Vec;
  /** Bit i: button i is down. */
  readonly buttons: number;
}

/** Sticks do not come back to zero exactly. */
const kDead = 0.15;
/** As many buttons as the keys have. */
const kButtons = 4;
/** In browsers its axes are x, toward the user, down. */
const kSpaceMouse = /spacemouse|spacenavigator|3dconnexion/i;

export function padState(pads: readonly (Pad | null)[]): PadState {
  const pad = pads.find((one) => one?.connected === true);
  if (pad === undefined || pad === null) {
    return { direction: kZero, buttons: 0 };
  }
  const [a, b, c, d] = [0, 1, 2, 3].map((i) => live(pad.axes[i] ?? 0)) as [number, number, number, number];
  const direction = kSpaceMouse.test(pad.id) ? { x: a, y: -c, z: -b } : { x: a, y: -b, z: -d };
  const buttons = pad.buttons.slice(0, kButtons).reduce((bits, { pressed }, i) => bits | (pressed ? 1 << i : 0), 0);
  return { direction: { x: direction.x + 0, y: direction.y + 0, z: direction.z + 0 }, buttons };
}

/** Zero in the dead zone, and from there on without a jump. */
function live(value: number): number {
  const beyond = Math.abs(value) - kDead;
  return beyond > 0 ? (Math.sign(value) * Math.min(1, beyond / (1 - kDead))) : 0;
}
