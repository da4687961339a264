// Where the names at hands stand on the screen: beside their hand, and over no other hand or name while there is room.
// No DOM: it can be tested alone. Pixels from the middle of the view, x to the right, y downward.

import { depthOf, metresPerPixel, type ViewFrame } from "./hand_mapping";
import { dot, sub, type Vec } from "./vec";

export interface Point {
  readonly x: number;
  readonly y: number;
}

/** What a hand takes on the screen. */
export interface Mark extends Point {
  readonly radius_px: number;
}

export interface NamedHand {
  /** No other hand's. */
  readonly key: string;
  readonly at: Mark;
  readonly width_px: number;
}

export const kName_px = 16;
/** Of the ring about a hand that is smaller. */
export const kRing_px = 14;
/** A name on a hand that fills the view is read better than one out of view. */
const kLargest_px = 60;
const kGap_px = 2;

interface Box {
  readonly middle: Point;
  readonly half: Point;
}

/** Of a hand whose proxy is at `point`. Undefined behind the eye. */
export function markInView(view: ViewFrame, point: Vec, radius_m: number): Mark | undefined {
  const pixel_m = metresPerPixel(view, depthOf(view, point));
  if (!(pixel_m > 0)) return undefined;
  const from = sub(point, view.eye);
  const radius_px = Math.min(Math.max(kRing_px, radius_m / pixel_m), kLargest_px);
  return { x: dot(from, view.right) / pixel_m, y: -dot(from, view.up) / pixel_m, radius_px };
}

const isOver = (a: Box, b: Box) =>
  Math.abs(a.middle.x - b.middle.x) < a.half.x + b.half.x && Math.abs(a.middle.y - b.middle.y) < a.half.y + b.half.y;

const boxOfHand = (at: Mark): Box => ({ middle: at, half: { x: at.radius_px, y: at.radius_px } });

const boxOfName = (hand: NamedHand, place: Point): Box => ({
  middle: { x: hand.at.x + place.x, y: hand.at.y + place.y },
  half: { x: hand.width_px / 2, y: kName_px / 2 },
});

/** From the hand to the middle of its name, the best first: above it, below it, beside it; then further away. */
function placesOf({ at, width_px }: NamedHand): Point[] {
  const away = at.radius_px + kGap_px, line = kName_px + kGap_px;
  const up = away + kName_px / 2, side = away + width_px / 2;
  const beside = [{ x: 0, y: -up }, { x: 0, y: up }, { x: side, y: 0 }, { x: -side, y: 0 }];
  const further = [1, 2, 3].flatMap((lines) => [{ x: 0, y: -up - lines * line }, { x: 0, y: up + lines * line }]);
  return [...beside, ...further];
}

/**
 * From each hand to the middle of its name, by the hand's key. A name stays where it was `before` while it is over
 * nothing there, so that it does not jump. Where there is no room it stands above its hand. `marks`: what no name is to
 * be over besides those hands.
 */
export function placeNames(
  hands: readonly NamedHand[], marks: readonly Mark[], before: ReadonlyMap<string, Point>,
): Map<string, Point> {
  const taken = [...hands.map((hand) => hand.at), ...marks].map(boxOfHand);
  const placed = new Map<string, Point>();
  for (const hand of hands) {
    const places = placesOf(hand);
    const old = before.get(hand.key);
    const kept = places.filter((place) => place.x === old?.x && place.y === old?.y);
    const isFree = (place: Point) => !taken.some((box) => isOver(box, boxOfName(hand, place)));
    const place = [...kept, ...places].find(isFree) ?? places[0]!;
    placed.set(hand.key, place);
    taken.push(boxOfName(hand, place));
  }
  return placed;
}
