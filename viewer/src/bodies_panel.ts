// The bodies of the scene on the page: how many move, their energies, and what hands, friction and contacts did to
// them. All energies in J.

import { element, setText } from "./elements";
import type { Bodies, State } from "./gen/hl_pb";
import { LivePlot } from "./plots";
import { SampleRing } from "./samples";
import { formatCount, formatSi } from "./units";

/** Part of the last second by which the bodies' time may stay behind before that is reported. */
const kSlow = 0.02;
/** Over so long the delay is judged. */
const kJudged_s = 1;
const kCapacity = 1200;

/** How much the bodies' time is behind, over the last second. */
export class SlowMotion {
  private begin_: { time_s: number; lost_s: number } | undefined;
  private part_ = 0;

  /** The part of the time that was lost, 0..1; undefined: too little to be reported. */
  judge(time_s: number, lost_s: number): number | undefined {
    const begin = this.begin_;
    if (begin === undefined || time_s < begin.time_s || lost_s < begin.lost_s) {
      this.begin_ = { time_s, lost_s };
      this.part_ = 0;
    } else if (time_s - begin.time_s >= kJudged_s) {
      this.part_ = (lost_s - begin.lost_s) / (time_s - begin.time_s);
      this.begin_ = { time_s, lost_s };
    }
    return this.part_ > kSlow ? Math.min(this.part_, 1) : undefined;
  }
}

/** The energies of one moment, those of height from the lowest that was seen. */
export interface BodyEnergies {
  readonly kinetic_J: number;
  readonly height_J: number;
  readonly spring_J: number;
}

export class BodiesPanel {
  private readonly samples_ = new SampleRing(kCapacity, 3);
  private readonly plot_ = new LivePlot(element("plot-bodies"), {
    unit: "J",
    series: ["kinetic", "height", "spring"].map((kind) => ({ colour: `energy-${kind}` })),
    smallestTop: 1e-3,
  });
  private readonly slow_ = new SlowMotion();
  private lowest_J = Infinity;

  forget(): void {
    this.samples_.clear();
    this.lowest_J = Infinity;
  }

  applyTheme(): void {
    this.plot_.applyTheme();
  }

  /** Each state. */
  take(state: State): void {
    const bodies = state.bodies;
    if (bodies === undefined) {
      return;
    }
    const { kinetic_J, height_J, spring_J } = this.energiesOf(bodies);
    this.samples_.push(state.timeS, kinetic_J, height_J, spring_J);
  }

  /** Once per drawn frame. Words for a notice, if the bodies' time is behind. */
  show(state: State, window_s: number): string | undefined {
    const bodies = state.bodies;
    element("bodies").hidden = bodies === undefined;
    if (bodies === undefined) {
      return undefined;
    }
    this.plot_.show(this.samples_.window(window_s, this.plot_.buckets));
    setText("bodies-count", `${formatCount(bodies.awake)} of ${formatCount(bodies.count)} awake`);
    setText("bodies-hand", formatSi(bodies.byHandJ, "J"));
    setText("bodies-friction", formatSi(bodies.frictionJ, "J"));
    setText("bodies-contact", formatSi(bodies.contactJ, "J"));
    setText("bodies-joints", formatSi(bodies.jointsJ, "J"));
    setText("bodies-step", formatSi(bodies.solverJ, "J"));
    setText("bodies-returned", formatCount(bodies.returned));
    const part = this.slow_.judge(state.timeS, bodies.lostS);
    return part === undefined ? undefined :
      `Slow motion: the bodies run at ${Math.round(100 * (1 - part))} % of their speed, as ticks come late.`;
  }

  private energiesOf(bodies: Bodies): BodyEnergies {
    this.lowest_J = Math.min(this.lowest_J, bodies.gravityJ);
    return { kinetic_J: bodies.kineticJ, height_J: bodies.gravityJ - this.lowest_J, spring_J: bodies.springJ };
  }
}
