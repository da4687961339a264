// The line that says what is open now.
import { expect, test } from "vitest";
import { openedLine } from "../src/opened_line";

test("has sentences, and one triangle is no triangles", () => {
  expect(openedLine("a.obj", { triangles: 1, world_per_device: 2, warnings: ["skipped 8 of them"] })).toBe(
    "a.obj: 1 triangle; 1\u202fmm of the hand is 2.00\u202fmm of the scene. Skipped 8 of them.");
  expect(openedLine("a.obj", { triangles: 1200, world_per_device: 2, warnings: [] })).toContain("triangles;");
});

test("where there are no triangles, or more than these, what is felt is counted", () => {
  const line = (triangles: number, primitives: number) =>
    openedLine("a", { triangles, primitives, world_per_device: 1, warnings: [] }).split(";")[0];
  expect(line(0, 170_688)).toBe("a: 170\u202f688 primitives");
  expect(line(0, 1)).toBe("a: 1 primitive");
  expect(line(12, 12)).toBe("a: 12 triangles");
  expect(line(1, 5)).toBe("a: 5 primitives, 1 of them a triangle");
  expect(line(1200, 5000)).toBe("a: 5\u202f000 primitives, 1\u202f200 of them triangles");
});

test("of clouds points are counted", () => {
  const line = (triangles: number, points: number, primitives?: number) =>
    openedLine("a", {
      triangles, points, primitives: primitives ?? triangles + points, world_per_device: 1, warnings: [],
    }).split(";")[0];
  expect(line(0, 170_688)).toBe("a: 170\u202f688\u00a0points");
  expect(line(1, 1)).toBe("a: 1\u00a0triangle, 1\u00a0point");
  expect(line(0, 5, 8)).toBe("a: 5\u00a0points, 3\u00a0other primitives");
});

test("counts of lines and bare vertices agree with what is felt", () => {
  const of = (counts: { triangles: number; segments: number; points: number; primitives: number }) =>
    openedLine("a", { ...counts, world_per_device: 1, warnings: [] }).split(";")[0];
  expect(of({ triangles: 0, segments: 0, points: 1, primitives: 1 })).toBe("a: 1\u00a0point");
  expect(of({ triangles: 2, segments: 3, points: 0, primitives: 5 })).toBe("a: 2\u00a0triangles, 3\u00a0segments");
});
