// The timeline: a recording in the place of the live session, at the time of a slider, and its plots.

import type { RecordingShown } from "../debug_state";
import { element, setText } from "../elements";
import { SafetyState } from "../gen/hl_pb";
import { LivePlot } from "../plots";
import type { Layout, Mesh } from "../scene_messages";
import { formatCount, formatFixed } from "../units";
import { Playback } from "./playback";
import { layoutOf, momentOf, type RecordedMoment } from "./recorded_moment";
import { StepColumn, type Recording } from "./recording";
import { envelope } from "./track";

export interface TimelineHooks {
  /** A recording is about to be shown. */
  opened(): void;
  /** The live session is to be shown again. */
  closed(): void;
  /** Another scene of the recording: meshes that are new, numbers of those that are not needed any more. */
  scene(layout: Layout, added: readonly Mesh[], gone: readonly number[]): void;
}

const kSafetyWords: Readonly<Record<SafetyState, string>> = {
  [SafetyState.OFF]: "off",
  [SafetyState.ARMING]: "arming",
  [SafetyState.ON]: "on",
  [SafetyState.FAULT]: "fault",
  [SafetyState.WAITING]: "waiting",
};
/** Numbers that change faster than this cannot be read. */
const kNumbersPeriod_ms = 100;
/** Decimals of the times. */
const kTimeDigits = 2;

interface Shown {
  readonly recording: Recording;
  readonly playback: Playback;
  scene: number | undefined;
  meshes: ReadonlySet<number>;
  time_s: number;
}

export class Timeline {
  private shown_: Shown | undefined;
  private numbers_ms_ = 0;
  private readonly slider_ = element<HTMLInputElement>("timeline-at");
  private plots_: { force: LivePlot; penetration: LivePlot } | undefined;

  constructor(private readonly hooks_: TimelineHooks) {
    element("timeline-close").addEventListener("click", () => this.close());
    element("timeline-play").addEventListener("click", () => this.toggle());
    this.slider_.addEventListener("input", () => this.shown_?.playback.seek(this.slider_.valueAsNumber));
    for (const radio of document.querySelectorAll<HTMLInputElement>("input[name=speed]")) {
      radio.addEventListener("change", () => this.shown_?.playback.setSpeed(Number(radio.value)));
    }
    window.addEventListener("keydown", (event) => this.key(event));
  }

  get isOpen(): boolean {
    return this.shown_ !== undefined;
  }

  get recording(): RecordingShown | undefined {
    const playback = this.shown_?.playback;
    return playback && {
      begin_s: playback.begin_s, end_s: playback.end_s, time_s: playback.time_s, playing: playback.playing,
    };
  }

  open(recording: Recording, name: string): void {
    if (this.isOpen) {
      this.close();
    }
    this.hooks_.opened();
    const playback = new Playback(recording.begin_s, recording.end_s);
    this.shown_ = { recording, playback, scene: undefined, meshes: new Set(), time_s: NaN };
    document.documentElement.dataset.mode = "recorded";
    setText("recorded-name", name);
    element("recorded-name").title = name;
    setText("recorded-origin", originOf(recording));
    // In this order: a slider cuts a bound that contradicts the other one.
    this.slider_.max = String(playback.end_s);
    const step_s = Math.min(0.01, playback.length_s / 100) || 0.01;
    // Its steps count from there: round times are on it.
    this.slider_.min = String(Math.floor(playback.begin_s / step_s) * step_s);
    this.slider_.step = String(step_s);
    document.querySelector<HTMLInputElement>("input[name=speed][value='1']")!.checked = true;
    this.showPlots();
    this.slider_.focus();
  }

  close(): void {
    if (!this.isOpen) {
      return;
    }
    this.shown_ = undefined;
    delete document.documentElement.dataset.mode;
    this.hooks_.closed();
    element("canvas").focus();
  }

  /** Once per drawn frame; what there is to see now, if a recording is open. */
  frame(now_ms: number): RecordedMoment | undefined {
    const shown = this.shown_;
    if (shown === undefined) {
      return undefined;
    }
    const { recording, playback } = shown;
    playback.advance(now_ms);
    const moment = momentOf(recording, playback.time_s);
    if (moment.scene !== shown.scene) {
      this.changeScene(shown, moment);
    }
    if (playback.time_s !== shown.time_s) {
      shown.time_s = playback.time_s;
      this.showTime(playback);
    }
    setText("timeline-play", playback.playing ? "Pause" : "Play");
    if (now_ms - this.numbers_ms_ >= kNumbersPeriod_ms) {
      this.numbers_ms_ = now_ms;
      showNumbers(moment);
    }
    return moment;
  }

