// The page of `hl touch`: puts connection, 3-D view, plots and panels together. Messages are taken as they come;
// everything on the screen follows in animation frames, so a slow browser draws less often but never lags behind.

import "./style.css";
import { Announcer } from "./announcer";
import { BodiesPanel } from "./bodies_panel";
import { Connection, type LinkState } from "./connection";
import { publishDebugState } from "./debug_state";
import { element, setText } from "./elements";
import { showEmptyHint } from "./empty_hint";
import { FileDrop } from "./file_drop";
import { FileInput } from "./file_input";
import type { Hello, State } from "./gen/hl_pb";
import { depthOf, metresPerPixel, type ViewFrame } from "./hand_mapping";
import { HandControls } from "./hand_controls";
import { worldPerHand } from "./hand_state";
import { diagonalOf } from "./fit";
import { LedgerPanel } from "./ledger_panel";
import { LivePlots } from "./live_plots";
import { LiveScene } from "./live_scene";
import { ModelFile } from "./model_file";
import { isAside } from "./moved_hands";
import { Notices } from "./notices";
import { Panel } from "./panel";
import { Receiving } from "./receiving";
import { RecordPanel } from "./record_panel";
import { kWindow_s } from "./plots";
import { Pointing } from "./pointing";
import { exploreText } from "./device_rows";
import { OtherHands } from "./other_hands";
import { ProbeView } from "./probe_view";
import {
  encodeHere, encodeIso, encodeRearm, encodeRecord, kProtocolVersion, type Incoming, type SettingsChange,
} from "./protocol";
import type { Bounds, Layout } from "./scene_messages";
import { ScaleBar } from "./scale_bar";
import type { SceneStore } from "./scene_store";
import { Sharing } from "./sharing";
import { Stage, type Insets } from "./stage";
import { SurfacePanel } from "./surface_panel";
import { settingsOf } from "./surfaces";
import { ThemeSwitch } from "./theme";
import { RecordingFile } from "./timeline/recording_file";
import { SceneHold } from "./timeline/scene_hold";
import { Timeline } from "./timeline/timeline";
import { TouchSound } from "./touch_sound";
import { formatFixed } from "./units";
import { length } from "./vec";
import { kVibrationWindow_s, VibrationAlarm } from "./vibration";
import { ViewMemory } from "./view_memory";
import { VolumePanel } from "./volume_panel";
import { knownVec } from "./wire_values";

const kPlotPeriod_ms = 50;
/** Numbers that change faster than this cannot be read. */
const kNumbersPeriod_ms = 100;

class App {
  private readonly live_ = new LiveScene({
    shown: (store, layout) => this.showLayout(store, layout),
    fit: (bounds) => this.fit(bounds),
    replaced: () => this.hands_.release(),
  });
  private readonly probe_ = new ProbeView();
  private readonly others_ = new OtherHands({
    rearm: (device) => this.send(encodeRearm(device)),
    choose: (device) => this.hands_.choose(device),
    chooseNext: () => this.hands_.chooseNext(),
    toggleTogether: () => this.hands_.toggleTogether(),
  });
  private readonly notices_ = new Notices();
  private readonly receiving_ = new Receiving();
  private readonly recordingFile_ = new RecordingFile((recording, name) => this.timeline_.open(recording, name));
  private readonly modelFile_ = new ModelFile(
    (expected) => this.live_.expectOther(expected), () => this.showOpened(),
  );
  /** What opens which file. */
  private readonly files_ = new FileInput(new FileDrop([this.recordingFile_, this.modelFile_], this.notices_));
  private readonly stage_ = new Stage(element<HTMLCanvasElement>("canvas"), (reason) => {
    this.notices_.stand("drawing", reason);
  });
  private readonly pointing_: Pointing = new Pointing(
    this.stage_, this.live_, () => this.state_, () => this.hands_.hands.now,
  );
  private readonly scaleBar_ = new ScaleBar();
  private readonly plots_ = new LivePlots();
  private readonly bodies_ = new BodiesPanel();
  private readonly sound_ = new TouchSound();
  private readonly sharing_ = new Sharing(this.plots_.samples, () => this.live_.layout?.name ?? "");
  private readonly memory_: ViewMemory;
  private readonly announcer_ = new Announcer((text) => setText("announce", text));
  private readonly vibration_ = new VibrationAlarm();
  private readonly hands_: HandControls = new HandControls(this.stage_, this.live_, this.pointing_, {
    send: (message) => this.send(message),
    here: () => this.connection_.send(encodeHere()),
    state: () => this.state_,
    heard: () => this.connection_.state === "live",
    changed: () => this.showChoice(),
  });
  private readonly recordPanel_ = new RecordPanel(
    (on, owner) => this.connection_.send(encodeRecord(on, owner)), () => this.live_.layout?.name ?? "",
    (text, bad) => this.notices_.report(text, bad, "recording"),
  );
  private readonly panel_: Panel;
  private readonly surfacePanel_: SurfacePanel;
  private readonly ledgerPanel_: LedgerPanel;
  private readonly volumePanel_: VolumePanel;
  private readonly theme_: ThemeSwitch;
  private readonly timeline_: Timeline;
  /** The live scene, while a recording is shown. */
  private held_: SceneHold | undefined;
  /** From where the user had turned the view to it. */
  private eye_: Stage["eye"] | undefined;
  private readonly connection_: Connection;
  private state_: State | undefined;
  private serverVersion_: string | undefined;
  private liveName_ = "";
  private stateFresh_ = false;
  private lastPlot_ms_ = 0;
  private lastNumbers_ms_ = 0;

