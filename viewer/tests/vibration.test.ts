import { expect, test } from "vitest";
import { softenedWords, swingOf, VibrationAlarm } from "../src/vibration";

/** One window of samples at 1 kHz from `from_s` on. */
function window(force: (time_s: number) => number, from_s = 0): [number[], number[]] {
  const times = Array.from({ length: 300 }, (_, i) => from_s + i / 1000);
  return [times, times.map(force)];
}

function sine(rate_Hz: number, force_N: number): (time_s: number) => number {
  return (time_s) => 2 + force_N * Math.sin(2 * Math.PI * rate_Hz * time_s);
}

test("gives swing and rate of a vibration", () => {
  const swing = swingOf(...window(sine(60, 1.5)));
  expect(swing.force_N).toBeCloseTo(3, 1);
  expect(swing.rate_Hz).toBeGreaterThan(55);
  expect(swing.rate_Hz).toBeLessThan(62);
});

test("a slow push, a bump, noise of the encoders and nothing at all are no vibration", () => {
  const alarm = new VibrationAlarm();
  expect(alarm.judge(...window(sine(3, 4)))).toBeUndefined();
  expect(alarm.judge(...window((t) => (t > 0.1 && t < 0.15 ? 5 : 0)))).toBeUndefined();
  expect(alarm.judge(...window((t) => 1 + (Math.round(t * 1000) % 2 ? 0.05 : -0.05)))).toBeUndefined();
  expect(alarm.judge([], [])).toBeUndefined();
});

test("is reported for a second after it has ceased", () => {
  const alarm = new VibrationAlarm();
  expect(alarm.judge(...window(sine(80, 3)))).toBeDefined();
  expect(alarm.judge(...window(() => 1, 0.5))).toBeDefined();
  expect(alarm.judge(...window(() => 1, 2))).toBeUndefined();
});

test("what was softened names the limit, and what brings it back", () => {
  expect(softenedWords(409.6)).toBe("The spring shook with the hand: it is held below 410\u202fN/m. " +
    "Lift off: where nothing is touched it comes back, a tenth each second.");
});
