// The mouse mapping against a camera written out by hand: the goal stays under the cursor, in the plane of the screen.
import { expect, test } from "vitest";
import { depthOf, metresPerPixel, moveInDepth, moveInView, wheelPixels, type ViewFrame } from "../src/hand_mapping";
import { add, dot, length, scale, sub, type Vec } from "../src/vec";

/** A camera at `eye` turned by `yaw` about y and `pitch` up. */
function camera(eye: Vec, yaw: number, pitch: number): ViewFrame {
  const forward = { x: -Math.sin(yaw) * Math.cos(pitch), y: Math.sin(pitch), z: -Math.cos(yaw) * Math.cos(pitch) };
  const right = { x: Math.cos(yaw), y: 0, z: -Math.sin(yaw) };
  const up = { x: Math.sin(yaw) * Math.sin(pitch), y: Math.cos(pitch), z: Math.cos(yaw) * Math.sin(pitch) };
  return { eye, right, up, forward, fovY_rad: 0.6, height_px: 720 };
}

/** Pinhole projection relative to the middle of the window, pixels, y down. */
function project(view: ViewFrame, point: Vec): { x: number; y: number } {
  const ray = sub(point, view.eye);
  const focal_px = view.height_px / (2 * Math.tan(view.fovY_rad / 2));
  const depth = dot(ray, view.forward);
  return { x: (focal_px * dot(ray, view.right)) / depth, y: (-focal_px * dot(ray, view.up)) / depth };
}

const kView = camera({ x: 0.2, y: 0.1, z: 0.5 }, 0.4, -0.2);
const kGoal: Vec = add(kView.eye, add(scale(kView.forward, 0.45), scale(kView.right, 0.03)));

test("the goal follows the cursor exactly, at constant depth", () => {
  const moved = moveInView(kView, kGoal, 37, -21);
  const [from, to] = [project(kView, kGoal), project(kView, moved)];
  expect(to.x - from.x).toBeCloseTo(37, 9);
  expect(to.y - from.y).toBeCloseTo(-21, 9);
  expect(depthOf(kView, moved)).toBeCloseTo(depthOf(kView, kGoal), 12);
});

test("many small moves end where one large move ends", () => {
  let goal = kGoal;
  for (let i = 0; i < 100; ++i) {
    goal = moveInView(kView, goal, 1, 0.5);
  }
  expect(length(sub(goal, moveInView(kView, kGoal, 100, 50)))).toBeLessThan(1e-12);
});

test("a pixel spans more metres further away, in proportion", () => {
  expect(metresPerPixel(kView, 2)).toBeCloseTo(2 * metresPerPixel(kView, 1), 15);
  expect(metresPerPixel(kView, 1) * kView.height_px).toBeCloseTo(2 * Math.tan(0.3), 12);
});

test("behind the eye, or without a window, nothing moves", () => {
  const behind = sub(kView.eye, kView.forward);
  expect(moveInView(kView, behind, 10, 10)).toEqual(behind);
  expect(metresPerPixel({ ...kView, height_px: 0 }, 1)).toBe(0);
  expect(metresPerPixel(kView, NaN)).toBe(0);
});

test("depth moves along the line of sight and stops before the eye", () => {
  expect(depthOf(kView, moveInDepth(kView, kGoal, 0.1, 0.01))).toBeCloseTo(0.55, 12);
  expect(depthOf(kView, moveInDepth(kView, kGoal, -5, 0.01))).toBeCloseTo(0.01, 12);
  expect(length(sub(moveInDepth(kView, kGoal, 0, 0.01), kGoal))).toBe(0);
});

test("wheel units become pixels", () => {
  expect(wheelPixels(3, 0, 720)).toBe(3);
  expect(wheelPixels(3, 1, 720)).toBe(48);
  expect(wheelPixels(-1, 2, 720)).toBe(-720);
});
