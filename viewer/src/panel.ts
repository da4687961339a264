// The two cards: numbers out, settings in. Every element is in index.html; this file only fills and reads them.

import { SafetyState, type Hello, type LoopStats, type State } from "./gen/hl_pb";
import type { LinkState } from "./connection";
import { ButtonRow } from "./button_row";
import { element, onLetGo, setText, setTitle } from "./elements";
import { kSendPeriod_ms, paced } from "./pace";
import { Pending } from "./pending";
import type { SettingsChange } from "./protocol";
import type { Layout } from "./scene_messages";
import type { Counts } from "./scene_store";
import type { Side } from "./section";
import type { ThemeChoice } from "./theme";
import { describeEndings } from "./ticks_ended";
import {
  countedParts, formatCount, formatFixed, formatScale, formatShortCount, formatSi, kThinSpace, kUnknown,
} from "./units";
import { softenedWords } from "./vibration";

export interface PanelActions {
  settings(change: SettingsChange): void;
  rearm(): void;
  theme(choice: ThemeChoice): void;
  planes(shown: boolean): void;
  cones(shown: boolean): void;
  marks(shown: boolean): void;
  edges(shown: boolean): void;
  flat(flat: boolean): void;
  orbitFromEmpty(on: boolean): void;
  dropLine(shown: boolean): void;
  stylus(shown: boolean): void;
  resetView(): void;
  bringHandBack(): void;
  section(side: Side, share: number): void;
  sound(on: boolean): void;
  pause(paused: boolean): void;
  copyLink(): void;
  savePicture(): void;
  saveSamples(): void;
  saveScene(): void;
}

/** From this height of the window on all sections fit. */
const kTall_px = 860;
const kStiffnessMin_N_m = 50;
const kStiffnessStep_N_m = 10;

const kSafetyTexts: Readonly<Record<SafetyState, string>> = {
  [SafetyState.OFF]: "Off: no force",
  [SafetyState.ARMING]: "Arming: force ramps up",
  [SafetyState.ON]: "On",
  [SafetyState.FAULT]: "Fault: no force",
  [SafetyState.WAITING]: "Waiting: hold the dead-man switch",
};

const kLinkTexts: Readonly<Record<LinkState, string>> = {
  connecting: "connecting",
  live: "live",
  silent: "silent",
  lost: "offline",
};

export class Panel {
  private readonly actions_: PanelActions;
  private readonly pending_ = new Pending<boolean | number>();
  private readonly buttons_ = new ButtonRow();
  private shown_: string | undefined;  // name of the layout before, of this server

  constructor(actions: PanelActions) {
    this.actions_ = actions;
    this.onCheck("explore", (on) => this.sendSettings("explore", on, { explore: on }));
    this.onCheck("planes", (on) => actions.planes(on));
    this.onCheck("cones", (on) => actions.cones(on));
    this.onCheck("marks", (on) => actions.marks(on));
    this.onCheck("edges", (on) => actions.edges(on));
    this.onCheck("flat", (on) => actions.flat(on));
    this.onCheck("drop", (on) => actions.dropLine(on));
    this.onCheck("stylus", (on) => actions.stylus(on));
    this.onCheck("empty-orbit", (on) => actions.orbitFromEmpty(on));
    this.onChoice("grip", (value) => this.sendSettings("grip", value === "firm", { handFirm: value === "firm" }));
    this.onChoice("theme", (value) => actions.theme(value as ThemeChoice));
    this.onStiffness();
    element("rearm").addEventListener("click", () => actions.rearm());
    element("reset-view").addEventListener("click", () => {
      this.endSection();
      actions.resetView();
    });
    element("bring-back").addEventListener("click", () => actions.bringHandBack());
    this.onCheck("sound", (on) => actions.sound(on));
    this.onCheck("pause", (on) => actions.pause(on));
    this.onSection();
    element("copy-link").addEventListener("click", () => actions.copyLink());
    element("save-picture").addEventListener("click", () => actions.savePicture());
    element("save-samples").addEventListener("click", () => actions.saveSamples());
    element("save-scene").addEventListener("click", () => actions.saveScene());
    element("help-open").addEventListener("click", () => this.showHelp());
    window.addEventListener("keydown", (event) => this.shortcut(event));
    this.foldByHeight();
  }

