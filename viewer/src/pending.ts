// What the user has just set, until the server says the same. States already on their way are older than the click, so
// they must not turn the control back; and a control under the pointer must not move, whatever another page does.

/** For so long states may be on their way that were sent before the server heard of the change. */
export const kUnderway_ms = 700;
/** After so long the server wins: it has cut the value, or another page has set it anew. */
export const kGiveUp_ms = 2500;

interface Entry<Value> {
  value: Value;
  since_ms: number;
  held: boolean;
  changed: boolean;
  /** The server has said the same since. */
  echoed: boolean;
}

export interface PendingOptions<Value> {
  /** For so long a server is waited for that has not said the same; kGiveUp_ms unless given. */
  readonly giveUp_ms?: number;
  /** Whether the server has said what was set, as precisely as it keeps it. */
  readonly same?: (set: Value, said: Value) => boolean;
}

/** One entry per control, by its name. Times in milliseconds of any one clock. */
export class Pending<Value> {
  private readonly entries_ = new Map<string, Entry<Value>>();
  private readonly giveUp_ms_: number;
  private readonly same_: (set: Value, said: Value) => boolean;

  constructor({ giveUp_ms = kGiveUp_ms, same = Object.is }: PendingOptions<Value> = {}) {
    this.giveUp_ms_ = giveUp_ms;
    this.same_ = same;
  }

  /** The user has set the control. */
  set(control: string, value: Value, now_ms: number): void {
    const held = this.entries_.get(control)?.held ?? false;
    this.entries_.set(control, { value, since_ms: now_ms, held, changed: true, echoed: false });
  }

  /** The pointer has gone down on the control, which shows `value`: it stays until the pointer lets go. */
  hold(control: string, value: Value, now_ms: number): void {
    const old = this.entries_.get(control) ?? { value, since_ms: now_ms, changed: false, echoed: false };
    this.entries_.set(control, { ...old, held: true });
  }

  /** The pointer has let go of whatever it held. */
  letGo(now_ms: number): void {
    for (const [control, entry] of this.entries_) {
      if (entry.held && !entry.changed) {
        this.entries_.delete(control);
      } else if (entry.held) {
        this.entries_.set(control, { ...entry, held: false, since_ms: now_ms });
      }
    }
  }

  /** What the control shows when the server says `said`. */
  resolve<Said extends Value>(control: string, said: Said, now_ms: number): Said {
    const entry = this.entries_.get(control);
    if (entry === undefined) {
      return said;
    }
    entry.echoed ||= this.same_(entry.value, said);
    const age_ms = now_ms - entry.since_ms;
    if (!entry.held && age_ms > (entry.echoed ? kUnderway_ms : this.giveUp_ms_)) {
      this.entries_.delete(control);
      return said;
    }
    return entry.value as Said;
  }

  /** The control is about something else now. */
  forget(control: string): void {
    this.entries_.delete(control);
  }

  /** The server knows nothing of what was set before, because it is another one. */
  clear(): void {
    this.entries_.clear();
  }
}
