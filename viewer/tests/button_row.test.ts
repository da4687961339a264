// As many lamps as the highest button that was ever pressed.
import { expect, test } from "vitest";
import { lampsFor } from "../src/button_row";

test("a row grows with the highest button and never shrinks", () => {
  expect(lampsFor(0, 0)).toBe(0);
  expect(lampsFor(0, 0b1)).toBe(1);
  expect(lampsFor(1, 0b100)).toBe(3);
  expect(lampsFor(3, 0)).toBe(3);
  expect(lampsFor(0, 0x80000000)).toBe(32);
});
