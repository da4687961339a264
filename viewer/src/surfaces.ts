// What the user sets for every surface at once, over what the scene says: the quantities, their ranges and their words.

import type { Surfaces } from "./gen/hl_pb";
import { formatFixed } from "./units";

/** Absent: as the scene says. */
export interface SurfaceSettings {
  stiffness?: number;
  staticFriction?: number;
  dynamicFriction?: number;
  viscosityNsM?: number;
  smooth?: boolean;
  textures?: boolean;
}

export type SurfaceNumber = "stiffness" | "staticFriction" | "dynamicFriction" | "viscosityNsM";

export interface Knob {
  readonly id: string;
  readonly quantity: SurfaceNumber;
  readonly max: number;
  readonly step: number;
  /** Where the thumb rests while the scene decides. */
  readonly rest: number;
  text(value: number): string;
}

export const kKnobs: readonly Knob[] = [
  {
    id: "surface-stiffness", quantity: "stiffness", max: 1, step: 0.01, rest: 1,
    text: (value) => formatFixed(100 * value, "%", 0),
  },
  { id: "static-friction", quantity: "staticFriction", max: 1.5, step: 0.01, rest: 0, text: (value) => value.toFixed(2) },
  { id: "dynamic-friction", quantity: "dynamicFriction", max: 1.5, step: 0.01, rest: 0, text: (value) => value.toFixed(2) },
  {
    id: "viscosity", quantity: "viscosityNsM", max: 20, step: 0.1, rest: 0,
    text: (value) => formatFixed(value, "N\u202fs/m", 1),
  },
];

export const kSurfaceFields = [...kKnobs.map((knob) => knob.quantity), "smooth", "textures"] as const;

/** The message as plain settings, without the fields that are not set. Textures that are not left out are not set. */
export function settingsOf(message: Surfaces | undefined): SurfaceSettings {
  const settings: SurfaceSettings = {};
  if (message === undefined) {
    return settings;
  }
  for (const { quantity } of kKnobs) {
    const value = message[quantity];
    if (value !== undefined && Number.isFinite(value)) {
      settings[quantity] = value;
    }
  }
  if (message.smooth !== undefined) settings.smooth = message.smooth;
  if (message.textures === false) settings.textures = false;
  return settings;
}
