// The shape of a friction cone, half-angle atan(mu_s) about the contact's normal. Its side is as long as the arrow of
// the contact's share of the force, so that the tip of an arrow on the verge of slipping touches the cone's rim.

import type { ContactPlane } from "./gen/hl_pb";

export interface ConeShape {
  readonly height_m: number;
  readonly radius_m: number;
}

/** A cone with a side of `side_m`. */
export function coneShape(staticFriction: number, side_m: number): ConeShape {
  const angle = Math.atan(staticFriction);
  return { height_m: side_m * Math.cos(angle), radius_m: side_m * Math.sin(angle) };
}

/** What part of the force each contact bears; equal parts when the server does not say. */
export function forceShares(contacts: readonly Pick<ContactPlane, "multiplierM">[]): number[] {
  const weights = contacts.map(({ multiplierM }) => (multiplierM > 0 && Number.isFinite(multiplierM) ? multiplierM : 0));
  const sum = weights.reduce((a, b) => a + b, 0);
  return weights.map((weight) => (sum > 0 ? weight / sum : 1 / weights.length));
}
