// A slider for the iso value of each surface of a volume: it acts while it is dragged, on everybody who touches it. The
// server tells the value with each layout; pending.ts says when it moves the slider.

import { element, onLetGo } from "./elements";
import { paced } from "./pace";
import { Pending } from "./pending";
import { isoSliderOf, type IsoSlider, type Volume } from "./volumes";

/** A slider sends at most so often: each value is another surface, and another mesh to draw. */
const kSendPeriod_ms = 50;

interface Row {
  readonly kind: IsoSlider;
  readonly slider: HTMLInputElement;
  readonly output: HTMLOutputElement;
}

export class VolumePanel {
  private readonly pending_ = new Pending<number>();
  private volumes_: readonly Volume[] = [];
  private rows_: readonly Row[] = [];

  constructor(private readonly send_: (surface: bigint, value: number) => void) {
    onLetGo(() => this.pending_.letGo(performance.now()));
  }

  /** Another server: what was chosen for the one before is past. */
  forget(): void {
    this.pending_.clear();
  }

  /** What the server says. Sliders stay while their surfaces do, so that one can be dragged meanwhile. */
  showVolumes(volumes: readonly Volume[]): void {
    const same = volumes.length === this.volumes_.length && volumes.every(({ surface, low, high }, i) => {
      const before = this.volumes_[i]!;
      return before.surface === surface && before.low === low && before.high === high;
    });
    this.volumes_ = volumes;
    if (!same) {
      this.rows_ = volumes.map((volume, i) => this.made(volume, isoSliderOf(volume, i, volumes.length), i));
      element("volume-knobs").replaceChildren(...this.rows_.map(({ slider }) => slider.parentElement!));
    }
    this.show();
  }

  private made({ surface }: Volume, kind: IsoSlider, index: number): Row {
    const label = document.createElement("label");
    label.className = "knob";
    const name = document.createElement("span");
    name.textContent = kind.label;
    name.title = "The surface is where the volume has this value";
    const output = document.createElement("output");
    output.setAttribute("aria-live", "off");
    const slider = document.createElement("input");
    slider.type = "range";
    slider.id = `iso-${index + 1}`;
    label.htmlFor = slider.id;
    [slider.min, slider.max, slider.step] = [kind.min, kind.max, kind.step].map(String) as [string, string, string];
    label.append(name, output, slider);
    const send = paced(() => this.send_(surface, this.chosen(index)), kSendPeriod_ms);
    slider.addEventListener("input", () => {
      this.pending_.set(String(surface), slider.valueAsNumber, performance.now());
      this.show();
      send();
    });
    slider.addEventListener("pointerdown", () => {
      this.pending_.hold(String(surface), this.chosen(index), performance.now());
    });
    return { kind, slider, output };
  }

  private chosen(index: number): number {
    const volume = this.volumes_[index];
    return volume === undefined ? 0 : this.pending_.resolve(String(volume.surface), volume.iso, performance.now());
  }

  private show(): void {
    this.rows_.forEach(({ kind, slider, output }, index) => {
      const value = this.chosen(index);
      slider.value = String(value);
      output.textContent = kind.text(value);
      slider.setAttribute("aria-valuetext", kind.text(value));
    });
  }
}
