// The page of `hl touch`: puts connection, 3-D view, plots and panels together. Messages are taken as they come;
// everything on the screen follows in animation frames, so a slow browser draws less often but never lags behind.

import "./style.css";
import { Announcer } from "./announcer";
import { ButtonInput } from "./button_input";
import { Connection, type LinkState } from "./connection";
import { publishDebugState } from "./debug_state";
import { element, setText } from "./elements";
import { showEmptyHint } from "./empty_hint";
import type { Hello, State } from "./gen/hl_pb";
import { depthOf, metresPerPixel } from "./hand_mapping";
import { HandFinder } from "./hand_finder";
import { HandInput } from "./hand_input";
import { diagonalOf } from "./fit";
import { LedgerPanel } from "./ledger_panel";
import { LiveScene } from "./live_scene";
import { Notices } from "./notices";
import { Panel } from "./panel";
import { kWindow_s, LivePlot } from "./plots";
import { Errand, kAbove_D, Press, type SurfaceHit } from "./press";
import { ProbeView } from "./probe_view";
import {
  encodeHandGoal, encodePress, encodeRearm, encodeRelease, encodeSettings, kProtocolVersion,
  type Incoming, type SettingsChange,
} from "./protocol";
import { beside } from "./route";
import { SampleRing } from "./samples";
import type { Bounds, Layout } from "./scene_messages";
import { ScaleBar } from "./scale_bar";
import type { SceneStore } from "./scene_store";
import { Stage, type Insets } from "./stage";
import { SurfacePanel } from "./surface_panel";
import { ThemeSwitch } from "./theme";
import { planWay, surfaceUnder, type AimScene } from "./touch_aim";
import { formatFixed } from "./units";
import { length, sub, type Vec } from "./vec";
import { kVibrationWindow_s, VibrationAlarm } from "./vibration";
import { knownVec } from "./wire_values";

const kPlotPeriod_ms = 50;
/** Numbers that change faster than this cannot be read. */
const kNumbersPeriod_ms = 100;
/** Ten seconds of a 6 kHz loop: the most that State.samples can carry. */
const kSampleCapacity = 65536;
const kRateCapacity = 1024;
/** A press this near to the proxy or the finger is meant for the hand. */
const kGrabRadius_px = 30;
const kUp: Vec = { x: 0, y: 1, z: 0 };
const kDown: Vec = { x: 0, y: -1, z: 0 };

class App {
  private readonly live_ = new LiveScene({
    shown: (store, layout) => this.showLayout(store, layout),
    fit: (bounds) => this.fit(bounds),
  });
  private readonly probe_ = new ProbeView();
  private readonly notices_ = new Notices();
  private readonly stage_ = new Stage(element<HTMLCanvasElement>("canvas"), (reason) => this.notices_.stand("drawing", reason));
  private readonly finder_ = new HandFinder(() => this.bringHandBack());
  private readonly scaleBar_ = new ScaleBar();
  private readonly samples_ = new SampleRing(kSampleCapacity, 2);
  private readonly rates_ = new SampleRing(kRateCapacity, 2);
  private readonly energy_ = new SampleRing(kRateCapacity, 5);
  private readonly plots_ = {
    force: new LivePlot(element("plot-force"), { unit: "N", series: [{ colour: "force", fill: true }], smallestTop: 1 }),
    rates: new LivePlot(element("plot-rates"), {
      unit: "Hz", series: [{ colour: "proxy", width: 4 }, { colour: "servo" }], smallestTop: 1000,
    }),
    energy: new LivePlot(element("plot-energy"), {
      unit: "J",
      series: ["shading", "stiffness", "texture", "moving", "late"].map((cause) => ({ colour: `energy-${cause}` })),
      smallestTop: 1e-3,
    }),
  };
  private readonly announcer_ = new Announcer((text) => setText("announce", text));
  private readonly vibration_ = new VibrationAlarm();
  private readonly hand_: HandInput;
  private readonly buttons_ = new ButtonInput((down) => this.connection_.send(encodePress(down)));
  private readonly panel_: Panel;
  private readonly surfacePanel_: SurfacePanel;
  private readonly ledgerPanel_: LedgerPanel;
  private readonly theme_: ThemeSwitch;
  private readonly connection_: Connection;
  private state_: State | undefined;
  private serverVersion_: string | undefined;
  private stateFresh_ = false;
  private lastPlot_ms_ = 0;
  private lastNumbers_ms_ = 0;

