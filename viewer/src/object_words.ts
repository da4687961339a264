// An object of the scene in words: what its client calls it, and what its material is where it is pointed at.

import type { PlacedMesh, Surfaces } from "./gen/hl_pb";
import type { SurfaceSettings } from "./surfaces";
import { kThinSpace } from "./units";

export interface PlacedNames extends Pick<PlacedMesh, "object" | "name" | "session"> {
  /** Of its file. */
  readonly label?: string;
  readonly materials: readonly Surfaces[];
}

/**
 * `index` and `count` of the layout; `material`: number of the one that is pointed at; `over`: what the user has set
 * over all surfaces.
 */
export function describeObject(
  index: number, placed: PlacedNames | undefined, count: number, material: number, over: SurfaceSettings = {},
): string {
  const names: string[] = count > 1 ? [`Object ${index + 1} of ${count}`] : ["The model"];
  if (placed?.label) {
    names.push(placed.label);
  }
  if (placed !== undefined && placed.session > 0) {
    const name = placed.name > 0 ? [`name ${placed.name}`] : [];
    names.push(`id ${placed.object}`, ...name, `of client ${placed.session}`);
  }
  const surface = placed?.materials[material];
  const described = surface === undefined ? "" : `: ${describeMaterial({ ...surface, ...over })}`;
  return `${names.join(", ")}${described}`;
}

/** What a texture modulates is said so; what is as if there were nothing is left out. */
function describeMaterial(surface: SurfaceSettings): string {
  const number = (value: number | undefined, words: string, unit = "") =>
    value === undefined ? `${words} by texture` : `${words} ${Number(value.toPrecision(3))}${unit}`;
  const parts = [number(surface.stiffness, "stiffness"), number(surface.staticFriction, "friction")];
  if (surface.dynamicFriction !== surface.staticFriction) {
    parts.push(number(surface.dynamicFriction, "sliding"));
  }
  if (surface.viscosityNsM !== 0) {
    parts.push(number(surface.viscosityNsM, "viscosity", `${kThinSpace}N${kThinSpace}s/m`));
  }
  if ((surface.adhesionN ?? 0) > 0) {
    parts.push(number(surface.adhesionN, "adhesion", `${kThinSpace}N`));
  }
  if ((surface.complianceMN ?? 0) > 0) {
    parts.push(number(surface.complianceMN, "compliance", `${kThinSpace}m/N`));
  }
  if ((surface.strengthN ?? 0) > 0) {
    parts.push(number(surface.strengthN, "strength", `${kThinSpace}N`));
  }
  return parts.join(", ");
}
