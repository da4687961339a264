// A height field of a recording as the page draws it.
import { describe, expect, test } from "vitest";
import { HeightParts } from "../src/timeline/recorded_heights";

const bytesOf = (values: readonly number[]) => new Uint8Array(Int16Array.from(values).buffer);
const kUpright = { axes: [2, 0, 0, 0, 0, 3, 0, 0.5, 0], origin: [-2, 0, -3], kind: 0, missing: -9 };
const kNothing = { columns: 0, rows: 0, kind: 0, missing: undefined, axes: [], origin: [] };

describe("a height field of a recording", () => {
  test("has two triangles a cell, and a hole around what is missing", () => {
    const parts = new HeightParts();
    const samples = bytesOf([1, 2, 3, 4, 5, 6, 7, 8, -9]);
    expect(parts.add(7, { ...kUpright, columns: 3, rows: 3, samples: samples.subarray(0, 5), continues: true }))
      .toBeUndefined();
    const mesh = parts.add(7, { ...kNothing, samples: samples.subarray(5), continues: false })!;
    expect(mesh.number).toBe(7);
    expect([...mesh.triangles]).toEqual([0, 4, 1, 0, 3, 4, 1, 5, 2, 1, 4, 5, 3, 7, 4, 3, 6, 7]);
    expect([...mesh.positions.subarray(12, 15)]).toEqual([0, 2.5, 0]);
    expect(mesh.bounds).toEqual({ min: { x: -2, y: 0.5, z: -3 }, max: { x: 2, y: 4, z: 3 } });
  });

  test("is drawn with fewer triangles where it has very many, up to its rim", () => {
    const side = 1501;
    const samples = new Uint8Array(2 * side * side);
    const mesh = new HeightParts().add(1, { ...kUpright, columns: side, rows: side, samples, continues: false })!;
    expect(mesh.triangles.length / 3).toBeLessThanOrEqual(1_000_000);
    expect(mesh.bounds!.max).toEqual({ x: 2 * (side - 1) - 2, y: 0, z: 3 * (side - 1) - 3 });
  });

  test("that does not agree with itself is refused", () => {
    for (const wrong of [{ columns: 1 }, { kind: 3 }, { axes: [1] }, { rows: 4 }]) {
      const part = { ...kUpright, columns: 3, rows: 3, samples: new Uint8Array(18), continues: false, ...wrong };
      expect(() => new HeightParts().add(1, part)).toThrow("does not agree with itself");
    }
  });
});