  showTheme(choice: ThemeChoice): void {
    document.querySelector<HTMLInputElement>(`input[name=theme][value=${choice}]`)!.checked = true;
  }

  showLink(link: LinkState): void {
    element("link").dataset.link = link;
    setText("link", kLinkTexts[link]);
    element("readouts").classList.toggle("stale", link !== "live");
    // A silent server gets what is sent when it goes on.
    for (const group of document.querySelectorAll<HTMLFieldSetElement>("fieldset.of-server")) {
      group.disabled = link === "connecting" || link === "lost";
      group.title = group.disabled ? "Of the server, which is not there now" : "";
    }
    if (link !== "live") {
      element("safety").dataset.safety = "OFF";
      element("rearm").hidden = true;
      element("fault").hidden = true;
      element("softened").hidden = true;
      setText("safety-state", "Not known");
      this.showNothingMeasured();
    }
  }

  /** Every number that a server measures: what was heard last is not what is so now. */
  private showNothingMeasured(): void {
    for (const value of document.querySelectorAll("#readouts .live-only :is(output, td, dd)")) {
      value.textContent = kUnknown;
    }
    for (const level of document.querySelectorAll<HTMLProgressElement>("#readouts .live-only progress")) {
      level.value = 0;
    }
    ["force-badge", "bodies-count"].forEach((id) => setText(id, kUnknown));
    ["ticks-ended", "proxy-missed", "servo-missed"].forEach((id) => setTitle(id, ""));
  }

  showHello(hello: Hello): void {
    // A server that has just been met knows nothing of what was set before.
    this.pending_.clear();
    this.shown_ = undefined;
    this.showName(hello.sceneName || "–");
    this.buttons_.forget();
    setText("model-size", "not received yet");
    const label = hello.device?.label;
    const device = (label ? `${label}: ` : "") + (hello.device?.name || "–");
    setText("device", device);
    element("device").title = device;
    const force = "Force on the hand" + (hello.devices.length > 1 && label ? `: ${label}` : "");
    setText("force-of", force);
    element("force-badge").title = force;
    const slider = element<HTMLInputElement>("stiffness");
    const recommended = hello.device?.stiffnessNM ?? 0;
    const highest = hello.device?.stiffnessMaxNM || 2 * recommended;
    slider.disabled = !(highest > kStiffnessMin_N_m);
    slider.min = String(kStiffnessMin_N_m);
    slider.max = String(Math.floor(highest / kStiffnessStep_N_m) * kStiffnessStep_N_m);
    slider.step = String(kStiffnessStep_N_m);
    slider.title = `The device's own: ${formatCount(recommended)}${kThinSpace}N/m, at the tick`;
    element("stiffness-ticks").replaceChildren(new Option("", String(recommended)));
    this.showStiffness(recommended);
  }

  /** What moves a simulated hand makes no sense when a person holds the device. `explore`: who would explore. */
  showHand(simulated: boolean, explore: string): void {
    this.pending_.forget("explore");
    setText("explore-text", explore);
    document.documentElement.dataset.hand = simulated ? "simulated" : "person";
    for (const id of ["explore", "grip-light", "grip-firm"]) {
      element<HTMLInputElement>(id).disabled = !simulated;
    }
  }

