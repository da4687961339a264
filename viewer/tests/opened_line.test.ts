// The line that tells what is open now.
import { expect, test } from "vitest";
import { openedLine } from "../src/opened_line";

test("has sentences, and one triangle is no triangles", () => {
  expect(openedLine("a.obj", { triangles: 1, world_per_device: 2, warnings: ["skipped 8 of them"] })).toBe(
    "a.obj: 1 triangle; 1\u202fmm of the hand is 2.00\u202fmm of the scene. Skipped 8 of them.");
  expect(openedLine("a.obj", { triangles: 1200, world_per_device: 2, warnings: [] })).toContain("triangles;");
});
