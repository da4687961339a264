// The Surface section: sliders and switches that act at once on every surface, and the ledger's mode. What the server
// says moves the controls, so that two pages agree; a control that was just used is left alone for a moment.

import { LedgerMode, type State } from "./gen/hl_pb";
import { element, setText } from "./panel";
import type { SettingsChange } from "./protocol";
import { kKnobs, settingsOf, type Knob, type SurfaceSettings } from "./surfaces";
import { formatFixed } from "./units";

/** States already on their way are older than what the user has just done. */
const kSettle_ms = 700;
const kSceneDecides = "scene";
const kLedgerIds: Readonly<Record<LedgerMode, string>> = {
  [LedgerMode.TANK]: "ledger-tank",
  [LedgerMode.STRICT]: "ledger-strict",
  [LedgerMode.REPORT]: "ledger-report",
};

export class SurfacePanel {
  private readonly send_: (change: SettingsChange) => void;
  private set_: SurfaceSettings = {};
  private used_ms_ = -Infinity;

  constructor(send: (change: SettingsChange) => void) {
    this.send_ = send;
    kKnobs.forEach((knob) => this.prepare(knob));
    this.onSwitch("shading", "smooth");
    this.onSwitch("textures", "textures");
    element("surface-reset").addEventListener("click", () => this.choose({}));
    for (const [mode, id] of Object.entries(kLedgerIds)) {
      element<HTMLInputElement>(id).addEventListener("change", () => {
        this.used_ms_ = performance.now();
        send({ ledger: Number(mode) as LedgerMode });
      });
    }
    this.show();
  }

  showState(state: State): void {
    setText("tank", formatFixed((state.ledger?.tankJ ?? NaN) * 1e3, "mJ", 1));
    if (performance.now() - this.used_ms_ < kSettle_ms) {
      return;
    }
    this.set_ = settingsOf(state.surfaces);
    this.show();
    element<HTMLInputElement>(kLedgerIds[state.ledger?.mode ?? LedgerMode.TANK]).checked = true;
  }

  private prepare(knob: Knob): void {
    const slider = element<HTMLInputElement>(knob.id);
    slider.min = "0";
    slider.max = String(knob.max);
    slider.step = String(knob.step);
    slider.addEventListener("input", () => this.choose({ ...this.set_, [knob.quantity]: slider.valueAsNumber }));
  }

  private onSwitch(id: string, field: "smooth" | "textures"): void {
    const box = element<HTMLInputElement>(id);
    box.addEventListener("change", () => this.choose({ ...this.set_, [field]: box.checked }));
  }

  private choose(settings: SurfaceSettings): void {
    this.used_ms_ = performance.now();
    this.set_ = settings;
    this.show();
    this.send_({ surfaces: settings });
  }

  private show(): void {
    for (const knob of kKnobs) {
      const value = this.set_[knob.quantity];
      element<HTMLInputElement>(knob.id).value = String(value ?? knob.rest);
      setText(`${knob.id}-value`, value === undefined ? kSceneDecides : knob.text(value));
      element(`${knob.id}-value`).classList.toggle("unset", value === undefined);
    }
    const shading = element<HTMLInputElement>("shading");
    shading.checked = this.set_.smooth ?? false;
    shading.indeterminate = this.set_.smooth === undefined;
    element<HTMLInputElement>("textures").checked = this.set_.textures ?? true;
  }
}
