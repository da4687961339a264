// Snaps and fields of a layout: whole, or refused with a sentence.
import { create, type MessageInitShape } from "@bufbuild/protobuf";
import { expect, test } from "vitest";
import { checkPlaces } from "../src/felt_places";
import { FieldKind, PlacedFieldSchema, PlacedSnapSchema, SceneLayoutSchema } from "../src/gen/hl_pb";
import { ProtocolError } from "../src/wire_values";

type Snap = MessageInitShape<typeof PlacedSnapSchema>;
type Field = MessageInitShape<typeof PlacedFieldSchema>;
const placesOf = (snaps: Snap[], fields: Field[] = []) =>
  checkPlaces(create(SceneLayoutSchema, { placed: [{ mesh: 1 }, { mesh: 1 }], snaps, fields }));

test("a snap has its points, its normal and its object", () => {
  const points = [0, 1, 2, 3, 4, 5];
  const { snaps } = placesOf([
    { snap: { points, capture: 0.002 }, placed: 1 },
    { snap: { points: [0, 0, 0], normal: { z: 2 }, capture: 1 } },
  ]);
  expect(snaps[0]).toMatchObject({ placed: 1, points: [{ x: 0, y: 1, z: 2 }, { x: 3, y: 4, z: 5 }], normal: undefined });
  expect(snaps[1]).toMatchObject({ placed: 0, normal: { x: 0, y: 0, z: 2 } });
});

test("a field has its kind too", () => {
  const field = { points: [1, 0, 0], reach: 0.03, kind: FieldKind.DRAG };
  expect(placesOf([], [{ field }]).fields[0]!.field.kind).toBe(FieldKind.DRAG);
});

test("what is broken is refused", () => {
  const good = { points: [0, 0, 0], capture: 1 };
  const snaps: Snap[] = [
    {}, { snap: { ...good, points: [] } }, { snap: { ...good, points: [0, 0] } }, { snap: { ...good, points: [0, NaN, 0] } },
    { snap: { ...good, normal: {} } }, { snap: { ...good, normal: { x: Infinity } } }, { snap: { ...good, capture: 0 } },
    { snap: { ...good, capture: NaN } }, { snap: good, placed: 2 },
  ];
  for (const snap of snaps) expect(() => placesOf([snap])).toThrow(ProtocolError);
  const field = { points: [0, 0, 0], reach: 1 };
  const fields: Field[] = [{}, { field: { ...field, reach: -1 } }, { field, placed: 7 }, { field: { ...field, points: [1] } }];
  for (const each of fields) expect(() => placesOf([], [each])).toThrow(ProtocolError);
});
