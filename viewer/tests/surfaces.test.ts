import { create } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { SurfacesSchema } from "../src/gen/hl_pb";
import { kKnobs, settingsOf } from "../src/surfaces";

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

  test("each knob writes its own unit and rests within its range", () => {
    const texts = kKnobs.map((knob) => knob.text(knob.max));
    expect(texts).toEqual(["100\u202f%", "1.50", "1.50", "20.0\u202fN\u202fs/m"]);
    expect(kKnobs.every((knob) => knob.rest >= 0 && knob.rest <= knob.max)).toBe(true);
  });
});
