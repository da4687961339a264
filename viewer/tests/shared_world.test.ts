import { readFileSync } from "node:fs";
import { create } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { OtherDeviceSchema, StateSchema } from "../src/gen/hl_pb";
import { handsByKey, kServerColours, nameOfHand, ServerColours, sharedShown } from "../src/shared_world";

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
    expect(shown.line).toBe("Not shared: hl-share has ended");
  });

  test("names a hand by its server, and by its device if there are several", () => {
    expect(nameOfHand({ server: "bert", label: "" })).toBe("bert");
    expect(nameOfHand({ server: "bert", label: "left" })).toBe("bert left");
  });

  test("names no hand longer than can be read", () => {
    expect([...nameOfHand({ server: "bert", label: "é😀".repeat(100) })]).toHaveLength(24);
    expect(nameOfHand({ server: "bert", label: "x".repeat(19) })).toBe(`bert ${"x".repeat(19)}`);
  });

  test("keeps hands apart that have one name", () => {
    const hand = (server: string, label: string) => create(OtherDeviceSchema, { server, label });
    const hands = [hand("bert", ""), hand("bert", ""), hand("bert", "left"), hand("bert left", "")];
    const keyed = handsByKey(hands);
    expect([...keyed.values()]).toEqual(hands);
    expect([...handsByKey(hands.slice(2)).keys()]).toEqual([...keyed.keys()].slice(2));
  });
});

describe("the colours of servers", () => {
  test("stay the same, and differ while there are some left", () => {
    const colours = new ServerColours();
    const names = ["anna", "bert", "carl", "dora", "emil", "fritz", "gina", "hugo"];
    const first = names.map((name) => colours.colourOf(name));
    expect(new Set(first).size).toBe(kServerColours);
    expect(names.map((name) => colours.colourOf(name))).toEqual(first);
    expect(first).toContain(colours.colourOf("one more"));
  });

  test("begin from the name, so that all pages agree on the first", () => {
    expect(new ServerColours().colourOf("anna")).toBe(new ServerColours().colourOf("anna"));
  });

  test.each(["light", "dark"] as const)("are read on the page, and are like no other hand or contact, %s", (theme) => {
    const colours = coloursOf(theme);
    const servers = Array.from({ length: kServerColours }, (_, i) => colours[`server-${i + 1}`]!);
    for (const server of servers) {
      for (const ground of ["stage", "card"]) expect(contrast(server, colours[ground]!)).toBeGreaterThan(4.5);
      for (const own of ["proxy", "finger", "stylus", "force", "plane", "stick", "slip"]) {
        expect(difference(server, colours[own]!), `${server} and --${own}`).toBeGreaterThan(0.1);
      }
      for (const other of servers.filter((one) => one !== server)) {
        expect(difference(server, other), `${server} and ${other}`).toBeGreaterThan(0.14);
      }
    }
  });
});

/** What the style sheet says, by name; `#rrggbb`, as the last digits of a colour that shines through are left out. */
function coloursOf(theme: "light" | "dark"): Record<string, string> {
  const css = readFileSync(new URL("../src/style.css", import.meta.url), "utf8");
  const head = theme === "light" ? ":root {" : ':root[data-theme="dark"] {';
  const block = css.slice(css.indexOf(head), css.indexOf("}", css.indexOf(head)));
  return Object.fromEntries([...block.matchAll(/--([a-z0-9-]+): (#[0-9a-f]{6})/g)].map((match) => [match[1]!, match[2]!]));
}

/** Red, green and blue in proportion to their light. */
function lightOf(colour: string): [number, number, number] {
  const part = (at: number) => {
    const share = parseInt(colour.slice(at, at + 2), 16) / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  };
  return [part(1), part(3), part(5)];
}

/** As WCAG 2.2 has it; text is read from 4.5. */
function contrast(a: string, b: string): number {
  const [dark, bright] = [a, b].map(lightOf).map(([red, green, blue]) => 0.2126 * red + 0.7152 * green + 0.0722 * blue)
    .sort((x, y) => x - y) as [number, number];
  return (bright + 0.05) / (dark + 0.05);
}

/** The distance in Oklab (B. Ottosson 2020), in which steps that look alike are of one length; black to white: 1. */
function difference(a: string, b: string): number {
  const [x, y] = [a, b].map(labOf) as [number[], number[]];
  return Math.hypot(...x.map((value, i) => value - y[i]!));
}

function labOf(colour: string): number[] {
  const [red, green, blue] = lightOf(colour);
  const l = Math.cbrt(0.4122214708 * red + 0.5363325363 * green + 0.0514459929 * blue);
  const m = Math.cbrt(0.2119034982 * red + 0.6806995451 * green + 0.1073969566 * blue);
  const s = Math.cbrt(0.0883024619 * red + 0.2817188376 * green + 0.6299787005 * blue);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}
