// Coming back to the server: immediately at first, never rarer than every two seconds.
import { expect, test } from "vitest";
import { kFirstDelay_ms, kGiveUp_ms, kLongestDelay_ms, kSilent_ms, liveness, ReconnectPolicy } from "../src/reconnect";

test("delays grow from a quarter of a second and stay at two seconds", () => {
  const policy = new ReconnectPolicy();
  const delays = Array.from({ length: 40 }, () => policy.nextDelay());
  expect(delays.slice(0, 5)).toEqual([250, 500, 1000, 2000, 2000]);
  expect(Math.max(...delays)).toBe(kLongestDelay_ms);
  expect(kLongestDelay_ms).toBeLessThanOrEqual(2000);
});

test("data starts the delays anew", () => {
  const policy = new ReconnectPolicy();
  policy.nextDelay();
  policy.nextDelay();
  policy.succeeded();
  expect(policy.nextDelay()).toBe(kFirstDelay_ms);
});

test("a quiet connection is first silent, then gone", () => {
  expect(liveness(0)).toBe("live");
  expect(liveness(kSilent_ms - 1)).toBe("live");
  expect(liveness(kSilent_ms)).toBe("silent");
  expect(liveness(kGiveUp_ms)).toBe("gone");
});
