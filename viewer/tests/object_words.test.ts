import { expect, test } from "vitest";
import { describeObject } from "../src/object_words";

test("an object is told by its client's names, and by its surface while it is touched", () => {
  expect(describeObject(0, { session: 0, object: 0, name: 0 }, 1, undefined)).toBe("The model");
  expect(describeObject(1, { session: 2, object: 7, name: 40 }, 3, { stiffness: 0.6, staticFriction: 1 })).toBe(
    "Object 2 of 3, id 7, name 40, of client 2: stiffness 0.60, static friction 1.00",
  );
  expect(describeObject(4, undefined, 5, undefined)).toBe("Object 5 of 5");
});
