// Snaps and force fields of a layout, as values the page can trust: places that are felt and have no surface.

import type { Field, PlacedField, PlacedSnap, SceneLayout, Snap } from "./gen/hl_pb";
import { isFiniteVec, length, type Vec } from "./vec";
import { knownVec, ProtocolError } from "./wire_values";

/** A point, the corners of a polyline, or a plane through one point. Frame of the placed mesh, m. */
export interface Place {
  /** Index into the layout. */
  readonly placed: number;
  readonly points: readonly Vec[];
  /** Not 0. */
  readonly normal: Vec | undefined;
}
export interface SnapPlace extends Place {
  readonly snap: Snap;
}
export interface FieldPlace extends Place {
  readonly field: Field;
}
export interface FeltPlaces {
  readonly snaps: readonly SnapPlace[];
  readonly fields: readonly FieldPlace[];
}

export function checkPlaces({ placed, snaps, fields }: SceneLayout): FeltPlaces {
  return {
    snaps: snaps.map((each) => snapOf(each, placed.length)),
    fields: fields.map((each) => fieldOf(each, placed.length)),
  };
}

function snapOf({ snap, placed }: PlacedSnap, objects: number): SnapPlace {
  const place = placeOf(snap, placed, objects, "snap");
  demand(isDistance(snap!.capture), "a snap of the scene takes from no distance");
  return { ...place, snap: snap! };
}

function fieldOf({ field, placed }: PlacedField, objects: number): FieldPlace {
  const place = placeOf(field, placed, objects, "field");
  demand(isDistance(field!.reach), "a field of the scene has no reach");
  return { ...place, field: field! };
}

function placeOf(said: Snap | Field | undefined, placed: number, objects: number, what: string): Place {
  const numbers = said?.points ?? [];
  const points = Array.from({ length: numbers.length / 3 }, (_, i) => {
    const [x, y, z] = numbers.slice(3 * i, 3 * i + 3) as [number, number, number];
    return { x, y, z };
  });
  const normal = knownVec(said?.normal);
  demand(placed < objects, `a ${what} of the scene has no object`);
  const whole = points.length > 0 && numbers.length % 3 === 0 && points.every(isFiniteVec);
  demand(whole, `a ${what} of the scene has no place`);
  const across = normal !== undefined && length(normal) > 0;
  demand(said?.normal === undefined || across, `a ${what} of the scene has no normal`);
  return { placed, points, normal };
}

const isDistance = (value: number): boolean => value > 0 && Number.isFinite(value);

function demand(holds: boolean, otherwise: string): void {
  if (!holds) {
    throw new ProtocolError(otherwise);
  }
}
