import { expect, test } from "vitest";
import { decodeView, encodeView, linkTo, type SharedView } from "../src/view_settings";

const kView: SharedView = {
  settings: { boxes: new Set(["cones", "drop"]), section: "above", sectionAt: 0.25 },
  camera: { position: { x: 0.1234567, y: -2, z: 3e-5 }, target: { x: 0, y: 0.5, z: 0 } },
};

test("a view that is written is read again, positions to six digits", () => {
  const read = decodeView(`#${encodeView(kView)}`)!;
  expect(read.settings).toEqual(kView.settings);
  expect(read.camera!.position.x).toBeCloseTo(0.1234567, 6);
  expect(read.camera!.target).toEqual(kView.camera!.target);
});

test("other fragments are no view, and nonsense in one is left out", () => {
  expect(decodeView("")).toBeUndefined();
  expect(decodeView("#top")).toBeUndefined();
  const read = decodeView("show=cones,nonsense&section=sideways,7&camera=1,2,x,4,5,6")!;
  expect([...read.settings.boxes]).toEqual(["cones"]);
  expect(read.settings.section).toBe("off");
  expect(read.settings.sectionAt).toBe(0.5);
  expect(read.camera).toBeUndefined();
  expect(decodeView("show=&camera=1,1,1,1,1,1")!.camera).toBeUndefined();
});

test("a link has neither the query nor the token of the page", () => {
  const page = new URL("https://lab.example:1997/?token=SECRET#old");
  const link = linkTo(page, kView);
  expect(link).toMatch(/^https:\/\/lab\.example:1997\/#show=cones,drop&/);
  expect(link).not.toMatch(/SECRET|token|old/);
});
