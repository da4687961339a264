// Reads a recording file into what the page shows of it. A file may say anything: what does not agree with itself is
// refused in one line.

import type {
  ProxyTicks, RecordedHeights, RecordedPoses, RecordedScene as SceneMessage, RecordedShape, RecordedSurfaces, RecordingBlock,
  RecordingStart, ServoSteps,
} from "../gen/recording_pb";
import type { Mesh } from "../scene_messages";
import type { SurfaceSettings } from "../surfaces";
import { BodyTrackBuilder } from "./body_tracks";
import { HeightParts } from "./recorded_heights";
import { MeshParts } from "./recorded_mesh";
import { materialOf, tickContext, waysOf, type TickContext } from "./recorded_values";
import { kStepColumns, kTickColumns, type RecordedScene, type Recording, type Scale } from "./recording";
import { readBlocks, RecordingError } from "./recording_blocks";
import { TrackBuilder } from "./track";

/** Samples that the page keeps of each loop: at 1 kHz all of half an hour; of more every second, every fourth, ... */
const kMaxSamples = 2_000_000;
const kMaxMesh_bytes = 2 ** 30;
/** Of all scenes together. */
const kMaxInstances = 1_000_000;

/** Numbers of a body's pose. */
const kPose = 12;

/** The device has no wrist. */
const kNoTurn = [0, 0, 0, 0];
const kBroken = "makes no sense: the lists of a block do not agree";

/** `progress`: the share that is read. Throws RecordingError with what follows the name of the file in a sentence. */
export async function readRecording(file: Blob, progress: (share: number) => void): Promise<Recording> {
  const reader = new RecordingReader();
  const damage = await readBlocks(file, (block, share) => {
    reader.take(block);
    progress(share);
  });
  return reader.recording(damage);
}

class RecordingReader {
  private start_: RecordingStart | undefined;
  private first_s_: number | undefined;
  private last_s_ = 0;
  private end_ = "";
  private readonly steps_ = new TrackBuilder(kStepColumns, kMaxSamples);
  private readonly ticks_ = new TrackBuilder(kTickColumns, kMaxSamples);
  private readonly scales_: Scale[] = [];
  private readonly parts_ = new MeshParts();
  private readonly heights_ = new HeightParts();
  private readonly meshes_ = new Map<bigint, Mesh>();
  private mesh_bytes_ = 0;
  private lastMesh_ = 0;
  private readonly surfaces_ = new Map<bigint, readonly SurfaceSettings[]>();
  private readonly messages_: SceneMessage[] = [];
  private readonly sceneNumbers_ = new Map<bigint, number>();
  private instances_ = 0;
  private readonly bodies_ = new BodyTrackBuilder();

  take({ body }: RecordingBlock): void {
    if (this.start_ === undefined) {
      if (body.case !== "start") {
        throw new RecordingError("is no recording of HL: it does not begin as one");
      }
      this.start_ = body.value;
      return;
    }
    switch (body.case) {
      case "shape": return this.addShape(body.value);
      case "heights": return this.addHeights(body.value);
      case "surfaces": return this.addSurfaces(body.value);
      case "scene": return this.addScene(body.value);
      case "ticks": return this.addTicks(body.value);
      case "poses": return this.addPoses(body.value);
      case "steps": return this.addSteps(body.value);
      case "end":
        this.end_ = body.value.reason;
        return;
      default:
    }
  }

  recording(damage: string | undefined): Recording {
    const start = this.start_;
    if (start === undefined) {
      throw new RecordingError(damage === undefined ? "is empty" : "is cut short: nothing of it can be read");
    }
    const [steps, ticks] = [this.steps_.track(), this.ticks_.track()];
    if (steps.times.length === 0) {
      throw new RecordingError("holds no steps: there is nothing to show");
    }
    const bodies = this.bodies_.tracks((time_ns) => 1e-9 * (time_ns - Number(this.origin_ns)));
    const bodyNumbers = new Map([...bodies.keys()].map((id, number) => [id, number]));
    return {
      version: start.version, device: start.deviceName, begin_unix_ms: Number(start.beginUnixMs),
      servoRate_Hz: start.servoRateHz, blackBox: start.blackBox, fault: start.fault,
      end: damage ?? (this.end_ || "the program was killed"),
      begin_s: this.first_s_ ?? 0, end_s: this.last_s_, steps, ticks, scales: this.scales_, meshes: [...this.meshes_.values()],
      scenes: this.messages_.map((message) => this.sceneOf(message, bodyNumbers)), bodies: [...bodies.values()],
    };
  }

  /** Time 0, ns: when the recording began. Ticks may be from before. */
  private get origin_ns(): bigint {
    return this.start_!.beginNs;
  }

  private seconds(time_ns: bigint): number {
    return 1e-9 * Number(time_ns - this.origin_ns);
  }

  private addShape(shape: RecordedShape): void {
    this.countMesh(4 * (shape.positions.length + shape.normals.length + shape.triangles.length));
    this.keepMesh(shape.id, this.parts_.add(this.lastMesh_ + 1, shape));
  }

  private addHeights(heights: RecordedHeights): void {
    this.countMesh(heights.samples.length);
    this.keepMesh(heights.id, this.heights_.add(this.lastMesh_ + 1, heights));
  }

  private countMesh(bytes: number): void {
    this.mesh_bytes_ += bytes;
    if (this.mesh_bytes_ > kMaxMesh_bytes) {
      throw new RecordingError("has meshes of more than 1 GB, too many for the page: use hl replay");
    }
  }

