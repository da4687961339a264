// What a press on the view means: which point of which surface is under the pointer, and what lies between two places.
// It asks the surfaces as they are drawn.

import type { ModelView } from "./model_view";
import type { SurfaceHit } from "./press";
import { beside, placesAround, route, type Free } from "./route";
import type { Bounds } from "./scene_messages";
import { keeps, type Section } from "./section";
import { add, cross, dot, length, scale, sub, unit, type Vec } from "./vec";

/** A way around the scene keeps this far from it, m at the hand. */
const kAround_D = 0.015;
/** A hand in a hollow first rises this far from what it touches, m at the hand. */
const kRise_D = 0.015;
/** The proxy's way is free when rays this many radii beside it are. */
const kWidth = 1.3;
/** Near its ends the way may graze what is touched there: rays beside it start this many radii away. */
const kEnds = 4;
/** A ray into what it has just met starts this many of the scene's proxy radii on. */
const kSkip = 1e-3;

export interface Ray {
  readonly origin: Vec;
  readonly direction: Vec;
}

export interface AimScene {
  readonly model: ModelView;
  /** Of everything where it is now. */
  bounds(): Bounds | undefined;
  readonly proxyRadius_m: number;
  readonly worldPerHand: number;
  /** What is drawn; what is not is looked through. */
  readonly section: Section | undefined;
}

/** What the ray of a pixel meets first. */
export function surfaceUnder({ model, proxyRadius_m, section }: AimScene, ray: Ray): SurfaceHit | undefined {
  const drawn = section && ((point: Vec) => keeps(section, point));
  const met = model.cast(ray.origin, ray.direction, Infinity, drawn);
  if (met === undefined) {
    return undefined;
  }
  const normal = dot(met.normal, ray.direction) > 0 ? scale(met.normal, -1) : met.normal;
  const inward = scale(normal, -1);
  const skip_m = kSkip * proxyRadius_m;
  const back = model.cast(beside(met.point, inward, skip_m), inward);
  const { point, object, material } = met;
  return { point, normal, thickness_m: back?.distance ?? Infinity, object, material };
}

/** The proxy's way from `from`, where `off` leads away from what it touches, to `to`. */
export function planWay(scene: AimScene, from: Vec, off: Vec, to: Vec): Vec[] {
  const { worldPerHand } = scene;
  const bounds = scene.bounds();
  if (bounds === undefined) {
    return [from, to];
  }
  const places = placesAround(bounds, kAround_D * worldPerHand);
  if (length(off) > 0) {
    places.push(beside(from, unit(off), kRise_D * worldPerHand));
  }
  return route(from, to, places, freeWay(scene));
}

function freeWay({ model, proxyRadius_m }: AimScene): Free {
  const clear = (a: Vec, b: Vec) => model.cast(a, sub(b, a), 1) === undefined;
  return (a, b) => {
    const way = length(sub(b, a));
    if (!clear(a, b)) {
      return false;
    }
    const along = unit(sub(b, a));
    const [start, end] = [beside(a, along, kEnds * proxyRadius_m), beside(b, along, -kEnds * proxyRadius_m)];
    return way <= 2 * kEnds * proxyRadius_m ||
      around(along).every((side) => {
        const offset = scale(side, kWidth * proxyRadius_m);
        return clear(add(start, offset), add(end, offset));
      });
  };
}

/** Four unit vectors at right angles to `along`. */
function around(along: Vec): Vec[] {
  const other: Vec = Math.abs(along.x) < 0.7 ? { x: 1, y: 0, z: 0 } : { x: 0, y: 1, z: 0 };
  const a = unit(cross(along, other));
  const b = cross(along, a);
  return [a, b, scale(a, -1), scale(b, -1)];
}
