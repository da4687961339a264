// A recording at one moment, in the messages that the page shows a live session with.

import { create } from "@bufbuild/protobuf";
import { PlacedMeshSchema, SafetyState, StateSchema, type State } from "../gen/hl_pb";
import { kPoseNumbers, type Bounds, type Layout, type Mesh, type Moves } from "../scene_messages";
import type { Vec } from "../vec";
import { trackedPose } from "./body_tracks";
import { StepColumn, TickColumn, type RecordedInstance, type Recording, type Scale } from "./recording";
import { moves, poseAt } from "./screw";
import { indexAt, type Track } from "./track";

/** A black box has no scene; its finger is shown as it was at the hand. */
const kAtHand: Scale = { from_s: 0, radius_m: 0, worldPerDevice: 1 };

export interface RecordedMoment {
  /** Number of the scene; -1: there is none. */
  readonly scene: number;
  readonly scale: Scale;
  readonly state: State;
  readonly moves: Moves;
  readonly contacts: number;
  readonly force_N: number;
  readonly penetration_m: number;
}

export function momentOf(recording: Recording, time_s: number): RecordedMoment {
  const { steps, ticks } = recording;
  const [step, tick] = [indexAt(steps, time_s), indexAt(ticks, time_s)];
  const at = (track: Track, column: number, index: number) => track.columns[column]![index]!;
  const vec = (track: Track, x: number, index: number): Vec =>
    ({ x: at(track, x, index), y: at(track, x + 1, index), z: at(track, x + 2, index) });
  const scene = tick < 0 ? -1 : at(ticks, TickColumn.kScene, tick);
  const places = tick < 0
    ? { finger: vec(steps, StepColumn.kFingerX, step) }
    : { finger: vec(ticks, TickColumn.kFingerX, tick), proxy: vec(ticks, TickColumn.kProxyX, tick) };
  return {
    scene,
    scale: scaleAt(recording.scales, time_s),
    state: create(StateSchema, {
      timeS: time_s, ...places, layout: scene + 2, forceN: vec(steps, StepColumn.kForceX, step),
      safety: at(steps, StepColumn.kSafety, step) as SafetyState,
      ...stylusAt(steps, step),
    }),
    moves: movesAt(recording, scene, time_s),
    contacts: tick < 0 ? 0 : at(ticks, TickColumn.kContacts, tick),
    force_N: at(steps, StepColumn.kForce_N, step),
    penetration_m: at(steps, StepColumn.kPenetration_m, step),
  };
}

/** None, where the device had no wrist. */
function stylusAt({ columns }: Track, step: number) {
  const [x, y, z, w] = [0, 1, 2, 3].map((i) => columns[StepColumn.kTurnedX + i]![step]!) as
    [number, number, number, number];
  const gripperRad = columns[StepColumn.kGripper_rad]![step]!;
  return x === 0 && y === 0 && z === 0 && w === 0 ? {} : { stylus: { rotation: { x, y, z, w }, gripperRad } };
}

function scaleAt(scales: readonly Scale[], time_s: number): Scale {
  return [...scales].reverse().find(({ from_s }) => from_s <= time_s) ?? scales[0] ?? kAtHand;
}

function movesAt(recording: Recording, scene: number, time_s: number): Moves {
  const moving = (recording.scenes[scene]?.instances ?? []).flatMap((instance, i) =>
    (instance.body >= 0 || instance.ways.some(moves) ? [{ instance, i }] : []));
  return {
    layout: scene + 2,
    indices: moving.map(({ i }) => i),
    poses: Float32Array.from(moving.flatMap(({ instance }) => placeOf(recording, instance, time_s))),
  };
}

function placeOf({ bodies }: Recording, { body, ways }: RecordedInstance, time_s: number): number[] {
  const track = bodies[body];
  return track === undefined ? poseAt(ways, time_s) : trackedPose(track, time_s);
}

/** Number `number` of the scenes, where everything is at `time_s`; -1: nothing is there. */
export function layoutOf(recording: Recording, number: number, scale: Scale, time_s: number): Layout {
  const instances = recording.scenes[number]?.instances ?? [];
  const poses = Float32Array.from(instances.flatMap((instance) => placeOf(recording, instance, time_s)));
  const meshes = new Map(recording.meshes.map((mesh) => [mesh.number, mesh]));
  return {
    number: number + 2,
    name: recording.scenes[number]?.name || (recording.blackBox ? "black box" : "recording"),
    bounds: boundsOf(instances.map(({ mesh }) => meshes.get(mesh)), poses),
    proxyRadius_m: scale.radius_m,
    worldPerDevice: scale.worldPerDevice,
    placed: instances.map(({ mesh, session, object, name, materials, label, colour }) =>
      create(PlacedMeshSchema, { mesh, session, object, name, materials: [...materials], label, colour })),
    poses,
  };
}

function boundsOf(meshes: readonly (Mesh | undefined)[], poses: Float32Array): Bounds | undefined {
  const corners = meshes.flatMap((mesh, i) => {
    const pose = poses.subarray(kPoseNumbers * i, kPoseNumbers * (i + 1));
    return mesh?.bounds === undefined ? [] : cornersOf(mesh.bounds).map((corner) => placedAt(pose, corner));
  });
  if (corners.length === 0) {
    return undefined;
  }
  const extreme = (pick: (...values: number[]) => number): Vec => ({
    x: corners.reduce((best, { x }) => pick(best, x), corners[0]!.x),
    y: corners.reduce((best, { y }) => pick(best, y), corners[0]!.y),
    z: corners.reduce((best, { z }) => pick(best, z), corners[0]!.z),
  });
  return { min: extreme(Math.min), max: extreme(Math.max) };
}

function cornersOf({ min, max }: Bounds): Vec[] {
  return [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => ({ x, y, z }))));
}

function placedAt(pose: Float32Array, { x, y, z }: Vec): Vec {
  const row = (i: number) => pose[i]! * x + pose[i + 1]! * y + pose[i + 2]! * z + pose[i + 3]!;
  return { x: row(0), y: row(4), z: row(8) };
}
