// Snaps and force fields as a scene file has them.

import { toJson } from "@bufbuild/protobuf";
import type { Place } from "./felt_places";
import { FieldSchema, SnapSchema } from "./gen/hl_pb";
import { moved, tripleOf, turned, vecOf, type Rigid } from "./rigid";
import type { Layout } from "./scene_messages";
import { knownVec } from "./wire_values";

type Json = Record<string, unknown>;

/** Those of a placed mesh: fields of its object in the file, whose frame it is in by `pose`. */
export function placesJson({ felt }: Layout, index: number, pose: Rigid): Json {
  const own = ({ placed }: Place) => placed === index;
  const snaps = felt?.snaps.filter(own).map((place) => ({
    ...(toJson(SnapSchema, place.snap) as Json), ...placeJson(place, pose),
  }));
  const fields = felt?.fields.filter(own).map((place) => {
    const direction = knownVec(place.field.direction);
    const said = { ...(toJson(FieldSchema, place.field) as Json), ...placeJson(place, pose) };
    return direction === undefined ? said : { ...said, direction: vecOf(turned(pose, tripleOf(direction))) };
  });
  return { ...(snaps?.length ? { snaps } : {}), ...(fields?.length ? { fields } : {}) };
}

function placeJson({ points, normal }: Place, pose: Rigid): Json {
  const place = { points: points.flatMap((point) => [...moved(pose, point)]) };
  return normal === undefined ? place : { ...place, normal: vecOf(turned(pose, tripleOf(normal))) };
}
