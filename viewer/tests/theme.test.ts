// The theme: the user's word first, then the system's.
import { expect, test } from "vitest";
import { parseChoice, resolveTheme } from "../src/theme";

test("the system decides only until the user chooses", () => {
  expect(resolveTheme("system", true)).toBe("dark");
  expect(resolveTheme("system", false)).toBe("light");
  expect(resolveTheme("light", true)).toBe("light");
  expect(resolveTheme("dark", false)).toBe("dark");
});

test("an unknown stored choice follows the system", () => {
  expect(parseChoice("dark")).toBe("dark");
  expect(parseChoice("purple")).toBe("system");
  expect(parseChoice(null)).toBe("system");
});
