// The ring of samples: bounded, in order, and no spike is lost on the way to the plot.
import { expect, test } from "vitest";
import { SampleRing } from "../src/samples";

function filled(count: number, capacity = count): SampleRing {
  const ring = new SampleRing(capacity, 2);
  for (let i = 0; i < count; ++i) {
    ring.push(i / 1000, i, -i);
  }
  return ring;
}

test("keeps the newest samples when it is full", () => {
  const ring = filled(25, 10);
  expect(ring.size).toBe(10);
  const [times, first, second] = ring.window(1, 100);
  expect(Array.from(first!)).toEqual([15, 16, 17, 18, 19, 20, 21, 22, 23, 24]);
  expect(second![0]).toBe(-15);
  expect(times.at(-1)).toBe(0);
  expect(times[0]).toBeCloseTo(-0.009, 12);
});

test("a window holds only its last seconds", () => {
  const [times] = filled(1000).window(0.1, 1000);
  expect(times[0]).toBeGreaterThanOrEqual(-0.1 - 1e-12);
  expect(times.length).toBeGreaterThanOrEqual(100);
});

test("a time that goes back means a new server: old samples go", () => {
  const ring = filled(100);
  expect(ring.push(0.001, 7, 7)).toBe(true);
  expect(ring.size).toBe(1);
  expect(ring.latestTime).toBe(0.001);
});

test("repeated and non-finite times are refused", () => {
  const ring = filled(3);
  expect(ring.push(0.002, 9, 9)).toBe(false);
  expect(ring.push(NaN, 9, 9)).toBe(false);
  expect(ring.push(Infinity, 9, 9)).toBe(false);
  expect(ring.size).toBe(3);
});

test("a reduced window keeps every extreme and is ordered in time", () => {
  const ring = new SampleRing(20000, 1);
  for (let i = 0; i < 20000; ++i) {
    ring.push(i / 1000, i === 15005 ? 42 : i === 16007 ? -42 : Math.sin(i));
  }
  const [times, values] = ring.window(10, 200);
  expect(times.length).toBeLessThanOrEqual(2 * 202);
  expect(Math.max(...values!)).toBe(42);
  expect(Math.min(...values!)).toBe(-42);
  for (let i = 1; i < times.length; ++i) {
    expect(times[i]!).toBeGreaterThanOrEqual(times[i - 1]!);
  }
});

test("an empty ring gives empty columns, and a maximum of zero", () => {
  const ring = new SampleRing(10, 2);
  expect(ring.window(10, 100).map((column) => column.length)).toEqual([0, 0, 0]);
  expect(ring.maximum(0, 0)).toBe(0);
  expect(ring.latestTime).toBeUndefined();
});

test("maximum looks only at samples since the time given", () => {
  const ring = new SampleRing(100, 1);
  ring.push(1, 50);
  ring.push(2, 3);
  ring.push(3, NaN);
  expect(ring.maximum(0, 0)).toBe(50);
  expect(ring.maximum(0, 1.5)).toBe(3);
});
