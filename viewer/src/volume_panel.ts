// A slider for the iso value of each surface of a volume, and a box that says on which side of it the matter is: they
// act immediately, for all who touch it. The server sends both with each layout; pending.ts says when they follow.

import { element, onLetGo } from "./elements";
import { paced } from "./pace";
import { Pending } from "./pending";
import { isoSliderOf, type IsoSlider, type Volume } from "./volumes";

/** A slider sends at most so often: each value is another surface, and another mesh to draw. */
const kSendPeriod_ms = 50;
/**
 * The server says another value with the mesh of its surface, and of a large volume that takes seconds, meanwhile those
 * of values before it. A surface that it does not know any more is not in its layout; nothing else is refused.
 */
const kGiveUp_ms = 60_000;

interface Row {
  readonly kind: IsoSlider;
  readonly slider: HTMLInputElement;
  readonly output: HTMLOutputElement;
  readonly below: HTMLInputElement;
}

export class VolumePanel {
  private readonly pending_ = new Pending<number>({
    giveUp_ms: kGiveUp_ms, same: (set, said) => Math.fround(set) === Math.fround(said),
  });
  private readonly pendingBelow_ = new Pending<boolean>({ giveUp_ms: kGiveUp_ms });
  private volumes_: readonly Volume[] = [];
  private rows_: readonly Row[] = [];

  constructor(private readonly send_: (surface: bigint, value: number, below: boolean) => void) {
    onLetGo(() => this.pending_.letGo(performance.now()));
  }

  /** Another server: what was chosen for the one before is past. */
  forget(): void {
    this.pending_.clear();
    this.pendingBelow_.clear();
  }

  /** What the server says. Sliders stay while their surfaces do, so that one can be dragged meanwhile. */
  showVolumes(volumes: readonly Volume[]): void {
    const same = volumes.length === this.volumes_.length &&
      volumes.every((volume, i) => isSame(volume, this.volumes_[i]!));
    for (const before of this.volumes_.filter((old) => !volumes.some((volume) => isSame(volume, old)))) {
      this.pending_.forget(String(before.surface));
      this.pendingBelow_.forget(String(before.surface));
    }
    this.volumes_ = volumes;
    if (!same) {
      this.rows_ = volumes.map((volume, i) => this.made(volume, isoSliderOf(volumes, i), i));
      element("volume-knobs").replaceChildren(...this.rows_.flatMap(({ slider, below }) => [slider.parentElement!, below.parentElement!]));
    }
    this.show();
  }

  /** From time to time: the server may have been waited for long enough. */
  follow(): void {
    this.show();
  }

  private made({ surface }: Volume, kind: IsoSlider, index: number): Row {
    const send = () => this.send_(surface, this.chosen(index), this.chosenBelow(index));
    return { kind, ...this.madeSlider(surface, kind, index, send), below: this.madeBox(surface, kind, index, send) };
  }

  private madeSlider(surface: bigint, kind: IsoSlider, index: number, send: () => void) {
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
    const sendPaced = paced(send, kSendPeriod_ms);
    slider.addEventListener("input", () => {
      this.pending_.set(String(surface), slider.valueAsNumber, performance.now());
      this.show();
      sendPaced();
    });
    slider.addEventListener("pointerdown", () => {
      this.pending_.hold(String(surface), this.chosen(index), performance.now());
    });
    return { slider, output };
  }

  private madeBox(surface: bigint, kind: IsoSlider, index: number, send: () => void): HTMLInputElement {
    const label = document.createElement("label");
    label.className = "switch";
    label.title = "As of signed distances; in a CT the matter is above";
    const box = document.createElement("input");
    box.type = "checkbox";
    box.id = `below-${index + 1}`;
    const name = document.createElement("span");
    name.textContent = kind.belowLabel;
    label.append(box, name);
    box.addEventListener("change", () => {
      this.pendingBelow_.set(String(surface), box.checked, performance.now());
      send();
    });
    return box;
  }

  private chosen(index: number): number {
    const volume = this.volumes_[index];
    return volume === undefined ? 0 : this.pending_.resolve(String(volume.surface), volume.iso, performance.now());
  }

  private chosenBelow(index: number): boolean {
    const volume = this.volumes_[index];
    return volume !== undefined && this.pendingBelow_.resolve(String(volume.surface), volume.below, performance.now());
  }

  private show(): void {
    this.rows_.forEach(({ kind, slider, output, below }, index) => {
      const value = this.chosen(index);
      slider.value = String(value);
      // What is set again is read out again.
      if (output.textContent !== kind.text(value)) {
        output.textContent = kind.text(value);
        slider.setAttribute("aria-valuetext", kind.text(value));
      }
      below.checked = this.chosenBelow(index);
    });
  }
}

/** Whether it is the same surface, whatever its value. */
function isSame(a: Volume, b: Volume): boolean {
  return a.name === b.name && a.surface === b.surface && a.low === b.low && a.high === b.high;
}