  constructor() {
    this.stage_.scene.add(this.live_.model.group, this.probe_.group);
    this.hand_ = this.makeHand();
    this.panel_ = this.makePanel();
    this.surfacePanel_ = new SurfacePanel((change) => this.tell(change));
    this.ledgerPanel_ = new LedgerPanel((change) => this.tell(change));
    this.theme_ = new ThemeSwitch(() => this.applyTheme());
    this.panel_.showTheme(this.theme_.choice);
    this.followWindow();
    const address = new URL("viewer", location.href);
    address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    this.connection_ = new Connection(address.href, {
      message: (message) => this.receive(message),
      link: (link) => this.linkChanged(link),
      violation: (reason) => this.notices_.tell(`Connection closed: ${reason}.`, true),
    });
    publishDebugState({
      link: () => this.connection_.state,
      scene: () => this.live_,
      state: () => this.state_,
      samples: () => this.samples_,
      holding: () => this.hand_.holding,
      project: (point) => this.stage_.project(point),
    });
    requestAnimationFrame((now_ms) => this.frame(now_ms));
  }

  private makeHand(): HandInput {
    return new HandInput(this.stage_, {
      finger: () => (this.connection_.state === "live" ? knownVec(this.state_?.finger) : undefined),
      goal: (position) => this.connection_.send(encodeHandGoal(position)),
      release: () => this.connection_.send(encodeRelease()),
      proxy: () => knownVec(this.state_?.proxy),
      press: (x_px, y_px) => this.press(x_px, y_px),
      surface: (x_px, y_px) => this.surfaceAt(x_px, y_px),
      isTarget: (x_px, y_px) => this.isNearHand(x_px, y_px) || this.surfaceAt(x_px, y_px) !== undefined,
    });
  }

  private aimScene(): AimScene {
    const { layout, model, store } = this.live_;
    const worldPerHand = layout !== undefined && layout.worldPerDevice > 0 ? layout.worldPerDevice : 1;
    return { model, bounds: model.bounds(store.poses), proxyRadius_m: layout?.proxyRadius_m ?? 0, worldPerHand };
  }

  private surfaceAt(x_px: number, y_px: number): SurfaceHit | undefined {
    return surfaceUnder(this.aimScene(), this.stage_.rayAt(x_px, y_px));
  }

  /** A press on the marks of a hand that touches nothing takes the hand; any other press on the model touches it there. */
  private press(x_px: number, y_px: number): Press | undefined {
    const hit = this.surfaceAt(x_px, y_px);
    const touching = (this.state_?.contacts.length ?? 0) > 0;
    if (hit === undefined || (!touching && this.isNearHand(x_px, y_px))) {
      return undefined;
    }
    return new Press(this.aimScene().worldPerHand, hit, (to) => this.wayTo(to));
  }

  private wayTo(to: Vec): Vec[] {
    const proxy = knownVec(this.state_?.proxy) ?? to;
    const finger = knownVec(this.state_?.finger) ?? proxy;
    return planWay(this.aimScene(), proxy, sub(proxy, finger), to);
  }

  /** To a place above what is in the middle of the view, or to what the view turns about. */
  private bringHandBack(): void {
    const { left, right, top, bottom } = this.stage_.visible;
    const hit = this.surfaceAt((left + right) / 2, (top + bottom) / 2);
    const scene = this.aimScene();
    const to = hit ? beside(hit.point, hit.normal, kAbove_D * scene.worldPerHand) : this.stage_.target;
    this.hand_.send(new Errand(scene.worldPerHand, this.wayTo(to)));
  }

  private makePanel(): Panel {
    return new Panel({
      settings: (change) => this.tell(change),
      rearm: () => this.connection_.send(encodeRearm()),
      theme: (choice) => this.theme_.choose(choice),
      planes: (shown) => this.probe_.setPlanesShown(shown),
      cones: (shown) => this.probe_.cones.setShown(shown),
      edges: (shown) => this.live_.model.setEdges(shown),
      flat: (flat) => this.live_.model.setFlat(flat),
      orbitFromEmpty: (on) => (this.hand_.orbitFromEmpty = on),
      dropLine: (shown) => this.probe_.drop.setShown(shown),
      resetView: () => this.live_.refit(),
      bringHandBack: () => this.bringHandBack(),
    });
  }

