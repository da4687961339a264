import { expect, test } from "vitest";
import { csvOf } from "../src/csv";
import { fileName } from "../src/save";

test("a table has a head line, a row for each sample, and empty cells for what is not known", () => {
  expect(csvOf({ time_s: [0, 0.001], force_N: [1.5, NaN] })).toBe("time_s,force_N\r\n0,1.5\r\n0.001,\r\n");
  expect(csvOf({ time_s: [] })).toBe("time_s\r\n");
});

test("files are named by the scene and the time, without anything that a file system refuses", () => {
  const time = new Date(Date.UTC(2026, 10, 25, 14, 5, 9));
  expect(fileName("../my scene:1.obj", time, "csv")).toBe("my-scene-1.obj-2026-11-25-14-05-09.csv");
  expect(fileName("–", time, "png")).toBe("hl-2026-11-25-14-05-09.png");
});
