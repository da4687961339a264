// The page alone, against a stand-in server that does on command what a real one does rarely.

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { FakeServer } from "../test-support/fake_server";
import { expectTidyLayout, kSizes, launch, listen, modelPixels, screenshot, openView, type Complaints } from "./browser";

let browser: Browser;
let server: FakeServer;
let page: Page;
let complaints: Complaints;

beforeAll(async () => {
  browser = await launch();
  server = await FakeServer.start();
  page = await browser.newPage({ viewport: kSizes[0], colorScheme: "dark" });
  complaints = listen(page, server.url);
  await page.goto(server.url);
  await page.waitForFunction(() => window.__hl.samples > 100);
});

afterAll(async () => {
  await browser?.close();
  await server?.close();
});

/** Draws until the camera's own motion has died away. */
function atRest(): Promise<void> {
  return page.evaluate(async () => {
    const x = () => window.__hl.project({ x: 0, y: 0, z: 0.05 }).x;
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    for (let last = NaN, still = 0; still < 5; ) {
      await frame();
      still = Math.abs(x() - last) < 0.01 ? still + 1 : 0;
      last = x();
    }
  });
}

test("shows the model, and panels that do not overlap, in dark and light at both sizes", async () => {
  expect(await modelPixels(page)).toBeGreaterThan(0.05);
  await openView(page);
  await page.check("#planes");
  for (const theme of ["dark", "light"]) {
    await page.check(`input[name=theme][value=${theme}]`, { force: true });
    for (const size of kSizes) {
      await expectTidyLayout(page, size);
      await page.waitForTimeout(1500);
      await screenshot(page, `page_${theme}_${size.width}x${size.height}`);
    }
  }
});

test("gives a usable page in a small window", async () => {
  await page.setViewportSize({ width: 700, height: 600 });
  await page.waitForTimeout(500);
  const widest = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(widest).toBeLessThanOrEqual(700);
  const middle = await page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0 }));
  expect(middle.x).toBeCloseTo(350, 0);
  await screenshot(page, "page_small");
  await page.setViewportSize(kSizes[0]);
});

test("remembers the theme that was chosen", async () => {
  await openView(page);
  await page.check("input[name=theme][value=light]", { force: true });
  await page.reload();
  expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe("light");
  await openView(page);
  await page.check("input[name=theme][value=system]", { force: true });
  expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe("dark");
  await page.waitForFunction(() => window.__hl.samples > 10);
});

test("settings reach the server: exploration, grip, stiffness within the device's limits", async () => {
  await page.keyboard.press("e");
  await expect.poll(() => server.explore).toBe(false);
  await page.check("#grip-firm", { force: true });
  await expect.poll(() => server.handFirm).toBe(true);
  expect(await page.getAttribute("#stiffness", "max")).toBe("3500");
  await page.fill("#stiffness", "2000");
  await expect.poll(() => server.stiffness_N_m).toBe(2000);
  await expect.poll(() => page.textContent("#stiffness-value")).toMatch(/2.000.N\/m/);
});

test("keys, the wheel and the release of the mouse move and let go of the hand", async () => {
  await page.keyboard.press("Escape");
  await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
  server.received.length = 0;
  const before = await page.evaluate(() => window.__hl.finger!);
  await page.keyboard.down("w");
  await page.waitForTimeout(400);
  await page.keyboard.up("w");
  await expect.poll(() => server.received.at(-1)?.body.case).toBe("release");
  const goals = server.received.flatMap(({ body }) => (body.case === "handGoal" ? [body.value.position!] : []));
  expect(Math.hypot(goals.at(-1)!.x - before.x, goals.at(-1)!.z - before.z)).toBeGreaterThan(1e-3);
  await page.mouse.move(640, 360);
  await page.mouse.down();
  await page.mouse.wheel(0, -300);
  await expect.poll(() => server.received.at(-1)?.body.case).toBe("handGoal");
  expect(await page.evaluate(() => window.__hl.holding)).toBe(true);
  await page.mouse.up();
  await expect.poll(() => server.received.at(-1)?.body.case).toBe("release");
});

test("right-drag, Shift-drag and, when chosen, drags on empty space orbit the camera and leave the hand alone", async () => {
  await page.waitForFunction(() => !window.__hl.exploring);
  server.received.length = 0;
  const marker = () => page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0.05 }).x);
  await atRest();
  const empty = { x: 330, y: 560 };
  const drag = async (button: "left" | "right") => {
    const before = await marker();
    await page.mouse.move(empty.x, empty.y);
    await page.mouse.down({ button });
    await page.mouse.move(empty.x + 60, empty.y, { steps: 4 });
    await page.mouse.up({ button });
    await atRest();
    return Math.abs((await marker()) - before);
  };
  expect(await drag("right")).toBeGreaterThan(5);
  await page.keyboard.down("Shift");
  expect(await drag("left")).toBeGreaterThan(5);
  await page.keyboard.up("Shift");
  await openView(page);
  await page.check("#empty-orbit");
  expect(await drag("left")).toBeGreaterThan(5);
  expect(server.received.map(({ body }) => body.case)).toEqual([]);
  await page.uncheck("#empty-orbit");
  expect(await drag("left")).toBeLessThan(0.5);
  expect(server.received.map(({ body }) => body.case)).toContain("handGoal");
  await page.click("#reset-view");
});

test("a fault shows its reason and can be re-armed", async () => {
  server.fault = "the target is 50 ms old";
  await page.waitForSelector("#rearm:visible");
  expect(await page.textContent("#fault")).toBe("the target is 50 ms old");
  for (const size of kSizes) {
    await expectTidyLayout(page, size);
  }
  await page.setViewportSize(kSizes[0]);
  await screenshot(page, "page_fault");
  await page.click("#rearm");
  await page.waitForSelector("#rearm", { state: "hidden" });
  expect(server.fault).toBe("");
});

test("a server that says nothing, or speaks nonsense, is told to the user and the page recovers", async () => {
  server.silent = true;
  await page.waitForSelector("[data-cause=link]", { timeout: 10_000 });
  server.silent = false;
  await page.waitForSelector("[data-cause=link]", { state: "detached", timeout: 10_000 });
  server.sendRaw(Uint8Array.of(0x12, 0xff, 0x01));
  await page.waitForSelector(".notice.told");
  await page.waitForFunction(() => window.__hl.link === "live", undefined, { timeout: 10_000 });
  await page.click(".notice.told button");
});

test("the help opens and closes", async () => {
  await page.keyboard.press("?");
  await page.waitForSelector("#help[open]");
  await screenshot(page, "page_help");
  await page.keyboard.press("Escape");
  await page.waitForSelector("#help:not([open])", { state: "attached" });
});

test("no console errors, and nothing from outside addresses", () => {
  expect(complaints.errors).toEqual([]);
  expect(complaints.foreign).toEqual([]);
});