  private tell(change: SettingsChange): void {
    this.connection_.send(encodeSettings(change));
  }

  private receive(message: Incoming): void {
    switch (message.kind) {
      case "hello":
        this.greet(message.hello);
        break;
      case "mesh":
        this.live_.add(message.mesh);
        break;
      case "layout":
        this.live_.setLayout(message.layout);
        break;
      case "forget":
        this.live_.forget(message.meshes);
        break;
      case "state":
        this.live_.take(message.state, message.moves);
        this.takeState(message.state);
        break;
      case "notice":
        this.notices_.tell(message.notice.text, message.notice.fatal);
        break;
      case "unknown":
        break;
    }
  }

  private greet(hello: Hello): void {
    const other = hello.protocolVersion !== kProtocolVersion;
    const renewed = this.serverVersion_ !== undefined && this.serverVersion_ !== hello.serverVersion;
    this.notices_.stand("version", other || renewed ? "The server has another version. Reload this page." : undefined);
    this.serverVersion_ = hello.serverVersion;
    this.live_.clear(hello.sceneName);
    this.hand_.cancel();
    this.hand_.movable = this.buttons_.enabled = hello.device?.simulatedHand ?? false;
    this.panel_.showHello(hello);
    this.surfacePanel_.showQuantities(hello.quantities);
    this.surfacePanel_.forget();
    this.ledgerPanel_.forget();
    this.probe_.setForceMax(hello.device?.forceMaxN ?? 0);
    this.plots_.force.setLimit(hello.device?.forceMaxN ?? 0);
    this.samples_.clear();
    this.rates_.clear();
    this.energy_.clear();
  }

  private showLayout(store: SceneStore, layout: Layout): void {
    this.probe_.setRadius(layout.proxyRadius_m);
    this.panel_.showLayout(layout, store.counts());
    showEmptyHint(layout.placed.length === 0);
    if (layout.bounds !== undefined) {
      this.stage_.lowerFloor(layout.bounds.min.y);
    }
  }

  private fit(bounds: Bounds): void {
    this.stage_.setBounds(bounds.min, bounds.max);
    this.probe_.setDiagonal(diagonalOf(bounds));
  }

  private takeState(state: State): void {
    this.state_ = state;
    this.stateFresh_ = true;
    for (const sample of state.samples) {
      this.samples_.push(sample.timeS, sample.forceN, sample.penetrationM);
    }
    const energy = state.ledger;
    if (energy !== undefined) {
      const { shadingJ, stiffnessJ, textureJ, movingJ, lateJ } = energy;
      this.energy_.push(state.timeS, shadingJ, stiffnessJ, textureJ, movingJ, lateJ);
    }
    this.rates_.push(state.timeS, state.proxyLoop?.rateHz ?? NaN, state.servo?.rateHz ?? NaN);
  }

  private linkChanged(link: LinkState): void {
    this.panel_.showLink(link);
    const texts: Readonly<Partial<Record<LinkState, string>>> = {
      lost: "The server went away. This page comes back by itself when it returns.",
      silent: "The server is silent. Waiting for it…",
    };
    this.notices_.stand("link", texts[link]);
    if (link !== "live") {
      // What was heard last is not what is so now.
      this.stateFresh_ = false;
      this.hand_.cancel();
    }
  }

  private frame(now_ms: number): void {
    requestAnimationFrame((next_ms) => this.frame(next_ms));
    this.hand_.frame();
    this.live_.frame();
    this.showProbe();
    this.stage_.draw();
    if (this.stateFresh_ && now_ms - this.lastPlot_ms_ >= kPlotPeriod_ms) {
      this.lastPlot_ms_ = now_ms;
      this.showPlots();
    }
    if (this.stateFresh_ && now_ms - this.lastNumbers_ms_ >= kNumbersPeriod_ms) {
      this.lastNumbers_ms_ = now_ms;
      this.showNumbers();
    }
  }

