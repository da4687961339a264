// What is told of a model that has been opened.

import { formatCount, formatSi, kThinSpace } from "./units";

/** As the server answers it. */
export interface Opened {
  readonly name: string;
  readonly triangles: number;
  readonly world_per_device: number;
  readonly warnings: readonly string[];
}

/** What is open now, in one line. */
export function openedLine(name: string, opened: Omit<Opened, "name">): string {
  const sentence = (warning: string) => ` ${warning.charAt(0).toUpperCase()}${warning.slice(1)}.`;
  const warnings = opened.warnings.map(sentence).join("");
  const size = `${formatCount(opened.triangles)} ${opened.triangles === 1 ? "triangle" : "triangles"}`;
  return `${name}: ${size}; 1${kThinSpace}mm of the hand is ` +
    `${formatSi(opened.world_per_device * 1e-3, "m")} of the scene.${warnings}`;
}