  showLayout(layout: Layout, counts: Counts): void {
    if (layout.name !== "") {
      // A cut through one model says nothing about the next.
      if (this.shown_ !== undefined && layout.name !== this.shown_) {
        this.endSection();
      }
      this.shown_ = layout.name;
      this.showName(layout.name);
    }
    const size = countedParts([
      [counts.objects > 1 ? counts.objects : 0, "object"],
      [counts.triangles, "triangle"],
      [counts.segments, "segment"],
      [counts.points, "point"],
    ]);
    setText("model-size", size || "empty");
    // A black box has none.
    const radius_m = layout.proxyRadius_m > 0 ? layout.proxyRadius_m : undefined;
    setText("proxy-radius", formatSi(radius_m, "m"));
    setText("proxy-radius-hand", formatSi(radius_m && radius_m / layout.worldPerDevice, "m"));
    setText("scale", formatScale(layout.worldPerDevice));
  }

  private showName(name: string): void {
    setText("scene-name", name);
    element("scene-name").title = name;
    document.title = `${name} – HL`;
  }

  /** `exploring`: the hand that the page moves; `penetration_m` as in the newest sample. */
  showState(state: State, exploring: boolean, force_N: number, penetration_m: number | undefined): void {
    setText("force", formatFixed(force_N, "N", 2));
    setText("force-badge", formatFixed(force_N, "N", 2));
    setText("penetration", formatFixed(penetration_m === undefined ? undefined : penetration_m * 1e3, "mm", 2));
    setText("contacts", formatCount(state.contacts.length));
    setText("caps", formatShortCount(state.iterationCaps));
    setText("out-of-work", formatShortCount(state.ticksEnded?.outOfWork));
    setText("unplaced", formatShortCount(state.unplacedTicks));
    setTitle("ticks-ended", describeEndings(state.ticksEnded));
    this.showLoop("proxy", state.proxyLoop);
    this.showLoop("servo", state.servo);
    this.buttons_.show(state.buttons);
    this.showSafety(state);
    this.showSettings(state, exploring);
  }

  private showSettings(state: State, exploring: boolean): void {
    const now_ms = performance.now();
    element<HTMLInputElement>("explore").checked = this.pending_.resolve<boolean>("explore", exploring, now_ms);
    const firm = this.pending_.resolve<boolean>("grip", state.handFirm, now_ms);
    element<HTMLInputElement>(firm ? "grip-firm" : "grip-light").checked = true;
    if (state.stiffnessNM > 0) {
      const held_N_m = state.vibration?.limitNM ?? 0;
      this.showStiffness(this.pending_.resolve<number>("stiffness", state.stiffnessNM, now_ms), held_N_m);
    }
  }

  private showLoop(prefix: string, loop: LoopStats | undefined): void {
    // 0: the loop does not measure its steps, as in a page without a server. A real step takes longer.
    const micro = (value: number | undefined) => (value === undefined || value === 0 ? undefined : value * 1e-6);
    setText(`${prefix}-rate`, formatSi(loop?.rateHz, "Hz", 4));
    setText(`${prefix}-p50`, formatSi(micro(loop?.timeP50Us), "s"));
    setText(`${prefix}-p999`, formatSi(micro(loop?.timeP999Us), "s"));
    setText(`${prefix}-max`, formatSi(micro(loop?.timeMaxUs), "s"));
    const steps = loop === undefined ? "" : ` of ${formatCount(loop.steps)}`;
    setText(`${prefix}-missed`, formatCount(loop?.deadlinesMissed));
    element(`${prefix}-missed`).title = `${formatCount(loop?.deadlinesMissed)}${steps} steps since the start`;
  }

  private showSafety(state: State): void {
    const fault = state.safety === SafetyState.FAULT;
    element("safety").dataset.safety = SafetyState[state.safety] ?? "OFF";
    setText("safety-state", kSafetyTexts[state.safety] ?? `state ${state.safety}`);
    element("rearm").hidden = !fault;
    element("fault").hidden = !fault;
    setText("fault", state.fault || "The server gave no reason.");
    const forceless = state.safety !== SafetyState.ON && state.safety !== SafetyState.ARMING;
    setText("energy-note", forceless ? "not felt: no force" : "total since the start");
    const limit_N_m = state.vibration?.limitNM ?? 0;
    element("softened").hidden = limit_N_m === 0;
    setText("softened", softenedWords(limit_N_m));
  }

