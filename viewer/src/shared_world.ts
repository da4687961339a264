// What a page shows of a world that several servers share: the servers, each with a colour of its own, and their hands.
// No DOM: it can be tested alone.

import type { OtherDevice, State } from "./gen/hl_pb";
import { formatFixed, kNoBreak } from "./units";
import { length } from "./vec";
import { knownVec } from "./wire_values";

export interface HandRow {
  /** Of its device; "": the server has one. */
  readonly label: string;
  readonly force: string;
  readonly touches: boolean;
}

export interface ServerRow {
  readonly name: string;
  readonly line: string;
  readonly hands: readonly HandRow[];
}

export interface SharedShown {
  readonly title: string;
  /** What is there, in one line; why nothing is shared any more. */
  readonly line: string;
  readonly ended: boolean;
  readonly servers: readonly ServerRow[];
}

const counted = (count: bigint, one: string, many = `${one}s`) => `${count}${kNoBreak}${count === 1n ? one : many}`;

function handRow(hand: OtherDevice): HandRow {
  const force = knownVec(hand.forceN);
  return { label: hand.label, force: formatFixed(force && length(force), "N", 2), touches: hand.contacts > 0 };
}

/** Undefined: the server shares no world. */
export function sharedShown(state: State | undefined): SharedShown | undefined {
  const shared = state?.shared;
  if (shared === undefined) return undefined;
  const fetching = shared.fetching > 0n ? `, ${counted(shared.fetching, "shape")} on the way` : "";
  const objects = `${counted(shared.objects, "object")} of others, ${counted(shared.own, "own", "own")}${fetching}`;
  return {
    title: `Shared world ${shared.world}`,
    line: shared.ended === "" ? `This server is ${shared.name}: ${objects}` : `Not shared any more: ${shared.ended}`,
    ended: shared.ended !== "",
    servers: shared.peers.map((peer) => ({
      name: peer.name,
      line: `${formatFixed(peer.roundTripMs, "ms", 0)} there and back, shown ${formatFixed(peer.playoutMs, "ms", 0)} later`,
      hands: state!.remote.filter((hand) => hand.server === peer.name).map(handRow),
    })),
  };
}

/** The name at a hand in the scene. */
export const nameOfHand = (hand: Pick<OtherDevice, "server" | "label">): string =>
  hand.label === "" ? hand.server : `${hand.server} ${hand.label}`;

/** Degrees. None is near those of the own proxy and its force. */
const kHues = [210, 285, 335, 185, 250, 50, 5, 95];

function hashOf(name: string): number {
  let hash = 0;
  for (const letter of name) hash = (hash * 31 + letter.codePointAt(0)!) >>> 0;
  return hash;
}

/** A colour for each server, from its name: the same as long as the page is there, and no other's while there are some. */
export class ServerColours {
  private readonly places_ = new Map<string, number>();

  hueOf(name: string): number {
    let place = this.places_.get(name);
    if (place === undefined) {
      place = hashOf(name) % kHues.length;
      const taken = new Set(this.places_.values());
      for (let i = 0; i < kHues.length && taken.has(place); ++i) place = (place + 1) % kHues.length;
      this.places_.set(name, place);
    }
    return kHues[place]!;
  }

  /** As CSS and three.js read it, for text on the page's ground. */
  colourOf(name: string, isDark: boolean): string {
    return `hsl(${this.hueOf(name)}, 75%, ${isDark ? 70 : 40}%)`;
  }
}
