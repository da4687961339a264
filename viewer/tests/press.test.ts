// A press against a hand that goes where it is sent: it comes from above, goes as deep as the part allows, and follows.
import { expect, test } from "vitest";
import { kAbove_D, kPress_D, Press, type PressAim, type SurfaceHit } from "../src/press";
import { length, sub, type Vec } from "../src/vec";

const kUp: Vec = { x: 0, y: 0, z: 1 };
const kScale = 10;

function hitAt(x: number, thickness_m = Infinity): SurfaceHit {
  return { point: { x, y: 0, z: 0 }, normal: kUp, thickness_m, object: 0, material: 0 };
}

/** What the hand wants after it has gone to each goal immediately, 20 ms after each other. */
function settle(press: Press, from: Vec, now_ms = 0): Vec {
  let hand = from;
  for (let i = 0; i < 200 && press.coming; ++i) {
    hand = press.goal(hand, now_ms + 20 * i);
  }
  return press.goal(hand, now_ms + 4000);
}

/** Straight to a place whose goals hold the proxy down to `steady_m`. */
const straight = (from: Vec, steady_m = Infinity): PressAim => ({ plan: (to) => [from, to], steady: () => steady_m });

test("comes to a place above the surface first, then goes beneath it along the normal", () => {
  const from = { x: -1, y: 0, z: 0.5 };
  const press = new Press(kScale, hitAt(0), straight(from));
  expect(press.coming).toBe(true);
  expect(press.goal(from, 0).z).toBeGreaterThan(kScale * kAbove_D);
  const end = settle(press, from);
  expect(press.coming).toBe(false);
  expect(length(sub(end, { x: 0, y: 0, z: -kScale * kPress_D }))).toBeLessThan(1e-9);
});

test("goes less deep into what is thin, but never so little that nothing is felt", () => {
  const from = { x: 0, y: 0, z: 1 };
  expect(new Press(kScale, hitAt(0, 0.2), straight(from)).pressed.z).toBeCloseTo(-0.08, 12);
  expect(new Press(kScale, hitAt(0, 1e-4), straight(from)).pressed.z).toBeCloseTo(-0.03, 12);
});

test("slides along, changes its depth within limits, and follows the pointer beside the model", () => {
  const from = { x: 0, y: 0, z: 0.1 };
  const press = new Press(kScale, hitAt(0), straight(from));
  settle(press, from);
  press.slide(hitAt(0.1));
  expect(press.coming).toBe(false);
  expect(press.pressed.x).toBe(0.1);
  press.deepen(-0.1);
  expect(press.pressed.z).toBeCloseTo(-0.02, 12);
  press.deepen(-100);
  expect(press.pressed.z).toBeCloseTo(0.28, 12);
  press.leave({ x: 0.2, y: 0, z: -0.1 });
  expect(press.goal(from, 9000)).toEqual({ x: 0.2, y: 0, z: -0.1 });
  press.slide(hitAt(0.25));
  expect(press.coming).toBe(false);
});

test("goes no deeper than holds the proxy in place, and up again from there at once", () => {
  const from = { x: 0, y: 0, z: 0.1 };
  const press = new Press(kScale, hitAt(0), straight(from, 0.2));
  press.deepen(100);
  expect(press.pressed.z).toBeCloseTo(-0.16, 12);
  press.deepen(-0.01);
  expect(press.pressed.z).toBeCloseTo(-0.15, 12);
  const thin = new Press(kScale, hitAt(0, 0.2), straight(from, 0.05));
  thin.deepen(100);
  expect(thin.pressed.z).toBeCloseTo(-0.08, 12);
});

test("a press that slides on is as deep as the next place holds", () => {
  const from = { x: 0, y: 0, z: 0.1 };
  const steady = ({ point }: SurfaceHit) => (point.x > 0.05 ? 0.2 : Infinity);
  const press = new Press(kScale, hitAt(0), { ...straight(from), steady });
  press.deepen(0.3);
  expect(press.pressed.z).toBeCloseTo(-0.42, 12);
  press.slide(hitAt(0.1));
  expect(press.pressed.z).toBeCloseTo(-0.16, 12);
  press.slide(hitAt(0));
  expect(press.pressed.z).toBeCloseTo(-0.42, 12);
});

test("a drag that jumps to another part comes from above again", () => {
  const from = { x: 0, y: 0, z: 0.1 };
  const press = new Press(kScale, hitAt(0), straight(from));
  settle(press, from);
  press.slide(hitAt(1));
  expect(press.coming).toBe(true);
});

test("a hand that is held on its way goes straight after a second", () => {
  const from = { x: -5, y: 0, z: 1 };
  const press = new Press(kScale, hitAt(0), straight(from));
  for (let now_ms = 0; now_ms <= 960; now_ms += 40) press.goal(from, now_ms);
  expect(press.coming).toBe(true);
  expect(press.goal(from, 1010)).toEqual(press.pressed);
});

test("a page that draws once in two seconds leads the hand along its way all the same", () => {
  const from = { x: -5, y: 0, z: 1 };
  const press = new Press(kScale, hitAt(0), straight(from));
  for (let frame = 0; frame < 10; ++frame) press.goal(from, 2000 * frame);
  expect(press.coming).toBe(true);
  expect(press.goal(from, 20_000).z).toBeGreaterThan(0);
});
