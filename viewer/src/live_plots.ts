// The plots of the live session, and the numbers behind them: force and penetration, the rates of the loops, the energy
// that the surfaces have added. All of the first device.

import { element } from "./elements";
import type { State } from "./gen/hl_pb";
import { kWindow_s, LivePlot } from "./plots";
import { SampleRing } from "./samples";

/** Ten seconds of a 6 kHz loop: the most that State.samples can carry. */
const kSampleCapacity = 65536;
const kRateCapacity = 1024;

export class LivePlots {
  /** Force, N, and penetration, m. */
  readonly samples = new SampleRing(kSampleCapacity, 2);
  private readonly rates_ = new SampleRing(kRateCapacity, 2);
  private readonly energy_ = new SampleRing(kRateCapacity, 5);
  private readonly plots_ = {
    force: new LivePlot(element("plot-force"), {
      unit: "N", series: [{ colour: "force", fill: true }], smallestTop: 1,
    }),
    rates: new LivePlot(element("plot-rates"), {
      unit: "Hz", series: [{ colour: "proxy", width: 4 }, { colour: "servo" }], smallestTop: 1000,
    }),
    energy: new LivePlot(element("plot-energy"), {
      unit: "J",
      series: ["shading", "stiffness", "texture", "moving", "late"].map((cause) => ({ colour: `energy-${cause}` })),
      smallestTop: 1e-3,
    }),
  };

  /** Another session begins, with a device of this peak force. */
  forget(forceMax_N: number): void {
    this.plots_.force.setLimit(forceMax_N);
    this.samples.clear();
    this.rates_.clear();
    this.energy_.clear();
  }

  take(state: State): void {
    for (const sample of state.samples) {
      this.samples.push(sample.timeS, sample.forceN, sample.penetrationM);
    }
    const energy = state.ledger;
    if (energy !== undefined) {
      const { shadingJ, stiffnessJ, textureJ, movingJ, lateJ } = energy;
      this.energy_.push(state.timeS, shadingJ, stiffnessJ, textureJ, movingJ, lateJ);
    }
    this.rates_.push(state.timeS, state.proxyLoop?.rateHz ?? NaN, state.servo?.rateHz ?? NaN);
  }

  show(): void {
    const [times, force] = this.samples.window(kWindow_s, this.plots_.force.buckets);
    this.plots_.force.show([times, force!]);
    this.plots_.rates.show(this.rates_.window(kWindow_s, this.plots_.rates.buckets));
    this.plots_.energy.show(this.energy_.window(kWindow_s, this.plots_.energy.buckets));
  }

  applyTheme(): void {
    Object.values(this.plots_).forEach((plot) => plot.applyTheme());
  }
}
