// Numbers on the page: always a unit, always readable, never "NaN".
import { describe, expect, test } from "vitest";
import {
  formatCount, formatFixed, formatScale, formatShortCount, formatSi, formatTicks, kThinSpace, kUnknown,
} from "../src/units";

const plain = (text: string) => text.replaceAll(kThinSpace, " ");

describe("formatSi", () => {
  test.each([
    [0, "m", "0 m"],
    [1, "N", "1.00 N"],
    [0.00123, "m", "1.23 mm"],
    [-0.00123, "m", "-1.23 mm"],
    [2.31e-6, "s", "2.31 µs"],
    [46.2e-6, "s", "46.2 µs"],
    [1000, "Hz", "1.00 kHz"],
    [123456, "Hz", "123 kHz"],
    [2.5e9, "Hz", "2.50 GHz"],
    [3e-12, "m", "0 m"],
  ])("%f %s -> %s", (value, unit, text) => {
    expect(plain(formatSi(value, unit))).toBe(text);
  });

  test("rounding up changes the prefix instead of showing 1000", () => {
    expect(plain(formatSi(999.96, "Hz"))).toBe("1.00 kHz");
    expect(plain(formatSi(0.00099999, "m"))).toBe("1.00 mm");
  });

  test("four digits show a loop rate to the hertz", () => {
    expect(plain(formatSi(998.6, "Hz", 4))).toBe("998.6 Hz");
    expect(plain(formatSi(1000.4, "Hz", 4))).toBe("1.000 kHz");
  });

  test("what is not known is a dash", () => {
    for (const value of [undefined, NaN, Infinity, -Infinity]) {
      expect(formatSi(value, "N")).toBe(kUnknown);
      expect(formatFixed(value, "N", 2)).toBe(kUnknown);
    }
  });
});

test("formatFixed keeps its decimals", () => {
  expect(plain(formatFixed(3.14159, "N", 2))).toBe("3.14 N");
});

test("formatCount groups thousands, of numbers and of 64-bit counts", () => {
  expect(plain(formatCount(1234567))).toBe("1 234 567");
  expect(plain(formatCount(12345678901234567890n))).toBe("12 345 678 901 234 567 890");
  expect(formatCount(0)).toBe("0");
  expect(formatCount(NaN)).toBe(kUnknown);
});

test("formatShortCount rounds what has more than six digits", () => {
  expect(plain(formatShortCount(999999n))).toBe("999 999");
  expect(plain(formatShortCount(1000000n))).toBe("1.00 M");
  expect(plain(formatShortCount(86_400_000n))).toBe("86.4 M");
  expect(formatShortCount(undefined)).toBe(kUnknown);
});

test("formatScale gives the world's motion per millimetre of the hand", () => {
  expect(plain(formatScale(2.5))).toBe("2.50 mm per mm");
  expect(plain(formatScale(1000))).toBe("1.00 m per mm");
  expect(formatScale(0)).toBe(kUnknown);
});

describe("formatTicks", () => {
  test.each([
    [[0, 0.25, 0.5, 0.75, 1, 1.25], "N", "0, 0.25 N, 0.5 N, 0.75 N, 1 N, 1.25 N"],
    [[0, 0.0005, 0.001], "J", "0, 0.5 mJ, 1 mJ"],
    [[0, 0.1, 0.2, 0.30000000000000004], "J", "0, 100 mJ, 200 mJ, 300 mJ"],
    [[0, 500, 1000], "Hz", "0, 0.5 kHz, 1 kHz"],
    [[0], "N", "0"],
    [[], "N", ""],
  ])("%j %s reads %j", (values, unit, text) => {
    expect(plain(formatTicks(values, unit).join(", "))).toBe(text);
  });
});
