// Whether the force vibrates: it swings widely about its mean, again and again, as when the spring is stiffer than
// device and hand can hold. One bump, a texture that is felt as a change of some tenths, or a slow push is none.

import { formatCount, kThinSpace } from "./units";

/** The last so many seconds are judged. */
export const kVibrationWindow_s = 0.3;
/** Swings below this, peak to peak, are no alarm. */
const kMin_N = 1;
/** Slower ones are a hand that moves. */
const kMin_Hz = 15;
/** Crossings of the mean count when the force goes this part of its swing beyond. */
const kBeyond = 0.15;
/** It is reported for at least so long after it has ceased. */
const kReported_s = 1;

export interface Swing {
  /** Peak to peak. */
  readonly force_N: number;
  readonly rate_Hz: number;
}

/** How the force swings; times in s, ascending. */
export function swingOf(times: readonly number[], forces_N: readonly number[]): Swing {
  const span_s = times.length > 1 ? times[times.length - 1]! - times[0]! : 0;
  if (!(span_s > 0)) {
    return { force_N: 0, rate_Hz: 0 };
  }
  const high = Math.max(...forces_N);
  const low = Math.min(...forces_N);
  const mean = forces_N.reduce((sum, force) => sum + force, 0) / forces_N.length;
  let [crossings, side] = [0, 0];
  for (const force of forces_N) {
    const now = Math.abs(force - mean) < kBeyond * (high - low) ? side : Math.sign(force - mean);
    crossings += side !== 0 && now !== side ? 1 : 0;
    side = now;
  }
  return { force_N: high - low, rate_Hz: crossings / 2 / span_s };
}

export class VibrationAlarm {
  private reported_: { swing: Swing; at_s: number } | undefined;

  /** What is to be reported to the user, if anything, at the time of the last sample. */
  judge(times: readonly number[], forces_N: readonly number[]): Swing | undefined {
    const now_s = times[times.length - 1] ?? 0;
    const swing = swingOf(times, forces_N);
    if (swing.force_N >= kMin_N && swing.rate_Hz >= kMin_Hz) {
      this.reported_ = { swing, at_s: now_s };
    } else if (this.reported_ !== undefined && Math.abs(now_s - this.reported_.at_s) > kReported_s) {
      this.reported_ = undefined;
    }
    return this.reported_?.swing;
  }
}

/** Why the servo holds the spring below a limit, and what ends it: only in the open the limit goes up. */
export function softenedWords(limit_N_m: number): string {
  return `The spring shook with the hand: it is held below ${formatCount(Math.round(limit_N_m))}${kThinSpace}N/m. ` +
    "Lift off: where nothing is touched it comes back, a tenth each second.";
}
