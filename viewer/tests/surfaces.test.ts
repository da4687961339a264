import { create } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { QuantityInfoSchema, SurfacesSchema } from "../src/gen/hl_pb";
import { knobOf, settingsOf, shadingOf } from "../src/surfaces";

describe("surface settings", () => {
  test("keep only what is set, zero and false too", () => {
    const message = create(SurfacesSchema, { staticFriction: 0, smooth: false });
    expect(settingsOf(message)).toEqual({ staticFriction: 0, smooth: false });
    expect(settingsOf(undefined)).toEqual({});
  });

  test("numbers that are not numbers are not set", () => {
    expect(settingsOf(create(SurfacesSchema, { stiffness: NaN, viscosityNsM: Infinity }))).toEqual({});
  });

  test("textures that are not left out are as the scene says", () => {
    expect(settingsOf(create(SurfacesSchema, { textures: true }))).toEqual({});
    expect(settingsOf(create(SurfacesSchema, { textures: false }))).toEqual({ textures: false });
  });

  test("a knob has the range, the unit and the words that the server sends", () => {
    const knob = knobOf(create(QuantityInfoSchema, {
      field: "viscosityNsM", name: "viscosity", unit: "N s/m", usual: 20, otherwise: 0, words: "drag",
    }));
    expect(knob).toMatchObject({ id: "surface-viscosity", label: "Viscosity", field: "viscosityNsM", max: 20, step: 0.1, rest: 0 });
    expect(knob.text(20)).toBe("20.0\u202fN\u202fs/m");
    const friction = knobOf(create(QuantityInfoSchema, { field: "staticFriction", name: "static friction", usual: 1.5 }));
    expect(friction).toMatchObject({ id: "surface-static-friction", label: "Static friction", step: 0.01 });
    expect(friction.text(1.5)).toBe("1.50");
    expect(friction.text(0)).toBe("0.00");
  });

  test("a strength of 0 is that of a surface that never lets through", () => {
    const strength = knobOf(create(QuantityInfoSchema, { field: "strengthN", unit: "N", usual: 10, words: "pressed harder; 0: never" }));
    expect([strength.text(0), strength.text(0.1)]).toEqual(["never", "0.1\u202fN"]);
  });
});

test("shading is what is felt, whether the user or the scene has said it", () => {
  const [round, flat] = [create(SurfacesSchema, { smooth: true }), create(SurfacesSchema, { smooth: false })];
  expect(shadingOf(undefined, [[round], [round, round]])).toBe(true);
  expect(shadingOf(undefined, [[flat], [create(SurfacesSchema)]])).toBe(false);
  expect(shadingOf(true, [[flat]])).toBe(true);
  expect(shadingOf(false, [[round]])).toBe(false);
  expect(shadingOf(undefined, [[round], [flat]])).toBeUndefined();
  expect(shadingOf(undefined, [[round], []])).toBeUndefined();
  expect(shadingOf(undefined, [])).toBeUndefined();
});
