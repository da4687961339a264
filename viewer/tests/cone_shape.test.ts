// The cone against the law it draws: tangential force over normal force is mu on its side.
import { expect, test } from "vitest";
import { coneShape, forceShares } from "../src/cone_shape";

test("the side has the slope mu and the length asked for", () => {
  for (const mu of [0.1, 0.6, 1.5]) {
    const { height_m, radius_m } = coneShape(mu, 0.02);
    expect(radius_m / height_m).toBeCloseTo(mu, 12);
    expect(Math.hypot(radius_m, height_m)).toBeCloseTo(0.02, 12);
  }
});

test("without friction it is a line along the normal", () => {
  expect(coneShape(0, 0.02)).toEqual({ height_m: 0.02, radius_m: 0 });
});

test("contacts share the force by their multipliers", () => {
  expect(forceShares([{ multiplierM: 1e-3 }, { multiplierM: 3e-3 }])).toEqual([0.25, 0.75]);
  expect(forceShares([])).toEqual([]);
});

test("multipliers that say nothing give equal shares", () => {
  expect(forceShares([{ multiplierM: 0 }, { multiplierM: NaN }])).toEqual([0.5, 0.5]);
  expect(forceShares([{ multiplierM: -1 }, { multiplierM: 2 }])).toEqual([0, 1]);
});
