// A small stand-in for `hl touch`: serves the built page and a sphere with an analytic proxy, and does on command what
// a real server does rarely (faults, silence, garbage). For tests of the page alone; the forces are those of a spring.

import { create, fromBinary, toBinary, type MessageInitShape } from "@bufbuild/protobuf";
import { createReadStream, existsSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { WebSocketServer, type WebSocket } from "ws";
import {
  LedgerMode, type OtherDeviceSchema, type PageRecordingSchema, type PlacedVolumeSchema, SafetyState, ServerMessageSchema, type SharedWorldSchema,
  SurfacesSchema, TicksEndedSchema, ViewerMessageSchema, type ViewerMessage,
} from "../src/gen/hl_pb";
import { kProtocolVersion } from "../src/protocol";
import { add, length, scale, sub, type Vec } from "../src/vec";

const kDist = fileURLToPath(new URL("../dist", import.meta.url));
const kTypes: Readonly<Record<string, string>> = {
  ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml",
};
const kSphere_m = 0.05;
const kProxy_m = 0.001;
const kSceneFriction = 0.5;
const kStatePeriod_ms = 16;
const kSamplesPerState = 16;
const kSphereMesh = 1;
const kForceMax_N = 8.5;
const kMaterial = { stiffness: 1, staticFriction: kSceneFriction, dynamicFriction: 0.3, viscosityNsM: 0 };
const kSway_m = 0.01;

type Body = NonNullable<MessageInitShape<typeof ServerMessageSchema>["body"]>;

export class FakeServer {
  readonly received: ViewerMessage[] = [];
  /** Whether the device says that a simulated hand holds it. */
  simulatedHand = true;
  explore = true;
  handFirm = false;
  stiffness_N_m = 1000;
  surfaces = create(SurfacesSchema);
  ledger = LedgerMode.TANK;
  slipping = false;
  /** What the server holds the spring below, N/m; 0: nothing. */
  held_N_m = 0;
  /** The first sphere sways toward the viewer and back. */
  swaying = false;
  /** The force swings between none and the device's limit. */
  shaking = false;
  name = "sphere";
  fault = "";
  /** What it reports of a recording for a page; undefined: it makes none. */
  recording: MessageInitShape<typeof PageRecordingSchema> | undefined;
  /** The world that it shares, and the hands of its other servers; undefined: it shares none. */
  shared: MessageInitShape<typeof SharedWorldSchema> | undefined;
  remote: MessageInitShape<typeof OtherDeviceSchema>[] = [];
  silent = false;
  /** A page that comes is sent no scene until sendScene(). */
  withholding = false;
  /** The largest model file that it says it takes, bytes. */
  uploadBytes = 0n;
  /** Surfaces of volumes in its next layout. */
  volumes: MessageInitShape<typeof PlacedVolumeSchema>[] = [];
  buttons = 0;
  ticksEnded = create(TicksEndedSchema);
  /** How many spheres there are, side by side; the first one is touched. */
  spheres = 1;
  private readonly http_: Server;
  private readonly sockets_: WebSocketServer;
  private readonly timer_: NodeJS.Timeout;
  private readonly start_ms_ = performance.now();
  private time_s_ = 0;
  private layout_ = 1;
  private finger_: Vec = { x: 0, y: 0, z: 2 * kSphere_m };
  private goal_: Vec | undefined;

  private constructor(http: Server) {
    this.http_ = http;
    this.sockets_ = new WebSocketServer({ server: http, path: "/viewer" });
    this.sockets_.on("connection", (socket) => this.greet(socket));
    this.timer_ = setInterval(() => this.step(), kStatePeriod_ms);
  }

  /** Port 0 takes any free one. */
  static async start(port = 0): Promise<FakeServer> {
    const http = createServer((request, response) => {
      const path = normalize(new URL(request.url ?? "/", "http://localhost").pathname);
      const file = join(kDist, path === "/" ? "index.html" : path);
      if (!file.startsWith(kDist) || !existsSync(file)) {
        response.writeHead(404).end();
        return;
      }
      response.writeHead(200, { "Content-Type": kTypes[extname(file)] ?? "application/octet-stream" });
      createReadStream(file).pipe(response);
    });
    await new Promise<void>((resolve, reject) => http.once("error", reject).listen(port, "127.0.0.1", resolve));
    return new FakeServer(http);
  }

  get port(): number {
    return (this.http_.address() as AddressInfo).port;
  }

  get url(): string {
    return `http://127.0.0.1:${this.port}/`;
  }

  /** Raw bytes to every page: for messages that no server should send. */
  sendRaw(bytes: Uint8Array): void {
    this.sockets_.clients.forEach((socket) => socket.send(bytes));
  }

  send(body: Body): void {
    this.sendRaw(encode(body));
  }

  /** Shows another number of spheres, with a new layout. */
  place(spheres: number): void {
    this.spheres = spheres;
    this.layout_ += 1;
    this.send(this.layout());
  }

  /** The mesh, and then what places it. */
  sendMesh(): void {
    this.send(sphereMesh(64, 128));
  }

  sendScene(): void {
    this.send(this.layout());
  }

  /** As if the server ended and another one began with another scene. */
  begin(name: string, spheres: number): void {
    this.name = name;
    this.spheres = spheres;
    this.sockets_.clients.forEach((socket) => socket.terminate());
  }

  /** Ends; `start` with the same port is its return. */
  async close(): Promise<void> {
    clearInterval(this.timer_);
    this.sockets_.clients.forEach((socket) => socket.terminate());
    this.sockets_.close();
    await new Promise((resolve) => this.http_.close(resolve));
  }

  private greet(socket: WebSocket): void {
    socket.on("message", (data: Buffer) => this.obey(fromBinary(ViewerMessageSchema, new Uint8Array(data))));
    const device = {
      name: "simulated sphere", forceMaxN: kForceMax_N, stiffnessNM: 1000, stiffnessMaxNM: 3500, dampingNsM: 1,
      servoRateHz: 1000, proxyRateHz: 1000, simulatedHand: this.simulatedHand,
    };
    const quantities = [
      { field: "stiffness", name: "stiffness", usual: 1, otherwise: 1, words: "part of the spring" },
      { field: "staticFriction", name: "static friction", usual: 1.5, words: "mu_s" },
      { field: "dynamicFriction", name: "dynamic friction", usual: 1.5, words: "mu_d" },
      { field: "viscosityNsM", name: "viscosity", unit: "N s/m", usual: 20, words: "drag" },
    ];
    const { name: sceneName, uploadBytes } = this;
    const hello = { protocolVersion: kProtocolVersion, serverVersion: "fake", sceneName, device, quantities, uploadBytes };
    socket.send(encode({ case: "hello", value: hello }));
    if (!this.withholding) {
      socket.send(encode(sphereMesh(64, 128)));
      socket.send(encode(this.layout()));
    }
  }

  private obey(message: ViewerMessage): void {
    this.received.push(message);
    const { body } = message;
    if (body.case === "handGoal" && body.value.position !== undefined) {
      this.goal_ = body.value.position;
      this.explore = false;
    } else if (body.case === "settings") {
      this.explore = body.value.explore ?? this.explore;
      this.handFirm = body.value.handFirm ?? this.handFirm;
      this.stiffness_N_m = body.value.stiffnessNM ?? this.stiffness_N_m;
      this.surfaces = body.value.surfaces ?? this.surfaces;
      this.ledger = body.value.ledger ?? this.ledger;
    } else if (body.case === "press") {
      this.buttons = body.value.buttons;
    } else if (body.case === "rearm") {
      this.fault = "";
    }
  }

  private step(): void {
    const before_s = this.time_s_;
    this.time_s_ = (performance.now() - this.start_ms_) / 1000;
    const angle = this.time_s_ * 0.9;
    const stroke = {
      x: Math.sin(angle) * 0.9, y: 0.25 * Math.sin(angle * 0.7), z: Math.cos(angle) * 0.9,
    };
    const depth_m = 0.003 + 0.002 * Math.sin(angle * 2.3);
    const goal = this.explore ? scale(stroke, (kSphere_m - depth_m) / length(stroke)) : (this.goal_ ?? this.finger_);
    this.finger_ = add(this.finger_, scale(sub(goal, this.finger_), 0.25));
    if (!this.silent) {
      this.sendState(before_s);
    }
  }

  private sendState(before_s: number): void {
    const distance = length(this.finger_);
    const normal = scale(this.finger_, 1 / Math.max(distance, 1e-9));
    const inside = distance < kSphere_m + kProxy_m;
    const proxy = inside ? scale(normal, kSphere_m + kProxy_m) : this.finger_;
    const force = this.fault ? scale(normal, 0) : scale(sub(proxy, this.finger_), this.stiffness_N_m);
    const span_s = this.time_s_ - before_s;
    const samples = Array.from({ length: kSamplesPerState }, (_, i) => ({
      timeS: before_s + (span_s * (i + 1)) / kSamplesPerState,
      forceN: this.shaking
        ? (i < kSamplesPerState / 2 ? 0 : kForceMax_N)
        : length(force) * (1 + 0.01 * Math.sin(i * 1.7)),
      penetrationM: length(sub(proxy, this.finger_)),
      tickUs: 2.5,
    }));
    const steps = BigInt(Math.round(this.time_s_ * 1000));
    const loop = { timeP50Us: 2.31, timeP999Us: 11.8, timeMaxUs: 46.2, deadlinesMissed: 3n, steps };
    this.send({
      case: "state",
      value: {
        timeS: this.time_s_, finger: this.finger_, proxy, forceN: force, samples,
        contacts: inside ? [this.contact(normal)] : [],
        ...(this.swaying ? { moved: [0], movedPoses: bytesOf(this.swayed()) } : {}),
        ...(this.recording === undefined ? {} : { recording: this.recording }),
        ...(this.shared === undefined ? {} : { shared: this.shared }),
        remote: this.remote,
        vibration: { limitNM: this.held_N_m },
        slipping: inside && this.slipping,
        ledger: this.ledgerNow(),
        surfaces: { ...this.surfaces, textures: this.surfaces.textures ?? true },
        safety: this.fault ? SafetyState.FAULT : SafetyState.ON,
        fault: this.fault,
        servo: { ...loop, rateHz: 1000 },
        proxyLoop: { ...loop, rateHz: 1000 + 4 * Math.sin(this.time_s_) },
        buttons: this.buttons, layout: this.layout_, touched: inside && this.spheres > 0 ? [0] : [],
        exploring: this.explore, handFirm: this.handFirm, stiffnessNM: this.stiffness_N_m,
        iterationCaps: this.ticksEnded.capped + this.ticksEnded.crowded,
        unplacedTicks: this.ticksEnded.unplaced, ticksEnded: this.ticksEnded,
      },
    });
  }

  private layout(): Body {
    const poses = Array.from({ length: this.spheres }, (_, i) => [1, 0, 0, 3 * i * kSphere_m, 0, 1, 0, 0, 0, 0, 1, 0]);
    const bounds = {
      boundsMin: { x: -kSphere_m, y: -kSphere_m, z: -kSphere_m },
      boundsMax: { x: kSphere_m * (3 * this.spheres - 2), y: kSphere_m, z: kSphere_m },
    };
    return {
      case: "layout",
      value: {
        number: this.layout_, name: this.name, proxyRadius: kProxy_m, worldPerDevice: 1,
        volumes: this.volumes,
        placed: poses.map(() => ({ mesh: kSphereMesh, materials: [kMaterial] })), poses: bytesOf(Float32Array.from(poses.flat())),
        ...(this.spheres > 0 ? bounds : {}),
      },
    };
  }

  private swayed(): Float32Array {
    return Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, kSway_m * Math.sin(2 * this.time_s_));
  }

  private contact(normal: Vec) {
    const staticFriction = this.surfaces.staticFriction ?? kSceneFriction;
    return { point: scale(normal, kSphere_m), normal, multiplierM: 0.001, staticFriction, stiffness: 1 };
  }

  /** Every cause at its own speed, so that their lines can be distinguished. */
  private ledgerNow() {
    const t = this.time_s_;
    return {
      mode: this.ledger, tankJ: 0.025 + 0.025 * Math.sin(t),
      shadingJ: 4e-4 * t, stiffnessJ: 3e-4 * t, textureJ: 2e-4 * t, movingJ: 1e-4 * t, lateJ: 0,
    };
  }
}

