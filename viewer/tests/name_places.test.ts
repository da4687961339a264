import { describe, expect, test } from "vitest";
import { kName_px, kRing_px, markInView, placeNames, type Mark, type NamedHand, type Point } from "../src/name_places";

const mark = (x: number, y: number, radius_px = kRing_px): Mark => ({ x, y, radius_px });
const hand = (key: string, x: number, y: number, width_px = 40): NamedHand => ({ key, at: mark(x, y), width_px });
const none = new Map<string, Point>();

/** Whether the name of `hand` at `place` is over a box about `middle`. */
const isOver = (hand: NamedHand, place: Point, middle: Point, half_x: number, half_y: number) =>
  Math.abs(hand.at.x + place.x - middle.x) < half_x + hand.width_px / 2 &&
  Math.abs(hand.at.y + place.y - middle.y) < half_y + kName_px / 2;

function expectClear(hands: readonly NamedHand[], marks: readonly Mark[], placed: ReadonlyMap<string, Point>) {
  for (const one of hands) {
    const place = placed.get(one.key)!;
    for (const at of [...hands.map((other) => other.at), ...marks]) {
      expect(isOver(one, place, at, at.radius_px, at.radius_px), `${one.key} over a hand`).toBe(false);
    }
    for (const other of hands.filter(({ key }) => key !== one.key)) {
      const there = placed.get(other.key)!;
      const middle = { x: other.at.x + there.x, y: other.at.y + there.y };
      expect(isOver(one, place, middle, other.width_px / 2, kName_px / 2), `${one.key} over ${other.key}`).toBe(false);
    }
  }
}

describe("the name of a hand", () => {
  test("stands above a hand that is alone", () => {
    const place = placeNames([hand("anna", 100, 50)], [], none).get("anna")!;
    expect(place.x).toBe(0);
    expect(place.y).toBeLessThanOrEqual(-kRing_px - kName_px / 2);
  });

  test("is over no other hand or name, however they stand, while there is room", () => {
    const marks = [mark(0, 30)];
    for (const dx of [-25, -10, 0, 10, 25]) {
      for (const dy of [-40, -20, 0, 20, 40]) {
        const hands = [hand("anna", 0, 0), hand("bert left", dx, dy, 60), hand("carl", 2 * dx, dy / 2)];
        expectClear(hands, marks, placeNames(hands, marks, none));
      }
    }
  });

  test("is not over the hand of this page's own server", () => {
    const own = mark(0, -kRing_px - 8);
    expectClear([hand("anna", 0, 0)], [own], placeNames([hand("anna", 0, 0)], [own], none));
  });

  test("is not over its own hand where that is larger than its ring", () => {
    const large = { key: "anna", at: mark(0, 0, 50), width_px: 40 };
    expectClear([large], [], placeNames([large], [], none));
  });

  test("stays where it was while it is clear there, though a better place is free again", () => {
    const above = mark(0, -kRing_px - 8);
    const moved = placeNames([hand("anna", 0, 0)], [above], none);
    expect(moved.get("anna")!.y).toBeGreaterThan(0);
    expect(placeNames([hand("anna", 0, 0)], [], moved)).toEqual(moved);
    expect(placeNames([hand("anna", 0, 0)], [mark(0, 30)], moved).get("anna")!.y).toBeLessThan(0);
  });

  test("has a place also where there is no room for all of them", () => {
    const hands = Array.from({ length: 60 }, (_, i) => hand(`server ${i}`, i % 3, 0));
    expect(placeNames(hands, [], none).size).toBe(60);
  });
});

describe("a place in the view", () => {
  const view = {
    eye: { x: 0, y: 0, z: 1 }, right: { x: 1, y: 0, z: 0 }, up: { x: 0, y: 1, z: 0 }, forward: { x: 0, y: 0, z: -1 },
    fovY_rad: Math.PI / 2, height_px: 200,
  };

  test("is counted from the middle, in pixels of its own depth", () => {
    const near = markInView(view, { x: 0.5, y: 0.25, z: 0 }, 0.2)!;
    expect(near.x).toBeCloseTo(50);
    expect(near.y).toBeCloseTo(-25);
    expect(near.radius_px).toBeCloseTo(20);
    const far = markInView(view, { x: 0.5, y: 0.25, z: -1 }, 0.2)!;
    expect(far.x).toBeCloseTo(25);
    expect(far.radius_px).toBe(kRing_px);
  });

  test("is none behind the eye", () => {
    expect(markInView(view, { x: 0, y: 0, z: 2 }, 0.2)).toBeUndefined();
  });
});