  constructor() {
    this.stage_.scene.add(this.live_.model.group, this.live_.marks.group, this.probe_.group, this.others_.group);
    this.panel_ = this.makePanel();
    this.memory_ = new ViewMemory();
    this.surfacePanel_ = new SurfacePanel((change) => this.sendSettings(change));
    this.ledgerPanel_ = new LedgerPanel((change) => this.sendSettings(change));
    this.volumePanel_ = new VolumePanel((surface, value, below) => this.send(encodeIso(surface, value, below)));
    this.timeline_ = this.makeTimeline();
    this.theme_ = new ThemeSwitch(() => this.applyTheme());
    this.panel_.showTheme(this.theme_.choice);
    this.followWindow();
    this.notices_.followEscape();
    const address = new URL("viewer", location.href);
    address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    this.connection_ = new Connection(address.href, {
      message: (message) => this.receive(message),
      link: (link) => this.linkChanged(link),
      refused: (line) => this.notices_.report(line, true),
      violation: (reason) => this.notices_.report(`Connection closed: ${reason}.`, true),
    });
    publishDebugState({
      link: () => this.connection_.state,
      scene: () => this.live_,
      state: () => this.state_,
      samples: () => this.plots_.samples,
      holding: () => this.hands_.input.holding,
      choice: () => this.hands_.hands.choice,
      recording: () => this.timeline_.recording,
      project: (point) => this.stage_.project(point),
    });
    requestAnimationFrame((now_ms) => this.frame(now_ms));
  }

  private makePanel(): Panel {
    return new Panel({
      settings: (change) => this.sendSettings(change),
      rearm: () => this.send(encodeRearm()),
      theme: (choice) => this.theme_.choose(choice),
      planes: (shown) => this.probe_.setPlanesShown(shown),
      cones: (shown) => this.probe_.cones.setShown(shown),
      marks: (shown) => this.live_.marks.setShown(shown),
      edges: (shown) => this.live_.model.setEdges(shown),
      flat: (flat) => this.live_.model.setFlat(flat),
      orbitFromEmpty: (on) => (this.hands_.input.orbitFromEmpty = on),
      dropLine: (shown) => this.probe_.drop.setShown(shown),
      stylus: (shown) => [this.probe_, this.others_].forEach((view) => view.setStylusShown(shown)),
      resetView: () => this.live_.refit(),
      bringHandBack: () => this.pointing_.bringBack(this.hands_.input),
      section: (side, share) => this.pointing_.cut(side, share),
      sound: (on) => this.sound_.setOn(on),
      pause: (paused) => this.sharing_.setPaused(paused),
      copyLink: () => void this.sharing_.copyLink(this.stage_, this.memory_, this.notices_),
      savePicture: () => void this.sharing_.savePicture(this.stage_),
      saveSamples: () => this.sharing_.saveSamples(),
      saveScene: () => {
        void this.sharing_.saveScene(this.live_.store, settingsOf(this.state_?.surfaces), this.notices_);
      },
    });
  }

  private makeTimeline(): Timeline {
    return new Timeline({
      opened: () => this.leaveLive(),
      closed: () => this.backToLive(),
      scene: (layout, added, gone) => {
        if (this.live_.layout === undefined) {
          this.live_.clear(`recording ${layout.name}`);
        }
        added.forEach((mesh) => this.live_.add(mesh));
        this.live_.setLayout(layout);
        this.live_.forget(gone);
      },
    });
  }

  /** What the server goes on sending of its scene is kept; nothing is sent to it that changes anything. */
  private leaveLive(): void {
    // Before the session is out of reach: the server gets the release.
    this.hands_.leave();
    this.held_ = new SceneHold(this.live_.store);
    this.eye_ = this.stage_.isTurned ? this.stage_.eye : undefined;
    this.notices_.stand("vibration", undefined);
    this.notices_.stand("slow-motion", undefined);
    this.sound_.silence();
    this.stateFresh_ = false;
    this.state_ = undefined;
    this.live_.clear("recording");
    this.showChoice();
  }

