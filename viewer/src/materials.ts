// Surfaces that people know by name. Friction is that of physics textbooks where such a pair of materials was measured;
// softness, drag and adhesion are parts of this device's spring, so they are invented.

import type { SurfaceSettings } from "./surfaces";

export interface SurfacePreset {
  readonly name: string;
  readonly settings: SurfaceSettings;
  /** The pair of materials whose friction was measured; absent: all is invented. */
  readonly pair?: string;
}

export const kPresets: readonly SurfacePreset[] = [
  {
    name: "Rubber",
    settings: { stiffness: 0.6, staticFriction: 1, dynamicFriction: 0.8, viscosityNsM: 0 },
    pair: "rubber on concrete",
  },
  {
    name: "Ice",
    settings: { stiffness: 1, staticFriction: 0.1, dynamicFriction: 0.03, viscosityNsM: 0 },
    pair: "ice on ice",
  },
  {
    name: "Wood",
    settings: { stiffness: 1, staticFriction: 0.4, dynamicFriction: 0.2, viscosityNsM: 0 },
    pair: "wood on wood",
  },
  {
    name: "Steel",
    settings: { stiffness: 1, staticFriction: 0.74, dynamicFriction: 0.57, viscosityNsM: 0 },
    pair: "steel on steel",
  },
  {
    name: "Glass",
    settings: { stiffness: 1, staticFriction: 0.94, dynamicFriction: 0.4, viscosityNsM: 0 },
    pair: "glass on glass",
  },
  {
    name: "PTFE",
    settings: { stiffness: 1, staticFriction: 0.04, dynamicFriction: 0.04, viscosityNsM: 0 },
    pair: "PTFE on PTFE",
  },
  {
    name: "Skin",
    settings: { stiffness: 0.3, staticFriction: 0.5, dynamicFriction: 0.45, viscosityNsM: 0.5 },
    pair: "dry skin, mean",
  },
  {
    name: "Sandpaper",
    settings: { stiffness: 1, staticFriction: 1.2, dynamicFriction: 0.9, viscosityNsM: 0 },
  },
  {
    name: "Foam",
    settings: { stiffness: 0.15, staticFriction: 0.7, dynamicFriction: 0.6, viscosityNsM: 1 },
  },
  {
    name: "Honey",
    settings: { stiffness: 0.4, staticFriction: 0, dynamicFriction: 0, viscosityNsM: 12, adhesionN: 0.5 },
  },
];

/** One line: what was measured and what is invented. */
export function originOf({ pair }: SurfacePreset): string {
  return pair === undefined ? "Invented." : `Friction measured: ${pair}. Rest invented.`;
}

/** The part of a preset that a server with these quantities understands; what it leaves open is as the scene says. */
export function settingsFor(preset: SurfacePreset, known: readonly string[]): SurfaceSettings {
  return Object.fromEntries(Object.entries(preset.settings).filter(([field]) => known.includes(field)));
}

/** The preset that these settings are, among the known quantities. */
export function presetOf(chosen: SurfaceSettings, known: readonly string[]): SurfacePreset | undefined {
  const fields = known as (keyof SurfaceSettings)[];
  return kPresets.find((preset) => fields.every((field) => settingsFor(preset, known)[field] === chosen[field]));
}
