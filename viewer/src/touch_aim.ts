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
/** How far around a place its surface is looked at, m at the hand: the nearest may be a bump, the farthest too far. */
const kRings_D = [0.002, 0.004, 0.008];
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

/**
 * The deepest goal beneath a place that holds the proxy there, m. At a place q beside p the goal g = p - D n pulls the
 * proxy along the surface, across its normal m there, and that is back to p while
 *
 *   (g - q) . t >= 0,  t = d - (d . m) m,  d = p - q        so  D <= d . t / n . t,  on a ball of radius R  D <= R
 *
 * A ring of such places holds the proxy if all do, and one ring is enough: it comes no farther. Where no ring lies on
 * the surface as a whole, as at an edge, it is the middle of what is pressed.
 */
export function steadyDepth(scene: AimScene, hit: SurfaceHit): number {
  const depths = kRings_D.map((ring_D) => ringDepth(scene, hit, ring_D * scene.worldPerHand));
  const whole = depths.filter((depth_m) => depth_m !== undefined);
  return whole.length > 0 ? Math.max(...whole) : hit.thickness_m / 2;
}

/** Undefined: the surface does not reach around. */
function ringDepth({ model }: AimScene, { point, normal }: SurfaceHit, ring_m: number): number | undefined {
  let least_m = Infinity;
  for (const direction of around(normal, 8)) {
    const wall = model.cast(beside(point, normal, ring_m / 4), scale(direction, ring_m), 1);
    if (wall === undefined) {
      const above = add(beside(point, normal, ring_m), scale(direction, ring_m));
      const met = model.cast(above, scale(normal, -2 * ring_m), 1);
      if (met === undefined) {
        return undefined;
      }
      const back = sub(point, met.point);
      const along = sub(back, scale(met.normal, dot(back, met.normal)));
      const away = dot(normal, along);
      least_m = away > 0 ? Math.min(least_m, dot(back, along) / away) : least_m;
    }
  }
  return least_m;
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
      around(along, 4).every((side) => {
        const offset = scale(side, kWidth * proxyRadius_m);
        return clear(add(start, offset), add(end, offset));
      });
  };
}

/** So many unit vectors at right angles to `along`. */
function around(along: Vec, count: number): Vec[] {
  const other: Vec = Math.abs(along.x) < 0.7 ? { x: 1, y: 0, z: 0 } : { x: 0, y: 1, z: 0 };
  const a = unit(cross(along, other));
  const b = cross(along, a);
  const turned = (angle: number) => add(scale(a, Math.cos(angle)), scale(b, Math.sin(angle)));
  return Array.from({ length: count }, (_, i) => turned((2 * Math.PI * i) / count));
}
