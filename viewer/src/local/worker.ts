// The server of a page without a server: a worker that runs the engine in time with the clock and speaks the protocol.

import { fromBinary } from "@bufbuild/protobuf";
import makeModule from "hl-web-module";
import binaryUrl from "hl-web-binary?url";
import { ViewerMessageSchema, type Settings, type Surfaces } from "../gen/hl_pb";
import { loadBuiltin, Numbers, type Module } from "./engine";
import { sceneMessages, stateMessage, type Sample } from "./messages";

const kTimer_ms = 4;
const kState_ms = 16;
/** Servo steps at one go: a worker that was asleep does not catch up with more. */
const kMostSteps = 20;
/** Steps between two samples of the plots. */
const kSampleSteps = 4;
const kRateWindow_ms = 1000;
/** In the order of base/quantities.def. */
const kFields = ["stiffness", "staticFriction", "dynamicFriction", "viscosityNsM", "stribeckMS", "preslidingNM", "adhesionN"] as const;

class Server {
  private surfaces_: Partial<Surfaces> = { textures: true };
  private samples_: Sample[] = [];
  private last_ms_ = performance.now();
  private told_ms_ = 0;
  private counted_ = 0;
  private window_ms_ = performance.now();
  private rate_Hz_ = 0;

  constructor(private readonly module_: Module, name: string) {
    sceneMessages(module_, name).forEach((bytes) => this.post(bytes));
    setInterval(() => this.run(), kTimer_ms);
  }

  receive(bytes: Uint8Array): void {
    const { body } = fromBinary(ViewerMessageSchema, bytes);
    const module = this.module_;
    if (body.case === "handGoal" && body.value.position !== undefined) {
      const { x, y, z } = body.value.position;
      module._hlWebGoal(x, y, z);
    } else if (body.case === "release") {
      module._hlWebRelease();
    } else if (body.case === "press") {
      module._hlWebPress(body.value.buttons);
    } else if (body.case === "rearm") {
      module._hlWebRearm();
    } else if (body.case === "explore") {
      module._hlWebExplore(1);
    } else if (body.case === "settings") {
      this.set(body.value);
    }
  }

  private set(settings: Settings): void {
    const module = this.module_;
    if (settings.explore !== undefined) module._hlWebExplore(Number(settings.explore));
    if (settings.handFirm !== undefined) module._hlWebFirm(Number(settings.handFirm));
    if (settings.stiffnessNM !== undefined) module._hlWebStiffness(settings.stiffnessNM);
    if (settings.ledger !== undefined) module._hlWebLedger(settings.ledger);
    const surfaces = settings.surfaces;
    if (surfaces === undefined) return;
    kFields.forEach((field, i) => module._hlWebSurface(i, surfaces[field] ?? NaN));
    const smooth = surfaces.smooth === undefined ? -1 : Number(surfaces.smooth);
    module._hlWebLook(smooth, Number(surfaces.textures ?? true));
    this.surfaces_ = { ...surfaces, textures: surfaces.textures ?? true };
  }

  private run(): void {
    const now_ms = performance.now();
    const wanted = Math.floor(now_ms - this.last_ms_);
    const steps = Math.min(wanted, kMostSteps);
    for (let done = 0; done < steps; done += kSampleSteps) this.step(Math.min(kSampleSteps, steps - done));
    this.last_ms_ += wanted;
    this.count(steps, now_ms);
    if (now_ms - this.told_ms_ < kState_ms) return;
    this.told_ms_ = now_ms;
    this.post(stateMessage(this.module_, this.samples_.splice(0), this.rate_Hz_, this.surfaces_));
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

async function serve(name: string): Promise<Server> {
  const response = await fetch(binaryUrl);
  if (!response.ok) throw new Error(`${binaryUrl} cannot be loaded (${response.status}): reload the page`);
  const module = await makeModule({ wasmBinary: await response.arrayBuffer() });
  loadBuiltin(module, name);
  return new Server(module, name);
}

let server: Server | undefined;
onmessage = (event: MessageEvent<{ scene: string } | Uint8Array>) => {
  const data = event.data;
  if (data instanceof Uint8Array) {
    server?.receive(data);
    return;
  }
  serve(data.scene).then(
    (made) => (server = made),
    (error: unknown) => postMessage(error instanceof Error ? error.message : String(error)),
  );
};
