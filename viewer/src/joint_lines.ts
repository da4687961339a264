// The lines that show a joint, with both bodies where they start, world frame: axis and limits go with body b, a pointer
// or tick of the coordinate with body a.

import { JointKind, type Joint } from "./gen/hl_pb";
import { across, arc, ball, both, circle, crossAt, square, type Line } from "./lines";
import { add, scale, sub, unit, type Vec } from "./vec";

export interface JointLines {
  readonly ofA: readonly Line[];
  readonly ofB: readonly Line[];
  /** From a place of a to one of b. */
  readonly between?: readonly [Vec, Vec];
}

const kOrigin: Vec = { x: 0, y: 0, z: 0 };
/** Of small signs, as a part of the size. */
const kSmall = 0.25;

/** `size_m`: half the length of an axis. `bodyA`: a place of body a, to which the pointer of a hinge shows. */
export function jointLines(joint: Joint, bodyA: Vec, size_m: number): JointLines {
  const anchor = joint.anchor ?? kOrigin;
  const small_m = kSmall * size_m;
  switch (joint.kind) {
    case JointKind.HINGE:
      return hingeLines(joint, sub(bodyA, anchor), size_m);
    case JointKind.SLIDER:
      return sliderLines(joint, size_m);
    case JointKind.DISTANCE:
      return distanceLines(joint, small_m);
    case JointKind.FIXED:
      return { ofA: [], ofB: [{ x: 1, y: 0, z: 0 }, { x: 0, y: 1, z: 0 }].map((axis) => square(anchor, axis, small_m)) };
    default:
      return { ofA: crossAt(anchor, 2 * small_m), ofB: ball(anchor, small_m) };
  }
}

/** The coordinate is the angle of a about the axis of b. */
function hingeLines({ anchor: at, axis, low, high }: Joint, toA: Vec, size_m: number): JointLines {
  const anchor = at ?? kOrigin;
  const along = unit(axis ?? { x: 1, y: 0, z: 0 });
  const frame = across(along, toA);
  const [first, second] = frame;
  const radius_m = size_m / 2;
  const limited = low !== undefined && high !== undefined && high - low < 2 * Math.PI;
  const spoke = (angle: number): Line => {
    const way = add(scale(first, Math.cos(angle)), scale(second, Math.sin(angle)));
    return [add(anchor, scale(way, 0.8 * radius_m)), add(anchor, scale(way, 1.2 * radius_m))];
  };
  const ends = [low, high].filter((limit) => limit !== undefined);
  return {
    ofA: [[anchor, add(anchor, scale(first, 1.1 * radius_m))]],
    ofB: [
      both(anchor, scale(along, size_m)),
      limited ? arc(anchor, frame, radius_m, low, high) : circle(anchor, along, radius_m),
      ...ends.map(spoke),
    ],
  };
}

/** The coordinate is the way of a along the axis of b. */
function sliderLines({ anchor: at, axis, low, high }: Joint, size_m: number): JointLines {
  const anchor = at ?? kOrigin;
  const along = unit(axis ?? { x: 1, y: 0, z: 0 });
  const place = (coordinate: number) => add(anchor, scale(along, coordinate));
  const [u, v] = across(along).map((side) => scale(side, kSmall * size_m)) as [Vec, Vec];
  const from = low ?? Math.min(-size_m, (high ?? 0) - size_m);
  const to = high ?? Math.max(size_m, (low ?? 0) + size_m);
  const ends = [low, high].filter((limit) => limit !== undefined).map(place);
  return {
    ofA: [circle(anchor, along, 0.6 * kSmall * size_m)],
    ofB: [[place(from), place(to)], ...ends.flatMap((end) => [both(end, u), both(end, v)])],
  };
}

/** The coordinate is the distance of the anchors. */
function distanceLines({ anchor, anchorB, low, high }: Joint, small_m: number): JointLines {
  const [a, b] = [anchor ?? kOrigin, anchorB ?? kOrigin];
  const limits = [low, high].filter((limit) => limit !== undefined && limit > 0) as number[];
  return {
    ofA: crossAt(a, small_m),
    ofB: [...crossAt(b, small_m), ...limits.map((limit) => circle(b, across(sub(a, b))[0], limit))],
    between: [a, b],
  };
}
