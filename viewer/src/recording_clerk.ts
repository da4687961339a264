// What the page asks of the server's recorder, and what is to be shown of the answers. A recording is asked for again
// and again: a page that has gone asks no more, and its recording ends.

import { PageRecording_Phase as Phase, type PageRecording } from "./gen/hl_pb";
import { formatFixed, formatSi } from "./units";

/** Between two messages; the server waits for five seconds. */
const kAsk_ms = 1000;

export interface RecordingNews {
  /** This page's recording begins or runs. */
  readonly own: boolean;
  /** Another page's does. */
  readonly ofAnother: boolean;
  /** To be shown while there is something to report. */
  readonly line: string;
  readonly limits: string;
  /** Once: why there is no recording. */
  readonly refused?: string;
  /** Once: the owner of the file that is to be fetched, and why it has ended. */
  readonly ready?: number;
  readonly end?: string;
}

export class RecordingClerk {
  /** What this page has asked for and not got yet. */
  private owner_: number | undefined;
  private on_ = false;
  private asked_ms_ = -Infinity;
  private heard_ = false;

  constructor(private readonly send_: (on: boolean, owner: number) => void) {}

  /** The button: begins a recording under a new number, or ends this page's own. */
  press(newOwner: number): void {
    this.on_ = this.owner_ === undefined;
    if (this.on_) {
      this.heard_ = false;
    }
    this.owner_ ??= newOwner;
    this.asked_ms_ = -Infinity;
    this.send_(this.on_, this.owner_);
  }

  hear(recording: PageRecording | undefined, now_ms: number): RecordingNews {
    const { phase = Phase.NONE, owner = 0 } = recording ?? {};
    const active = phase === Phase.STARTING || phase === Phase.RUNNING;
    const mine = owner !== 0 && owner === this.owner_;
    const common = {
      own: this.owner_ !== undefined, ofAnother: active && !mine, limits: limitsOf(recording),
      line: active ? lineOf(recording!, mine) : "",
    };
    if (mine && phase === Phase.READY) {
      this.forget();
      return { ...common, own: false, ready: owner, end: recording!.text };
    }
    if (this.owner_ !== undefined && ((mine && phase === Phase.NONE) || (this.heard_ && !mine) || (active && !mine))) {
      const why = (mine && recording!.text) || (active ? "another page records" : "the server has given it up");
      this.forget();
      return { ...common, own: false, refused: `There is no recording: ${why}.` };
    }
    this.heard_ ||= mine;
    if (this.owner_ !== undefined && now_ms - this.asked_ms_ >= kAsk_ms) {
      this.asked_ms_ = now_ms;
      this.send_(this.on_, this.owner_);
    }
    return common;
  }

  private forget(): void {
    this.owner_ = undefined;
    this.heard_ = false;
  }
}

function limitsOf(recording: PageRecording | undefined): string {
  if (recording === undefined) {
    return "";
  }
  const most = `${Math.round(recording.maxTimeS / 60)} minutes or ${formatSi(Number(recording.maxBytes), "B")}`;
  return `Records the session on the server, at most ${most}, and saves it as a .hlr file when you stop it.`;
}

function lineOf({ timeS, bytes, maxTimeS }: PageRecording, mine: boolean): string {
  const soFar = `${formatFixed(timeS, "s", 0)} of ${formatFixed(maxTimeS, "s", 0)}, ${formatSi(Number(bytes), "B")}`;
  return mine ? `Recording: ${soFar}` : `Another page records: ${soFar}`;
}
