// What a layout holds of volumes, and the sliders that it makes.
import { create } from "@bufbuild/protobuf";
import { expect, test } from "vitest";
import { PlacedMeshSchema, PlacedVolumeSchema, SceneLayoutSchema, type PlacedVolume } from "../src/gen/hl_pb";
import { checkVolumes, isoSliderOf } from "../src/volumes";

const kValues = { surface: 1n, iso: -480, below: false, low: -1000, high: 700 };
const kCt = { name: "skin", ...kValues };

function layoutOf(volume: Partial<PlacedVolume>) {
  return create(SceneLayoutSchema, {
    placed: [create(PlacedMeshSchema, { mesh: 1, label: "skin" })],
    volumes: [create(PlacedVolumeSchema, { placed: 0, ...kValues, ...volume })],
  });
}

test("a volume has its surface, its value and its range", () => {
  expect(checkVolumes(layoutOf({}))).toEqual([kCt]);
});

test.each([{ placed: 1 }, { iso: NaN }, { low: -Infinity }, { high: -1001 }])("%o is refused", (broken) => {
  expect(() => checkVolumes(layoutOf(broken))).toThrow("a volume of the scene");
});

test("a slider reaches from the lowest to the highest value", () => {
  const slider = isoSliderOf([kCt], 0);
  expect([slider.min, slider.max, slider.step]).toEqual([-1000, 700, 10]);
  expect(slider.label).toBe("Iso value");
  expect(slider.text(-480)).toBe("-480\u202fHU");
});

test("of several volumes each has its name, or its number where the name does not distinguish it", () => {
  const labels = (...names: string[]) => {
    const volumes = names.map((name) => ({ ...kCt, name }));
    return volumes.map((_, i) => isoSliderOf(volumes, i).label);
  };
  expect(labels("skin", "bone")).toEqual(["Iso value of skin", "Iso value of bone"]);
  expect(labels("scan.nii", "scan.nii")).toEqual(["Iso value 1 of scan.nii", "Iso value 2 of scan.nii"]);
  expect(labels("", "bone", "")).toEqual(["Iso value 1", "Iso value of bone", "Iso value 3"]);
  expect(isoSliderOf([kCt, { ...kCt, name: "bone" }], 1).belowLabel).toBe("Matter below value of bone");
  expect(isoSliderOf([kCt], 0).belowLabel).toBe("Matter below it");
});

test("values that are no CT numbers have no unit", () => {
  const distance = isoSliderOf([{ name: "", surface: 1n, iso: 0, below: true, low: -0.031, high: 0.0942 }], 0);
  expect([distance.min, distance.max, distance.step]).toEqual([-0.031, 0.095, 0.001]);
  expect(distance.text(0.01)).toBe("0.010");
});

test("a volume of one value has a slider of one place", () => {
  const slider = isoSliderOf([{ name: "", surface: 1n, iso: 5, below: false, low: 5, high: 5 }], 0);
  expect([slider.min, slider.max, slider.step]).toEqual([5, 5, 1]);
});