  private backToLive(): void {
    const messages = this.held_?.messages() ?? [];
    this.held_ = undefined;
    this.state_ = undefined;
    this.live_.clear(this.liveName_);
    this.hands_.active = true;
    messages.forEach((message) => this.receive(message));
    this.showChoice();
    if (this.eye_ !== undefined && messages[0]?.kind !== "hello") {
      this.stage_.lookFrom(this.eye_.position, this.eye_.target);
    }
  }

  /** A model that the user has opened is shown, in the place of a recording too. Its layout may come later. */
  private showOpened(): void {
    if (this.timeline_.isOpen) {
      this.eye_ = undefined;
      this.timeline_.close();
      this.live_.expectOther(true);
    } else {
      this.live_.taken();
    }
  }

  /** Also before there are states: the largest scenes take longest. */
  private showReceiving(now_ms: number): void {
    const coming = this.connection_.state === "live" && this.held_ === undefined && this.live_.coming;
    const line = this.receiving_.line(coming ? this.live_.store.ahead() : undefined, now_ms);
    this.notices_.stand("receiving", line, "plain");
  }

  /** While a recording is shown the session is not touched. */
  private send(message: Uint8Array<ArrayBuffer>): void {
    if (this.held_ === undefined) {
      this.connection_.send(message);
    }
  }

  private sendSettings(change: SettingsChange): void {
    this.hands_.sendSettings(change);
  }

  private receive(message: Incoming): void {
    if (message.kind === "state") {
      this.recordPanel_.hear(message.state.recording, performance.now());
    }
    if (this.held_ !== undefined && message.kind !== "notice") {
      this.held_.take(message);
      return;
    }
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
        this.notices_.report(message.notice.text, message.notice.fatal);
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
    this.modelFile_.limit_bytes = Number(hello.uploadBytes);
    this.files_.showOffered();
    this.liveName_ = hello.sceneName;
    this.live_.clear(hello.sceneName);
    this.panel_.showHello(hello);
    this.others_.showHello(hello);
    this.hands_.showHello(hello);
    this.surfacePanel_.showQuantities(hello.quantities);
    this.surfacePanel_.forget();
    this.ledgerPanel_.forget();
    this.volumePanel_.forget();
    this.probe_.stylus.setGripper(hello.device?.gripperMaxRad ?? 0);
    this.probe_.setForceMax(hello.device?.forceMaxN ?? 0);
    this.plots_.forget(hello.device?.forceMaxN ?? 0);
    this.sound_.setLimit(hello.device?.forceMaxN ?? 0);
    this.bodies_.forget();
  }

  private showLayout(store: SceneStore, layout: Layout): void {
    this.probe_.setRadius(layout.proxyRadius_m);
    this.panel_.showLayout(layout, store.counts());
    showEmptyHint(layout.placed.length === 0 && this.held_ === undefined);
    this.pointing_.layoutChanged();
    this.surfacePanel_.showMaterials(layout.placed.map(({ materials }) => materials));
    this.volumePanel_.showVolumes(layout.volumes ?? []);
    if (layout.bounds !== undefined) {
      this.stage_.lowerFloor(layout.bounds.min.y);
    }
  }

  private fit(bounds: Bounds): void {
    this.stage_.setBounds(bounds.min, bounds.max);
    this.probe_.setDiagonal(diagonalOf(bounds));
    this.others_.setDiagonal(diagonalOf(bounds));
    const linked = this.memory_.takeCamera();
    if (linked !== undefined) {
      this.stage_.lookFrom(linked.position, linked.target);
    }
  }

  private takeState(state: State): void {
    this.state_ = state;
    this.stateFresh_ = true;
    this.hands_.hands.follow(state);
    this.plots_.take(state);
    this.bodies_.take(state);
    this.sound_.hear(state, this.plots_.samples, worldPerHand(this.live_.layout, undefined));
  }

  private linkChanged(link: LinkState): void {
    this.panel_.showLink(link);
    const texts: Readonly<Partial<Record<LinkState, string>>> = {
      lost: "The server went away. This page comes back by itself when it returns.",
      silent: "The server is silent. Waiting for it…",
    };
    this.notices_.stand("link", texts[link]);
    if (link === "live") {
      this.notices_.connected();
    } else {
      // What was heard last is not what is so now.
      this.stateFresh_ = false;
      this.hands_.input.cancel();
      this.sound_.silence();
      this.recordPanel_.lose();
      this.others_.lose();
    }
  }

