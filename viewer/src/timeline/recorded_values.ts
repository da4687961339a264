// The numbers of HL's structures in a recording: lists in the order of their declarations (src/base/fields.h). A list
// of another length was written by another version.

import type { Values } from "../gen/recording_pb";
import type { SurfaceSettings } from "../surfaces";
import type { Vec } from "../vec";
import { RecordingError } from "./recording_blocks";

/** As in base/quantities.def. */
const kQuantities = [
  "stiffness", "staticFriction", "dynamicFriction", "viscosityNsM", "stribeckMS", "preslidingNM", "adhesionN",
  "complianceMN", "strengthN",
] as const;

/** Of them, those that were added since recordings are read that lack some of the last. */
const kLaterQuantities = 2;

/** How many of them a list has, which may have been made before the last were added. */
function quantitiesIn(count: number): number {
  const earlier = count < kQuantities.length && count >= kQuantities.length - kLaterQuantities;
  return earlier ? count : kQuantities.length;
}

function requireForm(values: Values | undefined, numbers: number, integers: number, what: string): Values {
  if (values === undefined || values.numbers.length !== numbers || values.integers.length !== integers) {
    throw new RecordingError(`has ${what} of another version of HL: use the one that made it`);
  }
  return values;
}

type Triple = [number, number, number];

/** What ticks are given (TickContext of src/record/recorded_ticks.h). */
export interface TickContext {
  readonly origin: Vec;
  readonly worldPerDevice: number;
  readonly radius_m: number;
  /** Identity of the scene. */
  readonly scene: bigint;
}

export function tickContext(values: Values | undefined): TickContext {
  // Numbers: the quantities, the workspace's origin and scale, the radius, the spring's stiffness and period. Integers:
  // a flag for each quantity, two for shading, one for textures, restarts, ledger, pulls, scene.
  const quantities = quantitiesIn((values?.numbers.length ?? 0) - 7);
  const { numbers, integers } = requireForm(values, quantities + 7, quantities + 7, "ticks");
  const [x, y, z, worldPerDevice, radius_m] = numbers.slice(quantities) as [...Triple, number, number];
  if (![x, y, z].every(Number.isFinite) || !(worldPerDevice > 0) || !(radius_m > 0)) {
    throw new RecordingError("makes no sense: its workspace or radius is no number");
  }
  return { origin: { x, y, z }, worldPerDevice, radius_m, scene: BigInt.asUintN(64, integers.at(-1)!) };
}

/** A rotation by columns, and an origin. */
export type Pose = readonly number[];
const kPose = 12;

/** From one pose to another. Seconds of the recording. */
export interface Way {
  readonly from: Pose;
  readonly to: Pose;
  readonly begin_s: number;
  readonly end_s: number;
}

/** Two ways in succession. `seconds` turns a recorded time into one of the recording. */
export function waysOf(values: Values | undefined, seconds: (time_ns: bigint) => number): readonly [Way, Way] {
  const { numbers, integers } = requireForm(values, 4 * kPose, 4, "a motion");
  if (!numbers.every(Number.isFinite)) {
    throw new RecordingError("makes no sense: a pose in it is no number");
  }
  const way = (i: number): Way => ({
    from: numbers.slice(2 * kPose * i, 2 * kPose * i + kPose),
    to: numbers.slice(2 * kPose * i + kPose, 2 * kPose * (i + 1)),
    begin_s: seconds(integers[2 * i]!),
    end_s: seconds(integers[2 * i + 1]!),
  });
  return [way(0), way(1)];
}

/** A material, without what a texture modulates. */
export function materialOf(values: Values): SurfaceSettings {
  // Numbers: the quantities, low and high of each texture and of the bump map. Integers: smooth, the number of each.
  const quantities = quantitiesIn((values.numbers.length - 2) / 3);
  const textures = quantities + 1;
  const count = quantities + 2 * textures;
  const { numbers, integers } = requireForm(values, count, 1 + textures, "a material");
  const kNoTexture = 0xffffffffn;
  const known = kQuantities.slice(0, quantities).map((field, i) =>
    [field, integers[1 + i] === kNoTexture ? numbers[i] : undefined] as const);
  return { ...Object.fromEntries(known.filter(([, value]) => value !== undefined)), smooth: integers[0] !== 0n };
}
