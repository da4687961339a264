// An object of the scene in words: what its client calls it, and what its surface is like where it is touched.

import type { ContactPlane, PlacedMesh } from "./gen/hl_pb";

export type PlacedNames = Pick<PlacedMesh, "object" | "name" | "session">;

/** `index` and `count` of the layout; `contact` while it is touched. */
export function describeObject(
  index: number, placed: PlacedNames | undefined, count: number,
  contact: Pick<ContactPlane, "stiffness" | "staticFriction"> | undefined,
): string {
  const names: string[] = count > 1 ? [`Object ${index + 1} of ${count}`] : ["The model"];
  if (placed !== undefined && placed.session > 0) {
    names.push(`id ${placed.object}`, ...(placed.name > 0 ? [`name ${placed.name}`] : []), `of client ${placed.session}`);
  }
  const surface = contact && `: stiffness ${contact.stiffness.toFixed(2)}, static friction ${contact.staticFriction.toFixed(2)}`;
  return `${names.join(", ")}${surface ?? ""}`;
}
