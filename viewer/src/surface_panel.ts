// The Surface section: sliders and switches that act immediately on every surface. What the server says moves the
// controls, so that two pages agree; pending.ts says when it may.

import { element, onLetGo, setText } from "./elements";
import type { QuantityInfo, Surfaces } from "./gen/hl_pb";
import { kPresets, originOf, presetOf, settingsFor } from "./materials";
import { kSendPeriod_ms, paced } from "./pace";
import { Pending } from "./pending";
import type { SettingsChange } from "./protocol";
import { knobOf, settingsOf, shadingOf, type Knob, type SurfaceField, type SurfaceSettings } from "./surfaces";

const kSceneDecides = "scene";

export class SurfacePanel {
  private readonly pending_ = new Pending<number | boolean | undefined>();
  private readonly sendSurfaces_: () => void;
  private said_: SurfaceSettings = {};
  private materials_: readonly (readonly Surfaces[])[] = [];
  private knobs_: readonly Knob[] = [];

  constructor(send: (change: SettingsChange) => void) {
    // The message replaces everything that was set, so it is put together when it goes out, not when it was asked for.
    this.sendSurfaces_ = paced(() => send({ surfaces: this.chosen() }), kSendPeriod_ms);
    this.onSwitch("shading", "smooth");
    this.onSwitch("textures", "textures");
    element("surface-reset").addEventListener("click", () => this.choose(this.fields(), undefined));
    this.onPreset();
    onLetGo(() => this.pending_.letGo(performance.now()));
    this.show();
  }

  /** Another server: what was chosen for the one before is past. */
  forget(): void {
    this.pending_.clear();
  }

  /** The numbers that the server knows: a slider for each. */
  showQuantities(quantities: readonly QuantityInfo[]): void {
    this.knobs_ = quantities.map(knobOf);
    element("surface-knobs").replaceChildren(...this.knobs_.map((knob) => this.made(knob)));
    this.show();
  }

  /** What the server says is set. */
  showSurfaces(surfaces: Surfaces | undefined): void {
    this.said_ = settingsOf(surfaces);
    this.show();
  }

  /** The materials of each object of the scene. */
  showMaterials(materials: readonly (readonly Surfaces[])[]): void {
    this.materials_ = materials;
    this.show();
  }

  private fields(): readonly SurfaceField[] {
    return [...this.knobs_.map((knob) => knob.field), "smooth", "textures"];
  }

  private made(knob: Knob): HTMLElement {
    const label = document.createElement("label");
    label.className = "knob";
    label.htmlFor = knob.id;
    const name = document.createElement("span");
    name.textContent = knob.label;
    name.title = knob.title;
    const value = document.createElement("output");
    value.id = `${knob.id}-value`;
    value.setAttribute("aria-live", "off");
    label.append(name, value, this.sliderOf(knob));
    return label;
  }

  private sliderOf(knob: Knob): HTMLInputElement {
    const slider = document.createElement("input");
    slider.id = knob.id;
    slider.type = "range";
    slider.min = "0";
    slider.max = String(knob.max);
    slider.step = String(knob.step);
    slider.addEventListener("input", () => this.choose([knob.field], slider.valueAsNumber));
    slider.addEventListener("pointerdown", () => {
      this.pending_.hold(knob.field, this.chosen()[knob.field], performance.now());
    });
    return slider;
  }

  private onSwitch(id: string, field: "smooth" | "textures"): void {
    const box = element<HTMLInputElement>(id);
    // Textures that are not left out are as the scene says.
    const on = field === "textures" ? undefined : true;
    box.addEventListener("change", () => this.choose([field], box.checked ? on : false));
  }

  private onPreset(): void {
    const select = element<HTMLSelectElement>("material");
    select.append(...kPresets.map(({ name }) => new Option(name)));
    select.addEventListener("change", () => {
      const preset = kPresets.find(({ name }) => name === select.value);
      const settings = preset === undefined ? {} : settingsFor(preset, this.knobFields());
      this.knobFields().forEach((field) => this.pending_.set(field, settings[field], performance.now()));
      this.show();
      this.sendSurfaces_();
    });
  }

  private knobFields(): readonly SurfaceField[] {
    return this.knobs_.map(({ field }) => field);
  }

  /** The preset that the sliders show, the scene's own values, or some of the user's. */
  private showPreset(chosen: SurfaceSettings): void {
    const fields = this.knobFields();
    const preset = presetOf(chosen, fields);
    const own = fields.every((field) => chosen[field] === undefined);
    const value = own ? kSceneDecides : (preset?.name ?? "own");
    const select = element<HTMLSelectElement>("material");
    if (select.value !== value && document.activeElement !== select) {
      select.value = value;
    }
    setText("material-origin", own || preset === undefined ? "" : originOf(preset));
  }

  private choose(fields: readonly SurfaceField[], value: number | boolean | undefined): void {
    fields.forEach((field) => this.pending_.set(field, value, performance.now()));
    this.show();
    this.sendSurfaces_();
  }

  /** What the server says, and over it what the user has just chosen. */
  private chosen(): SurfaceSettings {
    const now_ms = performance.now();
    const entries = this.fields().map((field) => [field, this.pending_.resolve(field, this.said_[field], now_ms)]);
    return Object.fromEntries(entries.filter(([, value]) => value !== undefined)) as SurfaceSettings;
  }

  private show(): void {
    const chosen = this.chosen();
    this.showPreset(chosen);
    for (const knob of this.knobs_) {
      const value = chosen[knob.field] as number | undefined;
      const slider = element<HTMLInputElement>(knob.id);
      slider.value = String(value ?? knob.rest);
      const words = value === undefined ? kSceneDecides : knob.text(value);
      setText(`${knob.id}-value`, words);
      slider.setAttribute("aria-valuetext", words);
      for (const part of [slider, element(`${knob.id}-value`)]) {
        part.classList.toggle("unset", value === undefined);
      }
    }
    const box = element<HTMLInputElement>("shading");
    const shading = shadingOf(chosen.smooth, this.materials_);
    box.checked = shading ?? false;
    box.indeterminate = shading === undefined;
    element<HTMLInputElement>("textures").checked = chosen.textures ?? true;
  }
}