function encode(body: Body): Uint8Array {
  return toBinary(ServerMessageSchema, create(ServerMessageSchema, { body }));
}

export function bytesOf(values: Float32Array | Uint32Array): Uint8Array {
  return new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
}

function sphereMesh(rows: number, columns: number): Body {
  const normals: number[] = [];
  const triangles: number[] = [];
  for (let row = 0; row <= rows; ++row) {
    for (let column = 0; column <= columns; ++column) {
      const [theta, phi] = [(row / rows) * Math.PI, (column / columns) * 2 * Math.PI];
      normals.push(Math.sin(theta) * Math.sin(phi), Math.cos(theta), Math.sin(theta) * Math.cos(phi));
      if (row < rows && column < columns) {
        const [a, b] = [row * (columns + 1) + column, (row + 1) * (columns + 1) + column];
        triangles.push(a, b, a + 1, a + 1, b, b + 1);
      }
    }
  }
  const positions = Float32Array.from(normals, (n) => n * kSphere_m);
  return {
    case: "mesh",
    value: {
      number: kSphereMesh,
      positions: bytesOf(positions),
      normals: bytesOf(Float32Array.from(normals)),
      triangles: bytesOf(Uint32Array.from(triangles)),
      boundsMin: { x: -kSphere_m, y: -kSphere_m, z: -kSphere_m },
      boundsMax: { x: kSphere_m, y: kSphere_m, z: kSphere_m },
    },
  };
}
