// The page of a shared world alone, against a stand-in server: many servers, hands side by side, and what a real one
// does rarely.

import type { MessageInitShape } from "@bufbuild/protobuf";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { OtherDeviceSchema } from "../src/gen/hl_pb";
import { FakeServer } from "../test-support/fake_server";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, openSection, resize, screenshot, states, type Complaints,
} from "./browser";

const kNames = ["anna", "bert", "carl", "dora", "emil", "fritz", "gina", "hugo"];
const kWorld = { world: "lab", name: "ida", objects: 27n, own: 3n };

let browser: Browser;
let server: FakeServer;
let page: Page;
let complaints: Complaints;

/** About the sphere, the even ones and the next ones close together. */
function placeOf(number: number) {
  const turn = 2.4 * (number - (number % 2)) + 0.15 * (number % 2);
  return { x: 0.06 * Math.cos(turn), y: 0.004 * number - 0.01, z: 0.06 * Math.sin(turn) };
}

function handOf(server: string, number: number, label = "", at = placeOf(number)): MessageInitShape<typeof OtherDeviceSchema> {
  return { server, label, finger: at, proxy: at, forceN: { x: 0, y: number, z: 0 }, proxyRadius: 0.002, contacts: number };
}

function meet(names: readonly string[], fetching = 0n): void {
  const peers = names.map((name, i) => ({ name, roundTripMs: 10 * i, playoutMs: 4 + 5 * i }));
  server.shared = { ...kWorld, fetching, peers };
  server.remote = names.map((name, i) => handOf(name, i));
}

const rows = () => page.locator("#shared-list .shared-server strong").allTextContents();

beforeAll(async () => {
  browser = await launch();
  server = await FakeServer.start();
  page = await browser.newPage({ ...kWindow, colorScheme: "light" });
  complaints = listen(page, server.url);
  await page.goto(server.url);
  await page.waitForFunction(() => window.__hl.samples > 100);
});
afterAll(async () => {
  await browser?.close();
  await server?.close();
});

test("shows nothing of it while the server shares none", async () => {
  expect(await page.isHidden("#shared")).toBe(true);
});

test("has a row for each server that comes, in a colour of its own, and none of one that goes", async () => {
  meet(kNames.slice(0, 2), 2n);
  await expect.poll(rows).toEqual(["anna", "bert"]);
  expect(await page.textContent("#shared-title")).toBe("Shared world lab");
  expect(await page.textContent("#shared-line")).toMatch(
    /^This server is ida: 27\sobjects of others, 3\sown, 2\sshapes on the way$/);
  expect(await page.textContent('[data-server="bert"]')).toMatch(/10\sms there and back, shown 9\sms later/);
  expect(await page.textContent('[data-server="bert"] .shared-hand')).toMatch(/^hand: 1.00\sN, touches$/);
  const colourOf = (name: string) =>
    page.locator(`[data-server="${name}"] strong`).evaluate((row) => getComputedStyle(row).color);
  const anna = await colourOf("anna");
  meet(kNames);
  await expect.poll(rows).toEqual(kNames);
  expect(await colourOf("anna")).toBe(anna);
  expect(new Set(await Promise.all(kNames.map(colourOf))).size).toBe(kNames.length);
  meet(["anna", "carl"]);
  await expect.poll(rows).toEqual(["anna", "carl"]);
  expect(await colourOf("anna")).toBe(anna);
});

test("is read in both themes at both sizes, with many hands side by side", async () => {
  meet(kNames);
  await openSection(page, "view");
  for (const theme of ["dark", "light"]) {
    await page.click(`label:has(input[name=theme][value=${theme}])`);
    await states(page, 3);
    await screenshot(page, `shared_page_${theme}`);
    for (const size of kSizes) await expectTidyLayout(page, size);
  }
  // In a low window the servers scroll, and stay where they were scrolled to while their numbers change.
  await resize(page, kSizes[0]);
  await page.locator('[data-server="hugo"]').scrollIntoViewIfNeeded();
  const scrolled = () => page.locator("#shared-list").evaluate((list) => list.scrollTop);
  const before = await scrolled();
  expect(before).toBeGreaterThan(0);
  server.remote = kNames.map((name, i) => handOf(name, i + 1));
  await expect.poll(() => page.textContent('[data-server="hugo"] .shared-hand')).toMatch(/^hand: 8/);
  expect(await scrolled()).toBe(before);
});

test("stays tidy whatever other servers say of themselves", async () => {
  meet(["w".repeat(32)]);
  server.remote = [handOf("w".repeat(32), 0, "left".repeat(50)), handOf("w".repeat(32), 1, "left".repeat(50))];
  server.remote.push({ server: "nobody" }, handOf("anna", 2, "", { x: NaN, y: Infinity, z: 0 }));
  await expect.poll(rows).toEqual(["w".repeat(32)]);
  await states(page, 3);
  await screenshot(page, "shared_page_long");
  for (const size of kSizes) await expectTidyLayout(page, size);
});

test("offers no way to arm the hand of another server", async () => {
  meet(["anna"]);
  await expect.poll(rows).toEqual(["anna"]);
  expect(await page.locator("#shared button").count()).toBe(0);
});

test("says in plain words that the world is not shared, and why", async () => {
  server.remote = [];
  server.shared = { ...kWorld, ended: "hl-share has ended; it is started again" };
  await expect.poll(() => page.textContent("#shared-line")).toBe("Not shared: hl-share has ended; it is started again");
  expect(await rows()).toEqual([]);
  await screenshot(page, "shared_page_ended");
});

test("the page has complained of nothing", () => {
  expect(complaints.errors).toEqual([]);
  expect(complaints.foreign).toEqual([]);
});
