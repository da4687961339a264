import { create } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { StateSchema } from "../src/gen/hl_pb";
import { nameOfHand, ServerColours, sharedShown } from "../src/shared_world";

const state = (ended = "") => create(StateSchema, {
  shared: {
    world: "lab", name: "anna", ended, objects: 1n, own: 12n, fetching: 2n,
    peers: [{ name: "bert", roundTripMs: 100.4, playoutMs: 75 }],
  },
  remote: [
    { server: "bert", label: "left", forceN: { x: 0, y: 3, z: 4 }, contacts: 1 },
    { server: "bert", label: "right", forceN: { x: 0, y: 0, z: 0 } },
    { server: "unknown", forceN: { x: 0, y: 0, z: 0 } },
  ],
});

describe("a shared world", () => {
  test("is nothing where the server shares none", () => {
    expect(sharedShown(undefined)).toBeUndefined();
    expect(sharedShown(create(StateSchema, {}))).toBeUndefined();
  });

  test("has a row for each other server, with its hands", () => {
    const shown = sharedShown(state())!;
    expect(shown.title).toBe("Shared world lab");
    expect(shown.line).toMatch(/^This server is anna: 1.object of others, 12.own, 2.shapes on the way$/);
    expect(shown.servers).toHaveLength(1);
    expect(shown.servers[0]!.line).toMatch(/^100.ms there and back, shown 75.ms later$/);
    expect(shown.servers[0]!.hands.map((hand) => [hand.label, hand.touches])).toEqual([["left", true], ["right", false]]);
    expect(shown.servers[0]!.hands[0]!.force).toMatch(/^5.00.N$/);
  });

  test("says why it is shared no more", () => {
    const shown = sharedShown(state("hl-share has ended"))!;
    expect(shown.ended).toBe(true);
    expect(shown.line).toBe("Not shared any more: hl-share has ended");
  });

  test("names a hand by its server, and by its device if there are several", () => {
    expect(nameOfHand({ server: "bert", label: "" })).toBe("bert");
    expect(nameOfHand({ server: "bert", label: "left" })).toBe("bert left");
  });
});

describe("the colours of servers", () => {
  test("stay the same, and differ while there are some left", () => {
    const colours = new ServerColours();
    const names = ["anna", "bert", "carl", "dora", "emil", "fritz", "gina", "hugo"];
    const hues = names.map((name) => colours.hueOf(name));
    expect(new Set(hues).size).toBe(names.length);
    expect(names.map((name) => colours.hueOf(name))).toEqual(hues);
    expect(colours.hueOf("one more")).toBeGreaterThanOrEqual(0);
  });

  test("begin from the name, so that all pages agree on the first", () => {
    expect(new ServerColours().hueOf("anna")).toBe(new ServerColours().hueOf("anna"));
  });
});
