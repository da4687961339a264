// The server of a page without a server: a worker that runs the engine in time with the clock and speaks the protocol.

import { fromBinary } from "@bufbuild/protobuf";
import makeModule from "hl-web-module";
import binaryUrl from "hl-web-binary?url";
import { ViewerMessageSchema, type Settings, type Surfaces } from "../gen/hl_pb";
import { loadBuiltin, loadMesh, Numbers, type Module } from "./engine";
import type { Loaded, Order, Word } from "./engine_worker";
import { helloMessage, stateMessage, type Sample } from "./messages";
import { parseQuantities, type EngineQuantity } from "./quantities";
import { SentScene } from "./sent_scene";

const kTimer_ms = 4;
const kState_ms = 16;
/** Servo steps in one turn: a worker that was asleep does not catch up with more. */
const kMaxSteps = 20;
/** Steps between two samples of the plots. */
const kSampleSteps = 4;
const kRateWindow_ms = 1000;
/** A surface that was changed is drawn in full when it has been the same for so long. */
const kStill_ms = 1000;

class Server {
  private readonly quantities_: readonly EngineQuantity[];
  private surfaces_: Partial<Surfaces> = { textures: true };
  /** What the user has set, for the next scene: the engine begins each with its own. */
  private kept_: Partial<Settings> = {};
  private readonly scene_ = new SentScene();
  private timer_: ReturnType<typeof setInterval> | undefined;
  private running_ = true;
  private samples_: Sample[] = [];
  private last_ms_ = performance.now();
  private sent_ms_ = 0;
  private counted_ = 0;
  private window_ms_ = performance.now();
  private rate_Hz_ = 0;
  /** Of objects that are drawn coarsely. */
  private readonly refining_ = new Map<number, ReturnType<typeof setTimeout>>();

  constructor(private readonly module_: Module) {
    this.quantities_ = parseQuantities(module_.UTF8ToString(module_._hlWebQuantities()));
  }

  /** `make` loads it, or throws and changes nothing. */
  show(name: string, make: (module: Module) => void): Loaded {
    make(this.module_);
    this.refining_.forEach((timer) => clearTimeout(timer));
    this.refining_.clear();
    this.apply(this.kept_);
    if (this.scene_.layout === 0) this.post(helloMessage(this.module_, name, this.quantities_));
    this.scene_.messages(this.module_, name).forEach((bytes) => this.post(bytes));
    this.schedule();
    const { triangles, worldPerDevice } = this.scene_;
    return { triangles, worldPerDevice };
  }

  setRunning(running: boolean): void {
    this.running_ = running;
    this.schedule();
  }

  /** The time that it stood still is left out. */
  private schedule(): void {
    clearInterval(this.timer_);
    this.timer_ = undefined;
    if (!this.running_ || this.scene_.layout === 0) return;
    this.last_ms_ = this.window_ms_ = performance.now();
    this.counted_ = 0;
    this.timer_ = setInterval(() => this.run(), kTimer_ms);
  }

  receive(bytes: Uint8Array): void {
    const { body } = fromBinary(ViewerMessageSchema, bytes);
    const module = this.module_;
    if (body.case === "handGoal" && body.value.position !== undefined) {
      const { x, y, z } = body.value.position;
      this.kept_.explore = false;
      module._hlWebGoal(x, y, z);
    } else if (body.case === "release") {
      module._hlWebRelease();
    } else if (body.case === "press") {
      module._hlWebPress(body.value.buttons);
    } else if (body.case === "handTurn" && body.value.rotation !== undefined) {
      const { x, y, z, w } = body.value.rotation;
      module._hlWebTurn(x, y, z, w);
    } else if (body.case === "rearm") {
      module._hlWebRearm();
    } else if (body.case === "explore") {
      this.set({ explore: true });
    } else if (body.case === "settings") {
      this.set(body.value);
    } else if (body.case === "iso") {
      this.setIso(Number(body.value.surface) - 1, body.value.value, body.value.below);
    }
  }

