// Poses of recorded bodies: bounded in number, the last one always there.
import { describe, expect, test } from "vitest";
import { BodyTrackBuilder, trackedPose } from "../src/timeline/body_tracks";

const at = (x: number) => [1, 0, 0, 0, 1, 0, 0, 0, 1, x, 0, 0];
const xAt = (builder: BodyTrackBuilder, body: bigint, time_s: number) =>
  trackedPose(builder.tracks((time_ns) => 1e-9 * time_ns).get(body)!, time_s)[3]!;

describe("poses of recorded bodies", () => {
  test("are between those before and after, and rest beyond them", () => {
    const builder = new BodyTrackBuilder();
    builder.add(1n, 1e9, at(0));
    builder.add(1n, 3e9, at(4));
    builder.add(1n, 2e9, at(9));
    expect([0, 1, 1.5, 3, 8].map((time_s) => xAt(builder, 1n, time_s))).toEqual([0, 0, 1, 4, 4]);
  });

  test("are no more than there is room for, with the first and the last one of each body", () => {
    const builder = new BodyTrackBuilder(100);
    builder.add(2n, 0, at(7));
    for (let i = 0; i <= 5000; ++i) {
      builder.add(1n, 1e6 * i, at(i));
    }
    const track = builder.tracks((time_ns) => 1e-9 * time_ns).get(1n)!;
    expect(track.times.length).toBeLessThanOrEqual(100);
    expect(track.times.length).toBeGreaterThan(25);
    expect(xAt(builder, 1n, 0)).toBe(0);
    expect(xAt(builder, 1n, 2.5)).toBeCloseTo(2500, 3);
    expect(xAt(builder, 1n, 5)).toBe(5000);
    expect(xAt(builder, 2n, 5)).toBe(7);
  });
});
