// What is shown of a scene on its way.
import { expect, test } from "vitest";
import { Receiving } from "../src/receiving";

test("a scene that takes long is reported, with what of it has come, until it is there", () => {
  const receiving = new Receiving();
  expect(receiving.line({ triangles: 0, points: 0 }, 1000)).toBeUndefined();
  expect(receiving.line({ triangles: 0, points: 0 }, 1400)).toBe("Receiving the scene…");
  expect(receiving.line({ triangles: 1200, points: 0 }, 1500)).toBe("Receiving the scene… 1\u202f200\u00a0triangles so far");
  expect(receiving.line(undefined, 1600)).toBeUndefined();
  expect(receiving.line({ triangles: 1, points: 0 }, 1700)).toBeUndefined();
  expect(receiving.line({ triangles: 1, points: 0 }, 2100)).toBe("Receiving the scene… 1\u00a0triangle so far");
  expect(receiving.line({ triangles: 1, points: 5000 }, 2200)).toBe(
    "Receiving the scene… 1\u00a0triangle, 5\u202f000\u00a0points so far");
});
