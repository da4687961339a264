import { create } from "@bufbuild/protobuf";
import { expect, test } from "vitest";
import { SurfacesSchema } from "../src/gen/hl_pb";
import { describeObject } from "../src/object_words";

const kPlain = create(SurfacesSchema, { stiffness: 1, staticFriction: 0, dynamicFriction: 0, viscosityNsM: 0 });
const kSticky = create(SurfacesSchema, {
  stiffness: 0.6, staticFriction: 1, dynamicFriction: 0.8, viscosityNsM: 2, adhesionN: 0.5,
});

test("an object is described by its client's names and by the material that is pointed at", () => {
  const placed = { session: 2, object: 7, name: 40, materials: [kPlain, kSticky] };
  expect(describeObject(1, placed, 3, 0)).toBe("Object 2 of 3, id 7, name 40, of client 2: stiffness 1, friction 0");
  expect(describeObject(0, { ...placed, session: 0 }, 1, 1)).toBe(
    "The model: stiffness 0.6, friction 1, sliding 0.8, viscosity 2\u202fN\u202fs/m, adhesion 0.5\u202fN",
  );
});

test("what the user has set over all surfaces is what is felt", () => {
  const placed = { session: 0, object: 0, name: 0, materials: [kPlain] };
  const over = { staticFriction: 0.5, dynamicFriction: 0.5 };
  expect(describeObject(0, placed, 1, 0, over)).toBe("The model: stiffness 1, friction 0.5");
});

test("what is not known is not said, and what a texture modulates is said so", () => {
  expect(describeObject(4, undefined, 5, 0)).toBe("Object 5 of 5");
  const textured = create(SurfacesSchema, { stiffness: 1, dynamicFriction: 0.2, viscosityNsM: 0 });
  expect(describeObject(0, { session: 0, object: 0, name: 0, materials: [textured] }, 1, 0)).toBe(
    "The model: stiffness 1, friction by texture, sliding 0.2",
  );
});

test("an object of a file has its name", () => {
  const bolt = { session: 0, object: 0, name: 0, label: "bolt 2", materials: [] };
  expect(describeObject(1, bolt, 3, 0)).toBe("Object 2 of 3, bolt 2");
  expect(describeObject(0, bolt, 1, 0)).toBe("The model, bolt 2");
});
