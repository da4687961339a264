// Where the bodies of a recording were: some of their poses, of bounded number. Of a long recording with many bodies
// fewer are kept, and always the last one, where a body came to rest.

import type { Pose, Way } from "./recorded_values";
import { poseAt } from "./screw";
import { indexAt } from "./track";

const kPose = 12;
/** Poses of all bodies together: some 100 MB while a file is read. */
const kMax = 1_000_000;

export interface BodyTrack {
  /** Seconds, rising. */
  readonly times: Float64Array;
  /** For each time a rotation by columns, and an origin. */
  readonly poses: Float32Array;
}

interface Kept {
  times_ns: number[];
  poses: Pose[];
}

export class BodyTrackBuilder {
  private readonly kept_ = new Map<bigint, Kept>();
  private count_ = 0;
  /** Of so many poses of a body that come one is kept. */
  private stride_ = 1;
  private skipped_ = new Map<bigint, number>();

  constructor(private readonly most_ = kMax) {}

  /** Times that do not rise are left out. */
  add(body: bigint, time_ns: number, pose: Pose): void {
    const kept = this.kept_.get(body) ?? { times_ns: [], poses: [] };
    this.kept_.set(body, kept);
    const last = kept.times_ns.length - 1;
    if (last >= 0 && !(time_ns > kept.times_ns[last]!)) {
      return;
    }
    const skipped = (this.skipped_.get(body) ?? this.stride_) + 1;
    if (last > 0 && skipped <= this.stride_) {
      this.skipped_.set(body, skipped);
      kept.times_ns[last] = time_ns;
      kept.poses[last] = pose;
      return;
    }
    this.skipped_.set(body, 1);
    kept.times_ns.push(time_ns);
    kept.poses.push(pose);
    this.count_ += 1;
    if (this.count_ > this.most_) {
      this.halve();
    }
  }

  /** `seconds` turns a recorded time into one of the recording. */
  tracks(seconds: (time_ns: number) => number): Map<bigint, BodyTrack> {
    return new Map([...this.kept_].map(([body, { times_ns, poses }]) =>
      [body, { times: Float64Array.from(times_ns, seconds), poses: Float32Array.from(poses.flat()) }]));
  }

  private halve(): void {
    this.count_ = 0;
    for (const kept of this.kept_.values()) {
      const last = kept.times_ns.length - 1;
      const stays = (_: unknown, i: number) => i % 2 === 0 || i === last;
      kept.times_ns = kept.times_ns.filter(stays);
      kept.poses = kept.poses.filter(stays);
      this.count_ += kept.times_ns.length;
    }
    this.stride_ *= 2;
  }
}

/** A pose of a layout: 3 x 4, row by row. Before the first and after the last one the body rests. */
export function trackedPose(track: BodyTrack, time_s: number): number[] {
  const { times, poses } = track;
  const at = indexAt({ times, columns: [] }, time_s);
  const next = Math.min(at + 1, times.length - 1);
  const pose = (i: number): Pose => Array.from(poses.subarray(kPose * i, kPose * (i + 1)));
  const way: Way = { from: pose(at), to: pose(next), begin_s: times[at]!, end_s: times[next]! };
  return poseAt([way, way], time_s);
}
