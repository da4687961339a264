import { expect, test } from "vitest";
import { edgeMark } from "../src/edge_mark";
import { roundLength } from "../src/scale_bar";

const kView = { left: 100, top: 0, right: 500, bottom: 200 };
const kMargin_px = { x: 20, y: 20 };

test("what is in view needs no arrow", () => {
  expect(edgeMark({ x: 300, y: 100, depth_m: 1 }, kView, kMargin_px)).toBeUndefined();
  expect(edgeMark({ x: 101, y: 1, depth_m: 1 }, kView, kMargin_px)).toBeUndefined();
});

test("the arrow stands on the edge, on the way from the middle", () => {
  const right = edgeMark({ x: 2000, y: 100, depth_m: 1 }, kView, kMargin_px)!;
  expect(right).toEqual({ x: 480, y: 100, angle_rad: 0 });
  const up = edgeMark({ x: 300, y: -500, depth_m: 1 }, kView, kMargin_px)!;
  expect([up.x, up.y]).toEqual([300, 20]);
  expect(up.angle_rad).toBeCloseTo(-Math.PI / 2, 12);
  const corner = edgeMark({ x: 700, y: 300, depth_m: 1 }, kView, { x: 0, y: 0 })!;
  expect([corner.x, corner.y]).toEqual([500, 200]);
});

test("what is behind the eye is the other way, even where its picture is in view", () => {
  expect(edgeMark({ x: 310, y: 100, depth_m: -1 }, kView, kMargin_px)).toMatchObject({ x: 120, y: 100 });
  expect(edgeMark({ x: 300, y: 100, depth_m: -1 }, kView, kMargin_px)).toMatchObject({ x: 300, y: 180 });
});

test("scale bars have round lengths", () => {
  expect(roundLength(0.12)).toBeCloseTo(0.1, 12);
  expect(roundLength(0.0999)).toBeCloseTo(0.05, 12);
  expect(roundLength(49)).toBe(20);
  expect(roundLength(50)).toBe(50);
  expect(roundLength(1e-6)).toBeCloseTo(1e-6, 15);
});
