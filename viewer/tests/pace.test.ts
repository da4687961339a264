// A drag of a slider in few messages: the first immediately, the last one always.
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { paced } from "../src/pace";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

test("acts immediately, then once per period, and never loses the last call", () => {
  const act = vi.fn();
  const call = paced(act, 30);
  call();
  expect(act).toHaveBeenCalledTimes(1);
  for (let ms = 0; ms < 100; ms += 1) {
    call();
    vi.advanceTimersByTime(1);
  }
  expect(act).toHaveBeenCalledTimes(4);
  vi.advanceTimersByTime(30);
  expect(act).toHaveBeenCalledTimes(5);
  vi.advanceTimersByTime(1000);
  expect(act).toHaveBeenCalledTimes(5);
});

test("after a rest the next call acts immediately again", () => {
  const act = vi.fn();
  const call = paced(act, 30);
  call();
  vi.advanceTimersByTime(31);
  call();
  expect(act).toHaveBeenCalledTimes(2);
});
