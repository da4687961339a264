// What the states sound like while the sound is on.

import type { State } from "./gen/hl_pb";
import type { SampleRing } from "./samples";
import { Sound } from "./sound";
import { deviation, levelsOf } from "./sound_levels";
import { length, sub, type Vec } from "./vec";
import { knownVec } from "./wire_values";

/** The ripple that is heard is that of so long a time. */
const kRipple_s = 0.05;

export class TouchSound {
  private readonly sound_ = new Sound();
  private limit_N_ = 0;
  private last_: { proxy: Vec; time_s: number } | undefined;

  setOn(on: boolean): void {
    this.sound_.setOn(on);
  }

  /** The most that the device can do. */
  setLimit(limit_N: number): void {
    this.limit_N_ = limit_N;
  }

  /** No state comes any more. */
  silence(): void {
    this.last_ = undefined;
    this.sound_.show(levelsOf({ force_N: 0, limit_N: 1, ripple_N: 0, speed_m_s: 0, slipping: false }));
  }

  /** `forces`: channel 0. */
  hear(state: State, forces: SampleRing, worldPerHand: number): void {
    if (!this.sound_.on) {
      return;
    }
    const force = knownVec(state.forceN);
    const speed_m_s = this.speedTo(knownVec(state.proxy), state.timeS) / worldPerHand;
    const ripple_N = deviation(forces.last(0, kRipple_s).values);
    const force_N = force === undefined ? 0 : length(force);
    this.sound_.show(levelsOf({ force_N, limit_N: this.limit_N_, ripple_N, speed_m_s, slipping: state.slipping }));
  }

  private speedTo(proxy: Vec | undefined, time_s: number): number {
    const last = this.last_;
    this.last_ = proxy && { proxy, time_s };
    return proxy && last && time_s > last.time_s ? length(sub(proxy, last.proxy)) / (time_s - last.time_s) : 0;
  }
}
