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
  return { label: shortened(hand.label), force: formatFixed(force && length(force), "N", 2), touches: hand.contacts > 0 };
}

/** Undefined: the server shares no world. */
export function sharedShown(state: State | undefined): SharedShown | undefined {
  const shared = state?.shared;
  if (shared === undefined) return undefined;
  const fetching = shared.fetching > 0n ? `, ${counted(shared.fetching, "shape")} on the way` : "";
  const objects = `${counted(shared.objects, "object")} of others, ${counted(shared.own, "own", "own")}${fetching}`;
  return {
    title: `Shared world ${shared.world}`,
    line: shared.ended === "" ? `This server is ${shared.name}: ${objects}` : `Not shared: ${shared.ended}`,
    ended: shared.ended !== "",
    servers: shared.peers.map((peer) => ({
      name: peer.name,
      line: `${formatFixed(peer.roundTripMs, "ms", 0)} there and back, shown ${formatFixed(peer.playoutMs, "ms", 0)} later`,
      hands: state!.remote.filter((hand) => hand.server === peer.name).map(handRow),
    })),
  };
}

/** A name at a hand may be no longer, in letters: what others say of themselves is not to cover the scene. */
const kLongest = 24;

function shortened(text: string): string {
  const letters = [...text];
  return letters.length > kLongest ? `${letters.slice(0, kLongest - 1).join("")}…` : text;
}

/** The name at a hand in the scene. */
export const nameOfHand = (hand: Pick<OtherDevice, "server" | "label">): string =>
  shortened(hand.label === "" ? hand.server : `${hand.server} ${hand.label}`);

/** Each hand by a key that no other has, the same in each state: two servers may have one name for a few seconds. */
export function handsByKey(hands: readonly OtherDevice[]): Map<string, OtherDevice> {
  const keyed = new Map<string, OtherDevice>();
  for (const hand of hands) {
    let number = 0;
    const key = () => JSON.stringify([hand.server, hand.label, number]);
    while (keyed.has(key())) ++number;
    keyed.set(key(), hand);
  }
  return keyed;
}

/** Colours of the style sheet, --server-1 and so on. */
export const kServerColours = 8;

function hashOf(name: string): number {
  let hash = 0;
  for (const letter of name) hash = (hash * 31 + letter.codePointAt(0)!) >>> 0;
  return hash;
}

/** A colour for each server, from its name: the same as long as the page is there, and no other's while there are some. */
export class ServerColours {
  private readonly numbers_ = new Map<string, number>();

  /** The name of a colour of the theme. */
  colourOf(server: string): string {
    let number = this.numbers_.get(server);
    if (number === undefined) {
      number = hashOf(server) % kServerColours;
      const taken = new Set(this.numbers_.values());
      for (let i = 0; i < kServerColours && taken.has(number); ++i) number = (number + 1) % kServerColours;
      this.numbers_.set(server, number);
    }
    return `server-${number + 1}`;
  }
}
