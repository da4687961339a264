// A recording file as the page shows it, and what is refused.
import { describe, expect, test } from "vitest";
import {
  blockBytes, fileOf, kContext, kEnd, kMagic, kBegin_ns, kIdentity, kScene, kShape, kStart, kSurfaces, kWhole, steps, ticks, type BlockBody,
} from "../test-support/recording_bytes";
import { layoutOf, momentOf } from "../src/timeline/recorded_moment";
import { readRecording } from "../src/timeline/recording_reader";

const read = (file: Blob) => readRecording(file, () => {});
const blobOf = (...parts: Buffer[]) => new Blob(parts as BlobPart[]);

describe("a recording", () => {
  test("says how long it is, of which device, and why it ends", async () => {
    const shares: number[] = [];
    const recording = await readRecording(fileOf(...kWhole), (share) => shares.push(share));
    expect(recording).toMatchObject({ device: "a device", end: "stopped", servoRate_Hz: 10, blackBox: false });
    expect(recording.begin_s).toBe(0);
    expect(recording.end_s).toBeCloseTo(3, 9);
    expect(shares.at(-1)).toBe(1);
    expect(shares.every((share, i) => i === 0 || share >= shares[i - 1]!)).toBe(true);
  });

  test("has the times of hl replay's table: from its begin on, whatever it holds first", async () => {
    const value = { ...(kStart.value as object), beginNs: kBegin_ns - 250_000_000n };
    const later: BlockBody = { case: "start", value };
    const early = ticks(31);
    (early.value as { timeNs: bigint[] }).timeNs[0] = kBegin_ns - 270_000_000n; // a tick of before the begin
    const recording = await read(fileOf(later, kShape, kSurfaces, kScene, early, steps(31), kEnd));
    expect(recording.begin_s).toBeCloseTo(0.25, 9);
    expect(recording.end_s).toBeCloseTo(3.25, 9);
    expect(recording.ticks.times[0]).toBeCloseTo(-0.02, 9);
    expect(recording.steps.times[7]).toBeCloseTo(0.95, 9);
    expect(momentOf(recording, 0.96).force_N).toBeCloseTo(0.7, 5);
    // The object of the scene moves between 1 s and 2 s after kBegin_ns.
    expect(momentOf(recording, 1.75).moves.poses[3]).toBeCloseTo(0.5, 6);
  });

  test("has finger, proxy, force and safety state at each time", async () => {
    const recording = await read(fileOf(...kWhole));
    const moment = momentOf(recording, 2.05);
    expect(moment.state.finger!.x).toBeCloseTo(3, 5);
    expect(moment.state.proxy).toMatchObject({ x: expect.closeTo(3, 5), y: expect.closeTo(0.1, 5) });
    expect(moment.state.forceN!.y).toBeCloseTo(2, 5);
    expect(moment.penetration_m).toBeCloseTo(0.01, 6);
    const scale = { radius_m: 0.02, worldPerDevice: 10 };
    expect(moment).toMatchObject({ scene: 0, contacts: 1, scale, state: { safety: 2 } });
  });

  test("has its scene, with materials and names, and where its objects were", async () => {
    const recording = await read(fileOf(...kWhole));
    const { scene, scale, moves } = momentOf(recording, 1.5);
    expect(moves.indices).toEqual([0]);
    expect(moves.poses[3]).toBeCloseTo(0.5, 6);
    const layout = layoutOf(recording, scene, scale, 3);
    expect(layout.name).toBe("a scene");
    expect(layout.bounds).toEqual({ min: { x: 1, y: 0, z: 0 }, max: { x: 2, y: 2, z: 0 } });
    expect(layout.placed[0]).toMatchObject({
      session: 1, object: 2, name: 3, materials: [{ stiffness: 0.5, staticFriction: 0.4, adhesionN: 2, smooth: true }],
      label: "bolt", colour: Uint8Array.of(1, 2, 250),
    });
  });

  test("of a black box has the steps without a scene", async () => {
    const value = { ...(kStart.value as object), blackBox: true, fault: "it was too fast" };
    const start: BlockBody = { case: "start", value };
    const recording = await read(fileOf(start, steps(5)));
    expect(recording).toMatchObject({ blackBox: true, fault: "it was too fast", end: "the program was killed" });
    const moment = momentOf(recording, 0.31);
    expect(moment.scene).toBe(-1);
    expect(moment.state.finger!.x).toBeCloseTo(0.03, 6);
    const layout = layoutOf(recording, -1, moment.scale, 0);
    expect(layout).toMatchObject({ name: "black box", placed: [], bounds: undefined });
  });

  test("that is cut or damaged is shown as far as it is good", async () => {
    const whole = [kMagic, ...kWhole.slice(0, -1).map(blockBytes)];
    const end = blockBytes(kEnd);
    const cut = await read(blobOf(...whole, end.subarray(0, end.length - 1)));
    expect(cut.end).toBe(`its last ${end.length - 1} bytes are cut short or damaged`);
    const damaged = Buffer.from(end);
    damaged[damaged.length - 1]! ^= 1;
    expect((await read(blobOf(...whole, damaged))).end).toBe(`its last ${end.length} bytes are cut short or damaged`);
    expect(cut.end_s).toBeCloseTo(3, 9);
  });

  test("has its bodies where they were, on a screw from pose to pose", async () => {
    const turned = [0, 1, 0, -1, 0, 0, 0, 0, 1];
    const poses = (time_s: number, ...pose: number[]): BlockBody =>
      ({ case: "poses", value: { timeNs: kBegin_ns + BigInt(1e9 * time_s), bodies: [5n], poses: pose } });
    const { value } = kScene as { value: { instances: object[] } };
    const scene: BlockBody = { case: "scene", value: { ...value, instances: [{ ...value.instances[0], body: 5n }] } };
    const recording = await read(fileOf(
      kStart, kShape, kSurfaces, scene, poses(0.5, ...kIdentity, 1, 0, 0), ticks(30), steps(30),
      poses(1.5, ...turned, 0, 1, 0),
    ));
    const placeAt = (time_s: number) => {
      const { moves, scene: number, scale } = momentOf(recording, time_s);
      expect([...layoutOf(recording, number, scale, time_s).poses]).toEqual([...moves.poses]);
      return [3, 7, 11].map((i) => moves.poses[i]!);
    };
    // A quarter of a turn about the z axis of the world.
    const half = Math.SQRT1_2;
    expect(placeAt(0)).toEqual([1, 0, 0]);
    placeAt(1).forEach((each, i) => expect(each).toBeCloseTo([half, half, 0][i]!, 6));
    placeAt(2.5).forEach((each, i) => expect(each).toBeCloseTo([0, 1, 0][i]!, 6));
  });

  test("with a mesh in parts is put together", async () => {
    const { value } = kShape as { value: object };
    const first: BlockBody = { case: "shape", value: { ...value, triangles: [], continues: true } };
    const last: BlockBody = { case: "shape", value: { id: 1n, triangles: [0, 1, 2], materials: 1 } };
    const { meshes } = await read(fileOf(kStart, first, last, kSurfaces, kScene, ticks(3), steps(3)));
    expect(meshes).toHaveLength(1);
    expect([...meshes[0]!.triangles]).toEqual([0, 1, 2]);
  });

  test("has meshes in the colours and pictures of their files", async () => {
    const square = { id: 1n, materials: 1, positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0], triangles: [0, 1, 2, 1, 3, 2] };
    const of = async (look: object) => {
      const shape: BlockBody = { case: "shape", value: { ...square, ...look } };
      return (await read(fileOf(kStart, shape, kSurfaces, kScene, ticks(3), steps(3)))).meshes[0]!;
    };
    const paints = [{ colour: 0xff0000 }, { colour: 0x0000ff }];
    const two = await of({ trianglePaints: [0, 1], paints });
    expect(two.positions).toHaveLength(3 * 6);
    [...two.triangles].forEach((v, corner) => {
      expect([...two.colours!.subarray(3 * v, 3 * v + 3)]).toEqual(corner < 3 ? [255, 0, 0] : [0, 0, 255]);
      const before = square.triangles[corner]!;
      expect([...two.positions.subarray(3 * v, 3 * v + 3)]).toEqual(square.positions.slice(3 * before, 3 * before + 3));
    });
    const vertexColours = Uint8Array.of(0, 0, 0, 128, 9, 9, 255, 255, 255, 51, 0, 0);
    const multiplied = await of({ trianglePaints: [0, 0], paints, vertexColours });
    expect([...multiplied.colours!]).toEqual([0, 0, 0, 128, 0, 0, 255, 0, 0, 51, 0, 0]);
    expect([...(await of({ vertexColours })).colours!]).toEqual([...vertexColours]);
    const pictures = [{ file: Uint8Array.of(1) }, { file: Uint8Array.of(2), clamp: true }];
    const white = [{ colour: 0xffffff, picture: 1 }, { colour: 0xffffff }];
    const shown = await of({ trianglePaints: [0, 1], paints: white, pictures, texcoords: [0, 0, 1, 0, 0, 1, 1, 1] });
    expect(shown.looks).toMatchObject([{ image: { clamp: true }, runs: [{ first: 0, count: 1 }] }]);
    expect(shown.colours).toBeUndefined();
    const why = "a mesh in it does not agree with its colours";
    for (const wrong of [
      { trianglePaints: [0], paints }, { trianglePaints: [0, 2], paints }, { vertexColours: Uint8Array.of(1) },
      { trianglePaints: [0, 0], paints: [{ colour: 0, picture: 0 }] }, { texcoords: [0, 0] },
    ]) {
      await expect(of(wrong)).rejects.toThrow(why);
    }
  });
});