  private keepMesh(id: bigint, mesh: Mesh | undefined): void {
    if (mesh !== undefined) {
      this.lastMesh_ += 1;
      this.meshes_.set(id, mesh);
    }
  }

  private addSurfaces(surfaces: RecordedSurfaces): void {
    this.surfaces_.set(surfaces.id, surfaces.materials.map(materialOf));
  }

  private addScene(scene: SceneMessage): void {
    this.instances_ += scene.instances.length;
    if (this.instances_ > kMaxInstances) {
      throw new RecordingError("has too many objects and scenes for the page: use hl replay");
    }
    if (scene.instances.some(({ shape }) => !this.meshes_.has(shape))) {
      throw new RecordingError("makes no sense: a scene in it lacks a mesh");
    }
    this.sceneNumbers_.set(scene.identity, this.messages_.length);
    this.messages_.push(scene);
  }

  private sceneOf(scene: SceneMessage, bodies: ReadonlyMap<bigint, number>): RecordedScene {
    return {
      name: scene.name,
      instances: scene.instances.map(({ shape, surfaces, motion, session, object, name, body, label, colour }) => ({
        mesh: this.meshes_.get(shape)!.number, ways: waysOf(motion, (time_ns) => this.seconds(time_ns)),
        session, object, name, body: bodies.get(body) ?? -1, materials: this.surfaces_.get(surfaces) ?? [],
        label, colour: colour === undefined ? new Uint8Array() : Uint8Array.of(colour >> 16, colour >> 8, colour),
      })),
    };
  }

  private addPoses({ timeNs, bodies, poses }: RecordedPoses): void {
    if (poses.length !== kPose * bodies.length || !poses.every(Number.isFinite)) {
      throw new RecordingError("makes no sense: the poses of its bodies do not agree with their list");
    }
    bodies.forEach((body, i) => this.bodies_.add(body, Number(timeNs), poses.slice(kPose * i, kPose * (i + 1))));
  }

  private addTicks(ticks: ProxyTicks): void {
    const count = ticks.timeNs.length;
    if (count === 0 || ticks.commands[0]?.at !== 0 || ticks.contacts.length !== count ||
        [ticks.finger, ticks.proxy].some((list) => list.length !== 3 * count)) {
      throw new RecordingError(kBroken);
    }
    let context: TickContext | undefined;
    let scene = 0;
    let next = 0;
    this.eachTime(ticks.timeNs, (time_s, i) => {
      if (ticks.commands[next]?.at === i) {
        context = tickContext(ticks.commands[next]!.values);
        scene = this.sceneNumber(context);
        this.follow(time_s, context);
        next += 1;
      }
      const { origin: { x, y, z }, worldPerDevice: scale } = context!;
      const { finger, proxy } = ticks;
      this.ticks_.add(
        time_s, ticks.contacts[i]!, scene, proxy[3 * i]!, proxy[3 * i + 1]!, proxy[3 * i + 2]!,
        x + scale * finger[3 * i]!, y + scale * finger[3 * i + 1]!, z + scale * finger[3 * i + 2]!,
      );
    });
  }

  private sceneNumber({ scene }: TickContext): number {
    const number = this.sceneNumbers_.get(scene);
    if (number === undefined) {
      throw new RecordingError("makes no sense: it lacks a scene that it touches");
    }
    return number;
  }

  private follow(from_s: number, { radius_m, worldPerDevice }: TickContext): void {
    const last = this.scales_.at(-1);
    if (last?.radius_m !== radius_m || last.worldPerDevice !== worldPerDevice) {
      this.scales_.push({ from_s, radius_m, worldPerDevice });
    }
  }

  private addSteps(steps: ServoSteps): void {
    const count = steps.timeNs.length;
    const { forceN: force, position, targetProxy: target, flags } = steps;
    const { stylusTurned: turned, gripperRad: gripper } = steps;
    if (count === 0 || flags.length !== count || [force, position, target].some((list) => list.length !== 3 * count) ||
        ![0, 4 * count].includes(turned.length) || ![0, count].includes(gripper.length)) {
      throw new RecordingError(kBroken);
    }
    this.eachTime(steps.timeNs, (time_s, i) => {
      const at = 3 * i;
      const vec = (list: readonly number[]) => [list[at]!, list[at + 1]!, list[at + 2]!] as const;
      const [f, p, t] = [vec(force), vec(position), vec(target)];
      const valid = ((flags[i]! >>> 5) & 1) === 1;
      const penetration_m = valid ? Math.hypot(t[0] - p[0], t[1] - p[1], t[2] - p[2]) : 0;
      this.steps_.add(time_s, Math.hypot(...f), penetration_m, ...f, ...p, (flags[i]! >>> 6) & 7,
        ...(turned.length > 0 ? turned.slice(4 * i, 4 * i + 4) : kNoTurn), gripper[i] ?? 0);
      this.first_s_ ??= time_s;
      this.last_s_ = Math.max(this.last_s_, time_s);
    });
  }

  /** Each time is stored as the difference to the one before. */
  private eachTime(differences: readonly bigint[], act: (time_s: number, index: number) => void): void {
    let time_ns = Number(differences[0]! - this.origin_ns);
    differences.forEach((difference, i) => {
      time_ns += i === 0 ? 0 : Number(difference);
      act(1e-9 * time_ns, i);
    });
  }
}
