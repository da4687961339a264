import { expect, test } from "vitest";
import { kPresets, originOf, presetOf, settingsFor } from "../src/materials";

const kKnown = ["stiffness", "staticFriction", "dynamicFriction", "viscosityNsM", "adhesionN"];

test("every preset is found again by its settings, and says where it is from", () => {
  for (const preset of kPresets) {
    expect(presetOf(settingsFor(preset, kKnown), kKnown)).toBe(preset);
    expect(originOf(preset)).toMatch(/^Friction measured: .*\. Rest invented\.$|^Invented\.$/);
  }
  expect(new Set(kPresets.map(({ name }) => name)).size).toBe(kPresets.length);
});

test("values are in range: stiffness up to 1, dynamic friction not above static", () => {
  for (const { settings } of kPresets) {
    expect(settings.stiffness).toBeGreaterThan(0);
    expect(settings.stiffness).toBeLessThanOrEqual(1);
    expect(settings.dynamicFriction).toBeLessThanOrEqual(settings.staticFriction!);
  }
});

test("a server is sent only quantities that it knows", () => {
  const honey = kPresets.find(({ name }) => name === "Honey")!;
  expect(settingsFor(honey, ["stiffness"])).toEqual({ stiffness: 0.4 });
  expect(presetOf({ stiffness: 0.31 }, kKnown)).toBeUndefined();
});
