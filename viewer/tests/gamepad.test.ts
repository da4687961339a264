import { expect, test } from "vitest";
import { padState, type Pad } from "../src/gamepad";

function pad(axes: number[], pressed: number[] = [], id = "Usual Gamepad"): Pad {
  const buttons = Array.from({ length: 12 }, (_, i) => ({ pressed: pressed.includes(i) }));
  return { id, connected: true, axes, buttons };
}

const kNowhere = { x: 0, y: 0, z: 0 };

test("without a gamepad nothing moves", () => {
  expect(padState([null, null])).toEqual({ direction: kNowhere, buttons: 0 });
  expect(padState([{ ...pad([1, 1, 1, 1]), connected: false }])).toEqual({ direction: kNowhere, buttons: 0 });
});

test("left stick in the plane, right stick in depth, small deflections not at all", () => {
  expect(padState([null, pad([1, 0, 0, 0])]).direction).toEqual({ x: 1, y: 0, z: 0 });
  expect(padState([pad([0, -1, 0, 0])]).direction).toEqual({ x: 0, y: 1, z: 0 });
  expect(padState([pad([0, 0, 0, -1])]).direction).toEqual({ x: 0, y: 0, z: 1 });
  expect(padState([pad([0.1, -0.14, 1, 0.1])]).direction).toEqual(kNowhere);
  expect(padState([pad([0.575, 0, 0, 0])]).direction.x).toBeCloseTo(0.5, 12);
});

test("a SpaceMouse moves as its cap does", () => {
  const spaceMouse = (axes: number[]) => padState([pad(axes, [], "3Dconnexion SpaceMouse Compact")]).direction;
  expect(spaceMouse([0, -1, 0])).toEqual({ x: 0, y: 0, z: 1 });
  expect(spaceMouse([0, 0, -1])).toEqual({ x: 0, y: 1, z: 0 });
});

test("the first four buttons are the device's", () => {
  expect(padState([pad([0, 0, 0, 0], [0, 2, 7])]).buttons).toBe(0b101);
});
