// The clock of a recording that is shown: it stands, or goes on at a share of the real speed to its end.

export class Playback {
  private time_s_: number;
  private since_ms_: number | undefined;
  private speed_ = 1;

  constructor(readonly begin_s: number, readonly end_s: number) {
    this.time_s_ = begin_s;
  }

  get time_s(): number {
    return this.time_s_;
  }

  get length_s(): number {
    return this.end_s - this.begin_s;
  }

  get playing(): boolean {
    return this.since_ms_ !== undefined;
  }

  /** Seconds of the recording for one of the user. */
  setSpeed(speed: number): void {
    this.speed_ = speed;
  }

  /** From the end it begins anew. */
  toggle(now_ms: number): void {
    if (this.playing) {
      this.since_ms_ = undefined;
      return;
    }
    if (this.time_s_ >= this.end_s) {
      this.time_s_ = this.begin_s;
    }
    this.since_ms_ = now_ms;
  }

  seek(time_s: number): void {
    this.time_s_ = Math.min(Math.max(this.begin_s, time_s), this.end_s);
  }

  /** To be called in each frame. */
  advance(now_ms: number): void {
    if (this.since_ms_ === undefined) {
      return;
    }
    this.seek(this.time_s_ + (1e-3 * (now_ms - this.since_ms_)) * this.speed_);
    this.since_ms_ = this.time_s_ >= this.end_s ? undefined : now_ms;
  }
}
