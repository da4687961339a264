import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { StateSchema } from "../src/gen/hl_pb";
import { handOf, worldPerHand } from "../src/hand_state";

describe("a hand of a state", () => {
  const state = create(StateSchema, {
    finger: { x: 1, y: 0, z: 0 }, proxy: { x: 2, y: 0, z: 0 }, contacts: [{}], exploring: true,
    others: [{ finger: { x: 3, y: 0, z: 0 }, proxy: { x: NaN, y: 0, z: 0 }, contacts: 0, proxyRadius: 0.004 }],
  });

  it("is that of the device, known as far as the state holds it", () => {
    expect(handOf(state, 0)).toMatchObject({
      finger: { x: 1 }, proxy: { x: 2 }, touching: true, exploring: true, radius_m: undefined,
    });
    expect(handOf(state, 1)).toMatchObject({
      finger: { x: 3 }, proxy: undefined, touching: false, exploring: false, radius_m: 0.004,
    });
  });

  it("is the first one where a recording holds no other, and none without a state", () => {
    expect(handOf(state, 2)).toEqual(handOf(state, 0));
    expect(handOf(undefined, 0)).toBeUndefined();
  });

  it("has the scale that its proxy's radius gives", () => {
    const layout = { proxyRadius_m: 0.002, worldPerDevice: 3 };
    expect(worldPerHand(layout, handOf(state, 0))).toBe(3);
    expect(worldPerHand(layout, handOf(state, 1))).toBe(6);
    expect(worldPerHand(undefined, handOf(state, 1))).toBe(1);
  });
});
