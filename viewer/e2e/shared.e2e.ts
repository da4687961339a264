// Two servers, two pages, two hands, one world: `hl touch` brings a scene, `hld` has none of its own. Each page shows
// the hand of the other with its name, a hand pushes a body of the other server, what a lost server had stays, and a
// server that shares no more says so.

import { readdirSync, readFileSync } from "node:fs";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { expectTidyLayout, kSizes, kWindow, launch, listen, screenshot, states, type Complaints } from "./browser";
import { kProgram, startServer, startTouch, type Touch } from "./programs";

const kWorld = `page_${process.pid}`;

const textAt = async (touch: Touch, path: string) => (await fetch(touch.url + path)).text();

/** What `parent` has started by this name, by its id. */
function childOf(parent: number, name: string): number {
  const tasks = readdirSync(`/proc/${parent}/task`);
  const children = tasks.map((task) => readFileSync(`/proc/${parent}/task/${task}/children`, "utf8"));
  const ids = children.flatMap((line) => line.split(" ").filter((id) => id !== "").map(Number));
  const found = ids.find((id) => readFileSync(`/proc/${id}/comm`, "utf8").trim() === name);
  if (found === undefined) throw new Error(`${parent} has started no ${name}`);
  return found;
}

describe.skipIf(!kProgram)("two servers of a shared world", () => {
  let anna: Touch, bert: Touch;
  let browser: Browser;
  let pageOfAnna: Page, pageOfBert: Page;
  const complaints: Complaints[] = [];

  async function open(touch: Touch): Promise<Page> {
    const page = await browser.newPage({ ...kWindow, colorScheme: "light" });
    complaints.push(listen(page, touch.url));
    await page.goto(touch.url);
    return page;
  }

  beforeAll(async () => {
    anna = await startTouch(0, "workshop", "--share", kWorld, "--share-name", "anna");
    bert = await startServer("--share", kWorld, "--share-name", "bert");
    browser = await launch();
    [pageOfAnna, pageOfBert] = [await open(anna), await open(bert)];
  });
  afterAll(async () => {
    await browser?.close();
    anna?.process.kill("SIGKILL");
    bert?.process.kill("SIGKILL");
  });

  test("have the same objects", async () => {
    await pageOfAnna.waitForFunction(() => window.__hl.objects > 0);
    const objects = await pageOfAnna.evaluate(() => window.__hl.objects);
    await pageOfBert.waitForFunction((count) => window.__hl.objects === count, objects);
    expect(await pageOfBert.evaluate(() => window.__hl.triangles)).toBe(
      await pageOfAnna.evaluate(() => window.__hl.triangles));
  });

  test("show the hand of each other with its name and colour", async () => {
    await pageOfBert.waitForSelector('#shared-list [data-server="anna"]');
    await pageOfAnna.waitForSelector('#shared-list [data-server="bert"]');
    expect(await pageOfBert.textContent("#shared-title")).toBe(`Shared world ${kWorld}`);
    // A server of a busy machine may seem lost for a moment: then its objects are another's until it is back.
    await expect.poll(() => pageOfBert.textContent("#shared-line")).toMatch(
      /^This server is bert: \d+\sobjects? of others, 0\sown$/);
    await expect.poll(() => pageOfBert.textContent('[data-server="anna"] .shared-hand')).toMatch(/^hand: [0-9.]+\sN/);
    await pageOfBert.waitForFunction(() => window.__hl.remoteHands.some((hand) => hand.server === "anna"));
    // Where the other page shows its own hand, a little later.
    await pageOfAnna.uncheck("#explore");
    await expect.poll(async () => {
      const own = await pageOfAnna.evaluate(() => window.__hl.proxy!);
      const shown = await pageOfBert.evaluate(() => window.__hl.remoteHands[0]!.proxy!);
      return Math.hypot(own.x - shown.x, own.y - shown.y, own.z - shown.z);
    }).toBeLessThan(1e-3);
    await screenshot(pageOfBert, "shared_world");
    for (const size of kSizes) await expectTidyLayout(pageOfBert, size);
  });

  test("a hand pushes a body of the other server", async () => {
    const taken = async () => /^hl_share_pushes_total\{what="taken"\} (\d+)$/m.exec(await textAt(anna, "metrics"))?.[1];
    await pageOfBert.check("#explore");
    await expect.poll(async () => Number(await taken())).toBeGreaterThan(0);
  });

  test("what a lost server had stays, and the page says that it has gone", async () => {
    const objects = await pageOfBert.evaluate(() => window.__hl.objects);
    anna.process.kill("SIGKILL");
    await expect.poll(() => pageOfBert.locator("#shared-list li").count()).toBe(0);
    expect(await pageOfBert.evaluate(() => window.__hl.objects)).toBe(objects);
    await pageOfBert.waitForFunction(() => window.__hl.remoteHands.length === 0);
    await expect.poll(() => pageOfBert.textContent("#shared-line")).toMatch(/^This server is bert: 0\sobjects/);
  });

  test("a server whose hl-share has ended starts it again, and its hand goes on", async () => {
    expect((await fetch(`${bert.url}healthz`)).status).toBe(200);
    process.kill(childOf(bert.process.pid!, "hl-share"), "SIGKILL");
    await expect.poll(() => textAt(bert, "metrics")).toContain("\nhl_share_starts_total 1\n");
    await expect.poll(() => pageOfBert.textContent("#shared-line")).toMatch(/^This server is bert/);
    expect((await fetch(`${bert.url}healthz`)).status).toBe(200);
    await states(pageOfBert, 10);
    for (const size of kSizes) await expectTidyLayout(pageOfBert, size);
  });

  test("the pages have complained of nothing", () => {
    expect(complaints[1]!.errors).toEqual([]);
    expect(complaints.flatMap((page) => page.foreign)).toEqual([]);
  });
});