  private showProbe(): void {
    const proxy = knownVec(this.state_?.proxy);
    this.probe_.update(this.state_);
    const view = this.stage_.viewFrame();
    this.scaleBar_.show(metresPerPixel(view, depthOf(view, this.stage_.target)));
    this.showFinder(knownVec(this.state_?.finger));
    if (proxy !== undefined) {
      const pixel_m = metresPerPixel(view, depthOf(view, proxy));
      this.probe_.face(this.stage_.camera, pixel_m);
      this.probe_.drop.update(proxy, this.below(proxy), this.probe_.radius_m, pixel_m);
    }
  }

  private showFinder(finger: Vec | undefined): void {
    const shown = finger !== undefined && this.connection_.state === "live";
    const distance_m = shown ? length(sub(finger, this.stage_.target)) : 0;
    this.finder_.show(shown ? this.stage_.project(finger) : undefined, this.stage_.visible, distance_m);
  }

  /** What is straight below a place: a surface or the floor. */
  private below(place: Vec): { point: Vec; normal: Vec } | undefined {
    const floor = this.stage_.floorBelow(place);
    const reach_m = floor === undefined ? Infinity : place.y - floor.y;
    const met = this.live_.model.cast(place, kDown, reach_m);
    return met ?? (floor && { point: floor, normal: kUp });
  }

  private showPlots(): void {
    const [times, force] = this.samples_.window(kWindow_s, this.plots_.force.buckets);
    this.plots_.force.show([times, force!]);
    this.plots_.rates.show(this.rates_.window(kWindow_s, this.plots_.rates.buckets));
    this.plots_.energy.show(this.energy_.window(kWindow_s, this.plots_.energy.buckets));
  }

  private showNumbers(): void {
    const state = this.state_!;
    const force = knownVec(state.forceN);
    const force_N = force === undefined ? NaN : length(force);
    this.panel_.showState(state, force_N, state.samples.at(-1)?.penetrationM);
    this.announcer_.hear(this.touchedInWords(state), force_N, performance.now());
    this.tellVibration();
    this.surfacePanel_.showSurfaces(state.surfaces);
    this.ledgerPanel_.show(state.ledger);
    this.stateFresh_ = false;
  }

  private touchedInWords(state: State): string {
    const several = this.live_.store.counts().objects > 1;
    const objects = state.touched.map((object) => `object ${object + 1}`);
    return state.contacts.length === 0 ? "" : several && objects.length > 0 ? objects.join(" and ") : "the model";
  }

  private tellVibration(): void {
    const { times, values } = this.samples_.last(0, kVibrationWindow_s);
    const swing = this.vibration_.judge(times, values);
    const text = swing && `The force vibrates by ${formatFixed(swing.force_N, "N", 1)} at ` +
      `${formatFixed(swing.rate_Hz, "Hz", 0)}: the spring is too stiff for this device and grip. Lower it.`;
    this.notices_.stand("vibration", text, "warn");
  }

  private isNearHand(x_px: number, y_px: number): boolean {
    return [knownVec(this.state_?.proxy), knownVec(this.state_?.finger)].some((point) => {
      const at = point === undefined ? undefined : this.stage_.project(point);
      return at !== undefined && Math.hypot(at.x - x_px, at.y - y_px) < kGrabRadius_px;
    });
  }

  private applyTheme(): void {
    this.stage_.applyTheme();
    this.live_.model.applyTheme();
    this.probe_.applyTheme();
    Object.values(this.plots_).forEach((plot) => plot.applyTheme());
  }

  private followWindow(): void {
    const fit = () => this.stage_.resize(freeInsets());
    new ResizeObserver(fit).observe(element("view"));
    fit();
  }
}

/** What the cards cover of the view; nothing in the narrow layout, where they stand below it. */
function freeInsets(): Insets {
  const view = element("view").getBoundingClientRect();
  const controls = element("controls").getBoundingClientRect();
  const readouts = element("readouts").getBoundingClientRect();
  const beside = controls.top < view.bottom && readouts.left > controls.right && controls.bottom <= view.bottom;
  return beside
    ? { left: controls.right - view.left, right: view.right - readouts.left, top: 0, bottom: 24 }
    : { left: 0, right: 0, top: 0, bottom: 0 };
}

new App();