  applyTheme(): void {
    Object.values(this.plots_ ?? {}).forEach((plot) => plot.applyTheme());
  }

  private toggle(): void {
    this.shown_?.playback.toggle(performance.now());
  }

  private changeScene(shown: Shown, { scene, scale }: RecordedMoment): void {
    const { recording, meshes, playback } = shown;
    const layout = layoutOf(recording, scene, scale, playback.time_s);
    const needed = new Set(layout.placed.map(({ mesh }) => mesh));
    const added = recording.meshes.filter(({ number }) => needed.has(number) && !meshes.has(number));
    shown.scene = scene;
    shown.meshes = needed;
    this.hooks_.scene(layout, added, [...meshes].filter((number) => !needed.has(number)));
  }

  private showTime({ time_s, end_s }: Playback): void {
    const of = (seconds: number) => formatFixed(seconds, "s", kTimeDigits);
    this.slider_.value = String(time_s);
    this.slider_.setAttribute("aria-valuetext", `${of(time_s)} of ${of(end_s)}`);
    setText("timeline-time", `${of(time_s)} / ${of(end_s)}`);
    Object.values(this.plots_ ?? {}).forEach((plot) => plot.redraw());
  }

  /** They are made when there is a place for them. */
  private showPlots(): void {
    this.plots_ ??= {
      force: this.plotIn("plot-recorded-force", "N", "force", 1),
      penetration: this.plotIn("plot-recorded-penetration", "mm", "penetration", 0.1),
    };
    const { steps } = this.shown_!.recording;
    const { force, penetration } = this.plots_;
    force.show(envelope(steps, StepColumn.kForce_N, force.buckets));
    const [times, metres] = envelope(steps, StepColumn.kPenetration_m, penetration.buckets);
    penetration.show([times, metres.map((value) => 1e3 * value)]);
  }

  private plotIn(id: string, unit: string, colour: string, smallestTop: number): LivePlot {
    const host = element(id);
    const whole = {
      begin_s: () => this.shown_?.playback.begin_s ?? 0,
      end_s: () => this.shown_?.playback.end_s ?? 1,
      now_s: () => this.shown_?.playback.time_s ?? 0,
    };
    const plot = new LivePlot(host, { unit, series: [{ colour, fill: true }], smallestTop, whole });
    const seek = (event: PointerEvent) => {
      const playback = this.shown_?.playback;
      if (event.buttons === 1 && playback !== undefined) {
        playback.seek(playback.begin_s + playback.length_s * plot.shareAt(event.clientX - host.getBoundingClientRect().left));
      }
    };
    host.addEventListener("pointerdown", (event) => {
      host.setPointerCapture(event.pointerId);
      seek(event);
    });
    host.addEventListener("pointermove", seek);
    return plot;
  }

  private key(event: KeyboardEvent): void {
    const taken = event.ctrlKey || event.altKey || event.metaKey || event.repeat;
    if (!this.isOpen || taken || element<HTMLDialogElement>("help").open) {
      return;
    }
    if (event.key === "Escape") {
      event.preventDefault();
      this.close();
    } else if (event.key === " " && !isPressable(event.target)) {
      event.preventDefault();
      this.toggle();
    }
  }
}

/** Space is theirs. */
function isPressable(target: EventTarget | null): boolean {
  return target instanceof Element &&
    target.closest("button, select, summary, input[type=checkbox], input[type=radio]") !== null;
}

function originOf({ device, begin_unix_ms, servoRate_Hz, end, fault, steps }: Recording): string {
  const begin = new Date(begin_unix_ms).toLocaleString();
  const why = fault === "" ? `ended: ${end}` : `fault: ${fault}`;
  const count = formatCount(steps.times.length);
  return `${device}, ${begin}; ${count} steps at ${formatFixed(servoRate_Hz, "Hz", 0)}; ${why}`;
}

function showNumbers({ force_N, penetration_m, contacts, state }: RecordedMoment): void {
  setText("recorded-force", formatFixed(force_N, "N", 2));
  setText("force-badge", formatFixed(force_N, "N", 2));
  setText("recorded-penetration", formatFixed(1e3 * penetration_m, "mm", 2));
  setText("recorded-contacts", formatCount(contacts));
  setText("recorded-safety", kSafetyWords[state.safety] ?? `state ${state.safety}`);
}
