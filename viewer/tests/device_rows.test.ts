import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { deviceRows, exploreText } from "../src/device_rows";
import { HelloSchema, SafetyState, StateSchema } from "../src/gen/hl_pb";

describe("rows of devices", () => {
  const hello = create(HelloSchema, {
    device: { name: "Force Dimension omega.3", label: "left" },
    devices: [{ name: "Force Dimension omega.3", label: "left" }, { name: "Novint Falcon", label: "right" }],
  });
  const state = create(StateSchema, {
    forceN: { x: 0, y: 3, z: 4 }, safety: SafetyState.ON,
    others: [{ label: "right", safety: SafetyState.FAULT, fault: "the device does not answer" }],
  });

  it("name each device, with its state and force", () => {
    const [left, right] = deviceRows(hello, state);
    expect(left).toMatchObject({ label: "left", model: "Force Dimension omega.3", safety: SafetyState.ON, fault: "" });
    expect(left!.force).toMatch(/^5\.00/);
    expect(right).toMatchObject({ label: "right", safety: SafetyState.FAULT, fault: "the device does not answer" });
  });

  it("are none where there is one device, or nothing is known yet", () => {
    expect(deviceRows(create(HelloSchema, { device: { name: "one" } }), state)).toEqual([]);
    expect(deviceRows(hello, undefined)).toEqual([]);
    expect(deviceRows(undefined, state)).toEqual([]);
  });

  it("are those that the state reports, as in a recording of one", () => {
    expect(deviceRows(hello, create(StateSchema, {}))).toHaveLength(1);
  });

  it("have one control to explore by, which says for which hand", () => {
    const choice = { simulated: [0, 1], chosen: 1, together: false };
    expect(exploreText(choice, "right")).toBe("Explore by itself: right");
    expect(exploreText({ ...choice, together: true }, "right")).toBe("All explore by themselves");
    expect(exploreText({ ...choice, simulated: [1] }, "right")).toBe("Explore by itself");
  });
});
