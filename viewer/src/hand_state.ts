// One hand of a server, as a state holds it: the first one in the state itself, the others in its list. No DOM: it can
// be tested alone.

import type { State, Stylus } from "./gen/hl_pb";
import type { Layout } from "./scene_messages";
import type { Vec } from "./vec";
import { knownVec } from "./wire_values";

export interface HandState {
  readonly finger: Vec | undefined;
  readonly proxy: Vec | undefined;
  readonly touching: boolean;
  readonly exploring: boolean;
  readonly stylus: Stylus | undefined;
  /** Of its proxy, m; undefined: that of the layout. */
  readonly radius_m: number | undefined;
}

/** The hand of a device; of one that the state does not know: the first hand. */
export function handOf(state: State | undefined, device: number): HandState | undefined {
  if (state === undefined) {
    return undefined;
  }
  const other = device > 0 ? state.others[device - 1] : undefined;
  const { finger, proxy, exploring, stylus } = other ?? state;
  return {
    finger: knownVec(finger), proxy: knownVec(proxy), exploring, stylus,
    touching: other === undefined ? state.contacts.length > 0 : other.contacts > 0,
    radius_m: other !== undefined && other.proxyRadius > 0 ? other.proxyRadius : undefined,
  };
}

/**
 * Metres of the scene for one of the hand. A layout gives it for the first hand. The proxies of all have the same
 * radius at the hand, so that of another one in the scene gives its own scale.
 */
export function worldPerHand(
  layout: Pick<Layout, "worldPerDevice" | "proxyRadius_m"> | undefined, hand: HandState | undefined,
): number {
  const first = layout !== undefined && layout.worldPerDevice > 0 ? layout.worldPerDevice : 1;
  const radius_m = layout?.proxyRadius_m ?? 0;
  return hand?.radius_m !== undefined && radius_m > 0 ? (first * hand.radius_m) / radius_m : first;
}