  /** Values that are none, and surfaces of a scene that has gone, change nothing. */
  private setIso(volume: number, value: number, below: boolean | undefined): void {
    if (volume < 0 || volume >= this.scene_.volumes) return;
    const n = new Numbers(this.module_, this.module_._hlWebVolume(volume));
    const [object, , , , was] = n.list(5) as [number, number, number, number, number];
    if (this.module_._hlWebIso(volume, value, below === undefined ? was : Number(below)) === 0) return;
    this.scene_.changed(this.module_, object, true).forEach((bytes) => this.post(bytes));
    clearTimeout(this.refining_.get(object));
    this.refining_.set(object, setTimeout(() => {
      this.scene_.changed(this.module_, object, false).forEach((bytes) => this.post(bytes));
    }, kStill_ms));
  }

  private set(settings: Partial<Settings>): void {
    const given = Object.entries(settings).filter(([, value]) => value !== undefined);
    Object.assign(this.kept_, Object.fromEntries(given));
    this.apply(settings);
  }

  private apply(settings: Partial<Settings>): void {
    const module = this.module_;
    if (settings.explore !== undefined) module._hlWebExplore(Number(settings.explore));
    if (settings.handFirm !== undefined) module._hlWebFirm(Number(settings.handFirm));
    if (settings.stiffnessNM !== undefined) module._hlWebStiffness(settings.stiffnessNM);
    if (settings.ledger !== undefined) module._hlWebLedger(settings.ledger);
    const surfaces = settings.surfaces;
    if (surfaces === undefined) return;
    this.quantities_.forEach(({ field }, i) => module._hlWebSurface(i, surfaces[field] ?? NaN));
    const smooth = surfaces.smooth === undefined ? -1 : Number(surfaces.smooth);
    module._hlWebLook(smooth, Number(surfaces.textures ?? true));
    this.surfaces_ = { ...surfaces, textures: surfaces.textures ?? true };
  }

  private run(): void {
    const now_ms = performance.now();
    const wanted = Math.floor(now_ms - this.last_ms_);
    const steps = Math.min(wanted, kMaxSteps);
    for (let done = 0; done < steps; done += kSampleSteps) this.step(Math.min(kSampleSteps, steps - done));
    this.last_ms_ += wanted;
    this.count(steps, now_ms);
    if (now_ms - this.sent_ms_ < kState_ms) return;
    this.sent_ms_ = now_ms;
    this.post(stateMessage(this.module_, this.samples_.splice(0), this.rate_Hz_, this.surfaces_, this.scene_));
  }

  private step(steps: number): void {
    const begin_ms = performance.now();
    this.module_._hlWebStep(steps);
    const tickUs = (1e3 * (performance.now() - begin_ms)) / steps;
    const n = new Numbers(this.module_, this.module_._hlWebState());
    const timeS = n.next();
    n.list(6);
    const forceN = Math.hypot(...n.list(3));
    n.list(2);
    this.samples_.push({ timeS, forceN, penetrationM: n.next(), tickUs });
  }

  private count(steps: number, now_ms: number): void {
    this.counted_ += steps;
    const window_ms = now_ms - this.window_ms_;
    if (window_ms < kRateWindow_ms) return;
    this.rate_Hz_ = (1e3 * this.counted_) / window_ms;
    this.counted_ = 0;
    this.window_ms_ = now_ms;
  }

  private post(bytes: Uint8Array<ArrayBuffer>): void {
    postMessage(bytes);
  }
}

async function start(): Promise<Server> {
  const response = await fetch(binaryUrl);
  if (!response.ok) throw new Error(`${binaryUrl} cannot be loaded (${response.status}): reload the page`);
  const module = await makeModule({ wasmBinary: await response.arrayBuffer() });
  send({ scenes: module.UTF8ToString(module._hlWebScenes()) });
  return new Server(module);
}

function send(word: Word): void {
  postMessage(word);
}

function load(server: Server, order: Extract<Order, { load: number }>): Loaded {
  if ("scene" in order) return server.show(order.scene, (module) => loadBuiltin(module, order.scene));
  const { name, positions, triangles } = order.mesh;
  return server.show(name, (module) => loadMesh(module, name, positions, triangles));
}

let server: Server | undefined;
const started = start().then((made) => (server = made));
onmessage = ({ data }: MessageEvent<Order | Uint8Array>) => {
  if (data instanceof Uint8Array) {
    server?.receive(data);
  } else if ("running" in data) {
    void started.then((made) => made.setRunning(data.running), () => undefined);
  } else {
    started.then((made) => load(made, data)).then(
      (loaded) => send({ load: data.load, loaded }),
      (error: unknown) => send({ load: data.load, error: error instanceof Error ? error.message : String(error) }),
    );
  }
};