  private frame(now_ms: number): void {
    requestAnimationFrame((next_ms) => this.frame(next_ms));
    this.hands_.frame(now_ms);
    this.showRecorded(now_ms);
    this.live_.frame();
    this.pointing_.showPicked(this.hands_.input.pressed);
    this.showProbe();
    this.showReceiving(now_ms);
    this.stage_.draw();
    if (this.stateFresh_ && !this.sharing_.paused && now_ms - this.lastPlot_ms_ >= kPlotPeriod_ms) {
      this.lastPlot_ms_ = now_ms;
      this.plots_.show();
    }
    if (this.stateFresh_ && now_ms - this.lastNumbers_ms_ >= kNumbersPeriod_ms) {
      this.lastNumbers_ms_ = now_ms;
      this.showNumbers();
    }
  }

  private showRecorded(now_ms: number): void {
    const moment = this.timeline_.frame(now_ms);
    if (moment !== undefined) {
      this.state_ = moment.state;
      this.live_.take(moment.state, moment.moves);
      this.probe_.setRadius(moment.scale.radius_m);
    }
  }

  private showProbe(): void {
    // Its size is the scene's, and so is the view: none is known before the first layout.
    this.probe_.update(this.live_.layout === undefined && this.held_ === undefined ? undefined : this.state_);
    const view = this.stage_.viewFrame();
    this.scaleBar_.show(metresPerPixel(view, depthOf(view, this.stage_.target)));
    this.pointing_.showFinder(this.connection_.state === "live" && this.held_ === undefined, this.hands_.input);
    const at = knownVec(this.state_?.proxy) ?? knownVec(this.state_?.finger);
    if (at === undefined) {
      return;
    }
    const pixel_m = metresPerPixel(view, depthOf(view, at));
    this.probe_.face(this.stage_.camera, pixel_m);
    this.others_.showProbes(this.state_, this.stage_.camera, view);
    this.showDrop(view);
  }

  /** Of the hand that the page moves. */
  private showDrop(view: ViewFrame): void {
    const hand = this.hands_.hands.now;
    if (hand?.proxy !== undefined) {
      const pixel_m = metresPerPixel(view, depthOf(view, hand.proxy));
      this.probe_.drop.update(hand.proxy, this.pointing_.below(hand.proxy), hand.radius_m ?? this.probe_.radius_m, pixel_m);
    }
  }

  private showChoice(): void {
    const { hands } = this.hands_;
    this.panel_.showHand(hands.movable, exploreText(hands.choice, hands.device?.label ?? ""));
    this.others_.showChoice(hands.choice);
    // A recording has one hand.
    this.probe_.setAside(this.held_ === undefined && isAside(hands.choice, 0));
  }

  private showNumbers(): void {
    const state = this.state_!;
    const force = knownVec(state.forceN);
    const force_N = force === undefined ? NaN : length(force);
    this.panel_.showState(state, this.hands_.hands.now?.exploring ?? false, force_N, state.samples.at(-1)?.penetrationM);
    this.others_.showNumbers(state);
    this.announcer_.hear(this.touchedInWords(state), force_N, performance.now());
    this.showVibration();
    this.surfacePanel_.showSurfaces(state.surfaces);
    this.ledgerPanel_.show(state.ledger);
    this.volumePanel_.follow();
    this.notices_.stand("slow-motion", this.bodies_.show(state, kWindow_s), "warn");
    this.stateFresh_ = false;
  }

  private touchedInWords(state: State): string {
    const several = this.live_.store.counts().objects > 1;
    const placed = this.live_.layout?.placed;
    const objects = state.touched.map((object) => placed?.[object]?.label || `object ${object + 1}`);
    return state.contacts.length === 0 ? "" : several && objects.length > 0 ? objects.join(" and ") : "the model";
  }

  private showVibration(): void {
    const { times, values } = this.plots_.samples.last(0, kVibrationWindow_s);
    const swing = this.vibration_.judge(times, values);
    const text = swing && `The force vibrates by ${formatFixed(swing.force_N, "N", 1)} at ` +
      `${formatFixed(swing.rate_Hz, "Hz", 0)}: the spring is too stiff for this device and grip. Lower it.`;
    this.notices_.stand("vibration", text, "warn");
  }

  private applyTheme(): void {
    this.stage_.applyTheme();
    this.live_.model.applyTheme();
    this.live_.marks.applyTheme();
    this.probe_.applyTheme();
    this.others_.applyTheme();
    this.plots_.applyTheme();
    this.bodies_.applyTheme();
    this.timeline_.applyTheme();
  }

  private followWindow(): void {
    const fit = () => this.stage_.resize(freeInsets());
    new ResizeObserver(fit).observe(element("view"));
    fit();
    // What stands above the hints, or above the timeline in their place, makes room for their lines.
    const foot = [element("hints"), element("timeline")];
    const rise = new ResizeObserver(() => {
      const height_px = Math.max(...foot.map(({ offsetHeight }) => offsetHeight));
      document.documentElement.style.setProperty("--foot-height", `${height_px}px`);
    });
    foot.forEach((part) => rise.observe(part));
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
