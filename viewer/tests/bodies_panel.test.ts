import { describe, expect, it } from "vitest";
import { SlowMotion } from "../src/bodies_panel";

describe("slow motion", () => {
  it("is reported where the bodies' time is behind by more than a fiftieth", () => {
    const slow = new SlowMotion();
    for (let time_s = 0; time_s < 3; time_s += 0.1) {
      expect(slow.judge(time_s, 0.01 * time_s)).toBeUndefined();
    }
    for (let time_s = 3; time_s < 6; time_s += 0.1) {
      slow.judge(time_s, 0.03 + 0.5 * (time_s - 3));
    }
    expect(slow.judge(6, 1.53)).toBeCloseTo(0.5, 6);
  });

  it("is no longer reported a second after ticks are in time again", () => {
    const slow = new SlowMotion();
    slow.judge(0, 0);
    expect(slow.judge(1, 0.5)).toBeCloseTo(0.5, 6);
    expect(slow.judge(2.1, 0.5)).toBeUndefined();
  });

  it("begins anew with another server", () => {
    const slow = new SlowMotion();
    slow.judge(100, 50);
    expect(slow.judge(1, 0)).toBeUndefined();
    expect(slow.judge(2, 0)).toBeUndefined();
  });
});
