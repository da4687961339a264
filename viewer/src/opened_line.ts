// What is reported of a model that has been opened.

import { countedParts, formatCount, formatSi, kThinSpace, nounFor } from "./units";

/** As the server answers it. */
export interface Opened {
  readonly name: string;
  readonly triangles: number;
  /** Lines. Absent: there is none. */
  readonly segments?: number;
  /** Of clouds and of the model. Absent: there is none. */
  readonly points?: number;
  /** All that is felt: triangles, segments, points, and what surfaces without any are made of. Absent: there is nothing else. */
  readonly primitives?: number;
  readonly world_per_device: number;
  readonly warnings: readonly string[];
}

/** What is open now, in one line. */
export function openedLine(name: string, opened: Omit<Opened, "name">): string {
  const sentence = (warning: string) => ` ${warning.charAt(0).toUpperCase()}${warning.slice(1)}.`;
  const warnings = opened.warnings.map(sentence).join("");
  return `${name}: ${sizeOf(opened)}; 1${kThinSpace}mm of the hand is ` +
    `${formatSi(opened.world_per_device * 1e-3, "m")} of the scene.${warnings}`;
}

function sizeOf(
  { triangles, segments = 0, points = 0, primitives = triangles + segments + points }: Omit<Opened, "name">,
): string {
  const counted = (count: number, noun: string) => `${formatCount(count)} ${nounFor(count, noun)}`;
  if (segments + points > 0) {
    const rest = Math.max(0, primitives - triangles - segments - points);
    return countedParts([
      [triangles, "triangle"], [segments, "segment"], [points, "point"], [rest, "other primitive"],
    ]);
  }
  if (primitives <= triangles) {
    return counted(triangles, "triangle");
  }
  const primitive = counted(primitives, "primitive");
  const kind = triangles === 1 ? "a triangle" : "triangles";
  return triangles === 0 ? primitive : `${primitive}, ${formatCount(triangles)} of them ${kind}`;
}