  /** `held_N_m`: what the server holds it below, because it shook; 0: nothing. */
  private showStiffness(value_N_m: number, held_N_m = 0): void {
    const slider = element<HTMLInputElement>("stiffness");
    const held = held_N_m > 0 && held_N_m < value_N_m ? `, held at ${formatCount(Math.round(held_N_m))}` : "";
    const words = `${formatCount(value_N_m)}${kThinSpace}N/m${held}`;
    slider.value = String(value_N_m);
    slider.setAttribute("aria-valuetext", words);
    setText("stiffness-value", words);
    element("stiffness-value").classList.toggle("held", held !== "");
  }

  private onStiffness(): void {
    const slider = element<HTMLInputElement>("stiffness");
    const send = paced(() => this.actions_.settings({ stiffnessNM: slider.valueAsNumber }), kSendPeriod_ms);
    slider.addEventListener("input", () => {
      this.pending_.set("stiffness", slider.valueAsNumber, performance.now());
      this.showStiffness(slider.valueAsNumber);
      send();
    });
    slider.addEventListener("pointerdown", () => {
      this.pending_.hold("stiffness", slider.valueAsNumber, performance.now());
    });
    onLetGo(() => this.pending_.letGo(performance.now()));
  }

  private onSection(): void {
    const side = element<HTMLSelectElement>("section");
    const share = element<HTMLInputElement>("section-at");
    const act = () => {
      share.hidden = side.value === "off";
      this.actions_.section(side.value as Side, share.valueAsNumber);
    };
    side.addEventListener("change", act);
    share.addEventListener("input", act);
  }

  /** A view that is cut is none of the whole model. */
  private endSection(): void {
    const side = element<HTMLSelectElement>("section");
    side.value = "off";
    side.dispatchEvent(new Event("change"));
  }

  /** Close has the focus, at the end of what may be longer than the window: it is read from the begin. */
  private showHelp(): void {
    const help = element<HTMLDialogElement>("help");
    help.showModal();
    help.scrollTop = 0;
  }

  private sendSettings(control: string, value: boolean, change: SettingsChange): void {
    this.pending_.set(control, value, performance.now());
    this.actions_.settings(change);
  }

  private onCheck(id: string, act: (on: boolean) => void): void {
    const box = element<HTMLInputElement>(id);
    box.addEventListener("change", () => act(box.checked));
  }

  private onChoice(name: string, act: (value: string) => void): void {
    for (const radio of document.querySelectorAll<HTMLInputElement>(`input[name=${name}]`)) {
      radio.addEventListener("change", () => act(radio.value));
    }
  }

  /**
   * In a low window only one of the foldable sections is open, so that the card never has to scroll. The last one, of what
   * is rarely used, is opened by the user alone.
   */
  private foldByHeight(): void {
    const folds = [...document.querySelectorAll<HTMLDetailsElement>("#controls details")];
    const low = () => window.innerHeight < kTall_px;
    const fit = () => folds.forEach((fold, i) => (fold.open = i === 0 || (!low() && i < folds.length - 1)));
    for (const fold of folds) {
      fold.addEventListener("toggle", () => {
        if (fold.open && low()) {
          folds.filter((other) => other !== fold).forEach((other) => (other.open = false));
        }
      });
    }
    window.matchMedia(`(min-height: ${kTall_px}px)`).addEventListener("change", fit);
    fit();
  }

  private shortcut(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey || event.repeat || element<HTMLDialogElement>("help").open) {
      return;
    }
    const ids: Readonly<Record<string, string>> = {
      e: "explore", p: "planes", c: "cones", j: "marks", m: "edges", f: "flat", d: "drop", y: "stylus", b: "bring-back", t: "pause",
      r: "reset-view", h: "next-hand", a: "together", "?": "help-open",
    };
    const id = ids[event.key.toLowerCase()];
    const away = document.documentElement.dataset.mode === "recorded";
    if (id !== undefined && !(away && element(id).closest(".live-only") !== null)) {
      element(id).click();
    }
  }
}