describe("refused in one line is", () => {
  const refused = (file: Blob) => expect(read(file)).rejects;

  test("what is no recording", async () => {
    await refused(new Blob([])).toThrow("is no recording of HL");
    await refused(new Blob(["solid cube"])).toThrow("is no recording of HL");
    await refused(new Blob(["HLREC1\r\n"])).toThrow("of form 1, and this page reads form 2");
    await refused(blobOf(kMagic)).toThrow("is empty");
    await refused(blobOf(kMagic, Buffer.alloc(9))).toThrow("is cut short");
    await refused(fileOf(kShape)).toThrow("does not begin as one");
    await refused(fileOf(kStart)).toThrow("holds no steps");
  });

  test("what does not agree with itself", async () => {
    const { value: shape } = kShape as { value: object };
    await refused(fileOf(kStart, { case: "shape", value: { ...shape, triangles: [0, 1, 3] } })).toThrow("a mesh in it");
    await refused(fileOf(kStart, kScene)).toThrow("lacks a mesh");
    await refused(fileOf(kStart, ticks(3), steps(3))).toThrow("lacks a scene");
    const { value: step } = steps(3) as { value: object };
    await refused(fileOf(kStart, { case: "steps", value: { ...step, flags: [0] } })).toThrow("do not agree");
    const poses = (list: number[]): BlockBody => ({ case: "poses", value: { bodies: [1n], poses: list } });
    await refused(fileOf(kStart, poses([1, 2]))).toThrow("the poses of its bodies");
    await refused(fileOf(kStart, poses(Array(12).fill(NaN)))).toThrow("the poses of its bodies");
  });

  test("what another version wrote", async () => {
    const commands = [{ at: 0, values: { ...kContext, numbers: [...kContext.numbers, 1] } }];
    const { value } = ticks(3) as { value: object };
    await refused(fileOf(kStart, { case: "ticks", value: { ...value, commands } })).toThrow("of another version of HL");
  });

  test("a block whose head lies of its size", async () => {
    const block = blockBytes(kStart);
    block.writeUInt32LE(block.readUInt32LE(4) - 1, 4);
    await refused(blobOf(kMagic, block)).toThrow("is cut short");
    block.writeUInt32LE(0x7fffffff, 4);
    await refused(blobOf(kMagic, block)).toThrow("is cut short");
  });
});
