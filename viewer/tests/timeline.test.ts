// The parts of the timeline: tracks, screws, its clock, and the live scene that waits.
import { create } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { HelloSchema } from "../src/gen/hl_pb";
import type { Layout, Mesh } from "../src/scene_messages";
import { SceneStore } from "../src/scene_store";
import { Playback } from "../src/timeline/playback";
import { SceneHold } from "../src/timeline/scene_hold";
import { poseAt } from "../src/timeline/screw";
import { envelope, indexAt, TrackBuilder } from "../src/timeline/track";

describe("a track", () => {
  const built = (most: number, values: number[]) => {
    const builder = new TrackBuilder(2, most);
    values.forEach((value, i) => builder.add(i, value, -value));
    return builder.track();
  };

  test("finds the sample at a time", () => {
    const track = built(100, [5, 6, 7]);
    expect([-1, 0, 0.9, 1, 2, 9].map((time_s) => indexAt(track, time_s))).toEqual([0, 0, 0, 1, 2, 2]);
    expect(indexAt(built(100, []), 1)).toBe(-1);
  });

  test("leaves out times that do not rise", () => {
    const builder = new TrackBuilder(1, 10);
    [0, 1, 1, 0.5, NaN, 2].forEach((time_s) => builder.add(time_s, 1));
    expect([...builder.track().times]).toEqual([0, 1, 2]);
  });

  test("stays within its size, and keeps the peaks", () => {
    const values = Array.from({ length: 10_000 }, (_, i) => (i === 7777 ? 9 : i % 3));
    const { times, columns } = built(64, values);
    expect(times.length).toBeLessThanOrEqual(64);
    expect(times.length).toBeGreaterThan(20);
    expect([...times].every((time_s, i) => i === 0 || time_s > times[i - 1]!)).toBe(true);
    expect(Math.max(...columns[0]!)).toBe(9);
    expect(columns[1]![columns[0]!.indexOf(9)]).toBe(-9);
  });

  test("is drawn with its extremes", () => {
    const values = Array.from({ length: 1000 }, (_, i) => (i === 500 ? 7 : i === 501 ? -7 : 0));
    const [times, shown] = envelope(built(2000, values), 0, 10);
    expect(times).toHaveLength(20);
    expect([Math.min(...shown), Math.max(...shown)]).toEqual([-7, 7]);
    expect(envelope(built(100, [1, 2]), 0, 10)[1]).toEqual(Float64Array.of(1, 2));
  });
});

describe("a screw", () => {
  const kRest = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
  const way = (from: number[], to: number[], begin_s: number, end_s: number) => ({ from, to, begin_s, end_s });
  const still = way(kRest, kRest, 0, 0);

  test("turns about its axis, and slides along it", () => {
    // A quarter of a circle about the axis through (1, 0, 0) along z, and 2 along it: the origin goes to (1, -1, 2).
    const to = [0, 1, 0, -1, 0, 0, 0, 0, 1, 1, -1, 2];
    const pose = poseAt([still, way(kRest, to, 1, 2)], 1.5);
    const half = Math.SQRT1_2;
    const expected = [half, -half, 0, 1 - half, half, half, 0, -half, 0, 0, 1, 1];
    pose.forEach((value, i) => expect(value).toBeCloseTo(expected[i]!, 12));
  });

  test("is exactly at its ends before and after, and half a circle is a way too", () => {
    const to = [-1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, 3];
    const ways = [still, way(kRest, to, 1, 2)] as const;
    expect(poseAt(ways, 0)).toEqual([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
    expect(poseAt(ways, 2)).toEqual([-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 3]);
    const between = poseAt(ways, 1.5);
    expect([between[0], Math.abs(between[1]!), between[11]]).toEqual(
      [expect.closeTo(0, 12), expect.closeTo(1, 12), expect.closeTo(1.5, 12)]);
  });
});

describe("the clock", () => {
  test("plays at its speed to the end, and then anew", () => {
    const playback = new Playback(0, 2);
    playback.advance(0);
    expect(playback.time_s).toBe(0);
    playback.toggle(1000);
    playback.advance(1500);
    expect(playback.time_s).toBeCloseTo(0.5);
    playback.setSpeed(0.25);
    playback.advance(2500);
    expect(playback.time_s).toBeCloseTo(0.75);
    playback.setSpeed(1);
    playback.advance(9000);
    expect([playback.time_s, playback.playing]).toEqual([2, false]);
    playback.toggle(9100);
    playback.advance(9200);
    expect(playback.time_s).toBeCloseTo(0.1);
  });

  test("goes to a time within its length", () => {
    const playback = new Playback(0, 2);
    expect([-1, 1, 9].map((time_s) => (playback.seek(time_s), playback.time_s))).toEqual([0, 1, 2]);
  });
});

describe("the live scene that waits", () => {
  const meshOf = (number: number) => ({ number }) as Mesh;
  const layoutOf = (number: number) => ({ number, placed: [], poses: new Float32Array() }) as unknown as Layout;

  test("is what the server has sent since", () => {
    const store = new SceneStore();
    store.add(meshOf(1));
    store.setLayout(layoutOf(1));
    const hold = new SceneHold(store);
    store.clear();
    hold.take({ kind: "mesh", mesh: meshOf(2) });
    hold.take({ kind: "layout", layout: layoutOf(2) });
    hold.take({ kind: "forget", meshes: [1] });
    expect(hold.messages()).toEqual([{ kind: "mesh", mesh: meshOf(2) }, { kind: "layout", layout: layoutOf(2) }]);
  });

  test("of a server that has just come is that server's", () => {
    const store = new SceneStore();
    store.add(meshOf(1));
    const hold = new SceneHold(store);
    const hello = create(HelloSchema, { sceneName: "b" });
    hold.take({ kind: "hello", hello });
    hold.take({ kind: "mesh", mesh: meshOf(7) });
    expect(hold.messages()).toEqual([{ kind: "hello", hello }, { kind: "mesh", mesh: meshOf(7) }]);
  });

  test("begins where its recording does, and from the end anew there", () => {
    const playback = new Playback(3600, 3602);
    expect([playback.time_s, playback.length_s]).toEqual([3600, 2]);
    playback.seek(0);
    expect(playback.time_s).toBe(3600);
    playback.seek(9999);
    playback.toggle(0);
    expect(playback.time_s).toBe(3600);
  });
});
