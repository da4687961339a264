// Snaps and fields in a scene file: where they are now.
import { create } from "@bufbuild/protobuf";
import { expect, test } from "vitest";
import { FieldKind, FieldSchema, SnapSchema } from "../src/gen/hl_pb";
import { placesJson } from "../src/saved_places";
import type { Layout } from "../src/scene_messages";

/** A quarter of a turn about z, then moved to 1 2 3. */
const kQuarter = [0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3];
const kX = { x: 1, y: 0, z: 0 };
const kSaid = { points: [9, 9, 9], normal: kX };
const kPlace = { placed: 1, points: [{ x: 1, y: 0, z: 0 }], normal: kX };
const kLayout: Layout = {
  number: 1, name: "", bounds: undefined, proxyRadius_m: 1, worldPerDevice: 1, placed: [], poses: new Float32Array(),
  felt: {
    snaps: [{ ...kPlace, snap: create(SnapSchema, { ...kSaid, name: "sheet", capture: 0.001, releaseN: 2 }) }],
    fields: [{ ...kPlace, field: create(FieldSchema, { ...kSaid, kind: FieldKind.CONSTANT, reach: 1, forceN: 2, direction: kX }) }],
  },
};

test("places, normals and directions are moved with the object", () => {
  const place = { points: [1, 3, 3], normal: { x: 0, y: 1, z: 0 } };
  expect(placesJson(kLayout, 1, kQuarter)).toEqual({
    snaps: [{ name: "sheet", capture: 0.001, releaseN: 2, ...place }],
    fields: [{ kind: "CONSTANT", reach: 1, forceN: 2, direction: { x: 0, y: 1, z: 0 }, ...place }],
  });
});

test("an object without any has no such fields", () => {
  expect(placesJson(kLayout, 0, kQuarter)).toEqual({});
  expect(placesJson({ ...kLayout, felt: undefined }, 1, kQuarter)).toEqual({});
});
