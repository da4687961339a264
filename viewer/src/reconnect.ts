// When to try the server again, and when to call it gone. Delays double from a quarter of a second to two seconds: a
// restarted server is found soon, a missing one costs nothing. Pure: time comes from outside.

export const kFirstDelay_ms = 250;
export const kLongestDelay_ms = 2000;

/** The server sends 60 states a second; this long without one is to be reported, and... */
export const kSilent_ms = 2500;
/** ...this long without one is a connection to give up, for instance a suspended server or a lost network. */
export const kGiveUp_ms = 8000;

export class ReconnectPolicy {
  private failures_ = 0;

  /** How long to wait before the next attempt, ms. */
  nextDelay(): number {
    const delay = Math.min(kLongestDelay_ms, kFirstDelay_ms * 2 ** this.failures_);
    this.failures_ += 1;
    return delay;
  }

  /** Data has come: the next loss starts with the short delay again. */
  succeeded(): void {
    this.failures_ = 0;
  }
}

export type Liveness = "live" | "silent" | "gone";

/** What `quiet_ms` without any message means on an open connection. */
export function liveness(quiet_ms: number): Liveness {
  if (quiet_ms >= kGiveUp_ms) return "gone";
  return quiet_ms >= kSilent_ms ? "silent" : "live";
}
