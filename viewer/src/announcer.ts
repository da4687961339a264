// What a screen reader says of the hand: one sentence when what is touched changes or the force changes much, and never
// more often than it can be listened to.

/** Seldom enough to be listened to. */
export const kAnnounce_ms = 2000;
/** A force that has changed by less is not worth a sentence. */
const kChange_N = 0.3;

export class Announcer {
  private said_ = "";
  private said_ms_ = -Infinity;
  private touching_ = "";
  private force_N_ = 0;
  private readonly say_: (text: string) => void;

  constructor(say: (text: string) => void) {
    this.say_ = say;
  }

  /** `touched`: what is touched, in words; empty when nothing is. */
  hear(touched: string, force_N: number, now_ms: number): void {
    const known_N = Number.isFinite(force_N) ? force_N : 0;
    const same = touched === this.touching_ && (touched === "" || Math.abs(known_N - this.force_N_) < kChange_N);
    if (same || now_ms - this.said_ms_ < kAnnounce_ms) {
      return;
    }
    this.touching_ = touched;
    this.force_N_ = known_N;
    const text = touched === "" ? "touching nothing" : `touching ${touched}, ${known_N.toFixed(1)} N`;
    if (text !== this.said_) {
      this.said_ = text;
      this.said_ms_ = now_ms;
      this.say_(text);
    }
  }
}
