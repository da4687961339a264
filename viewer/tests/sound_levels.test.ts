import { expect, test } from "vitest";
import { deviation, levelsOf, type Felt } from "../src/sound_levels";

const kStill: Felt = { force_N: 0, limit_N: 8.5, ripple_N: 0, speed_m_s: 0, slipping: false };

test("nothing touched is silent, whatever the hand does in the air", () => {
  expect(levelsOf({ ...kStill, speed_m_s: 0.3 })).toMatchObject({ tone: 0, noise: 0 });
});

test("the tone grows and rises with the force, and not beyond the device's limit", () => {
  const [soft, hard, over] = [1, 8.5, 100].map((force_N) => levelsOf({ ...kStill, force_N }));
  expect(hard!.tone).toBeGreaterThan(soft!.tone);
  expect(hard!.pitch_Hz).toBeCloseTo(440, 9);
  expect(over).toEqual(hard);
  expect(levelsOf({ ...kStill, force_N: NaN }).tone).toBe(0);
});

test("a texture is heard while the hand moves, a slip a little too", () => {
  const moving: Felt = { ...kStill, force_N: 1, speed_m_s: 0.1 };
  const [smooth, slip, rough] = [moving, { ...moving, slipping: true }, { ...moving, ripple_N: 0.5 }].map(levelsOf);
  expect(smooth!.noise).toBe(0);
  expect(slip!.noise).toBeGreaterThan(0);
  expect(rough!.noise).toBeGreaterThan(slip!.noise);
  expect(levelsOf({ ...moving, ripple_N: 0.5, speed_m_s: 0 }).noise).toBe(0);
});

test("the deviation of a constant is zero, and of nothing too", () => {
  expect(deviation([2, 2, 2])).toBe(0);
  expect(deviation([])).toBe(0);
  expect(deviation([1, 3])).toBe(1);
});
