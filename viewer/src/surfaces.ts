// What the user sets for all surfaces together, over what the scene says. Which numbers there are, their ranges and
// their words the server sends (Hello.quantities).

import type { QuantityInfo, Surfaces } from "./gen/hl_pb";
import { formatFixed } from "./units";

/** Absent: as the scene says. */
export type SurfaceSettings = Partial<Omit<Surfaces, "$typeName" | "$unknown">>;
export type SurfaceField = keyof SurfaceSettings;

/** A slider. */
export interface Knob {
  readonly id: string;
  readonly label: string;
  readonly title: string;
  readonly field: SurfaceField;
  readonly max: number;
  readonly step: number;
  /** Where the thumb rests while the scene decides. */
  readonly rest: number;
  text(value: number): string;
}

/** A power of ten, so that a slider has 50 steps or more. */
function stepOf(most: number): number {
  return 10 ** Math.floor(Math.log10(most / 50));
}

export function knobOf(info: QuantityInfo): Knob {
  const step = stepOf(info.usual);
  const decimals = Math.max(0, Math.round(-Math.log10(step)));
  const never = info.words.endsWith("0: never");
  return {
    id: `surface-${info.name.replaceAll(" ", "-")}`,
    label: info.name.charAt(0).toUpperCase() + info.name.slice(1),
    title: info.words,
    field: info.field as SurfaceField,
    max: info.usual,
    step,
    rest: info.otherwise,
    text: (value) => (value === 0 && never ? "never"
      : info.unit === "" ? value.toFixed(decimals)
      : formatFixed(value, info.unit.replace(" ", "\u202f"), decimals)),
  };
}

/** The message as plain settings, without the fields that are not set. Textures that are not left out are not set. */
export function settingsOf(message: Surfaces | undefined): SurfaceSettings {
  const entries = Object.entries(message ?? {}).filter(([field, value]) =>
    typeof value === "number" ? Number.isFinite(value) : typeof value === "boolean" && !(field === "textures" && value));
  return Object.fromEntries(entries);
}

/**
 * Whether surfaces are felt with shading: as the user has set it, else as the materials of the scene have it. Undefined:
 * some are and some are not, or it is not known.
 */
export function shadingOf(set: boolean | undefined, objects: readonly (readonly Surfaces[])[]): boolean | undefined {
  if (set !== undefined || objects.length === 0 || objects.some((materials) => materials.length === 0)) {
    return set;
  }
  const smooth = objects.flat().filter((material) => material.smooth === true).length;
  return smooth === 0 ? false : smooth === objects.flat().length ? true : undefined;
}
