// The page as a tool: picking, sections, links, sound, gamepads, pausing and saving. Against a stand-in server.

import { readFileSync } from "node:fs";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { FakeServer } from "../test-support/fake_server";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, modelPixels, openSection, resize, screenshot, states, type Complaints,
} from "./browser";

interface Stick {
  axes: number[];
  pressed: number[];
}

declare global {
  interface Window {
    pad: Stick | undefined;
    sounds: AudioContext[];
  }
}

let browser: Browser;
let server: FakeServer;
let page: Page;
let complaints: Complaints;

/** Loads the page with an address behind the server's, and waits for states. */
async function open(target: Page, behind = ""): Promise<void> {
  await target.goto(`${server.url}${behind}`);
  await target.waitForFunction(() => window.__hl.samples > 50);
}

beforeAll(async () => {
  browser = await launch();
  server = await FakeServer.start();
  const context = await browser.newContext({
    ...kWindow, colorScheme: "dark", permissions: ["clipboard-read", "clipboard-write"], acceptDownloads: true,
  });
  page = await context.newPage();
  complaints = listen(page, server.url);
  await page.addInitScript(() => {
    navigator.getGamepads = () => {
      const { pad } = window;
      const buttons = [0, 1, 2, 3].map((i) => ({ pressed: pad?.pressed.includes(i) ?? false }));
      const shown = { id: "stand-in", connected: true, axes: pad?.axes, buttons };
      return pad === undefined ? [] : [shown as unknown as Gamepad];
    };
    window.sounds = [];
    const Original = AudioContext;
    window.AudioContext = class extends Original {
      constructor() {
        super();
        window.sounds.push(this);
      }
    };
  });
  await open(page);
});

afterAll(async () => {
  await browser?.close();
  await server?.close();
});

const eye = () => page.evaluate(() => [0, 0.05].map((y) => window.__hl.project({ x: 0.01, y, z: 0.02 })));

test("names the object under the pointer and its material, and lights it; the same of what is pressed", async () => {
  server.explore = false;
  server.place(3);
  await page.waitForFunction(() => window.__hl.objects === 3);
  await page.keyboard.press("r");
  await states(page, 30);
  const at = await page.evaluate(() => window.__hl.project({ x: 0.3, y: 0, z: 0.03 }));
  const clip = { x: at.x - 20, y: at.y - 20, width: 40, height: 40 };
  await page.mouse.move(640, 640);
  await states(page, 5);
  const plain = await page.screenshot({ clip });
  await page.mouse.move(at.x, at.y);
  await expect.poll(() => page.textContent("#picked")).toBe("Object 3 of 3: stiffness 1, friction 0.5, sliding 0.3");
  await expect.poll(async () => (await page.screenshot({ clip })).equals(plain)).toBe(false);
  await screenshot(page, "tools_picked");
  await page.mouse.move(640, 640);
  await page.waitForSelector("#picked", { state: "hidden" });
  const first = await page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0.03 }));
  await page.mouse.move(first.x, first.y);
  await page.mouse.down();
  await expect.poll(() => page.textContent("#picked")).toBe("Object 1 of 3: stiffness 1, friction 0.5, sliding 0.3");
  await expectTidyLayout(page, kSizes[0]);
  await page.mouse.up();
  server.place(1);
  await page.waitForFunction(() => window.__hl.objects === 1);
  await page.keyboard.press("r");
  await page.mouse.move(640, 640);
});

test("a press follows what moves under a pointer that rests", async () => {
  const at = await page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0 }));
  const goals = () => server.received.flatMap(({ body }) => (body.case === "handGoal" ? [body.value.position!.z] : []));
  const spread_m = () => Math.max(...goals()) - Math.min(...goals());
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await states(page, 90);
  server.received.length = 0;
  await states(page, 20);
  expect(goals().length === 0 || spread_m() < 1e-3).toBe(true);
  server.swaying = true;
  await expect.poll(() => goals().length > 10 && spread_m() > 0.01).toBe(true);
  server.swaying = false;
  await page.mouse.up();
  await page.mouse.move(640, 640);
});

test("a section takes a part of the picture away, and nothing else", async () => {
  await openSection(page, "view");
  await states(page, 30);
  const whole = await modelPixels(page);
  await page.selectOption("#section", "above");
  await page.fill("#section-at", "0.9");
  await expect.poll(() => modelPixels(page)).toBeLessThan(0.7 * whole);
  await expectTidyLayout(page, kSizes[0]);
  await page.fill("#section-at", "0.5");
  await screenshot(page, "tools_section");
  expect(await page.evaluate(() => window.__hl.triangles)).toBe(16384);
  await page.selectOption("#section", "off");
  await expect.poll(() => modelPixels(page)).toBeGreaterThan(0.95 * whole);
});

test("view settings survive a reload, and a link shows another browser the same view without the token", async () => {
  await open(page, "?token=SECRET");
  await openSection(page, "view");
  await page.check("#cones");
  await page.uncheck("#drop");
  await page.selectOption("#section", "right");
  await page.fill("#section-at", "0.3");
  await page.mouse.move(640, 100);
  await page.mouse.down({ button: "right" });
  await page.mouse.move(760, 160, { steps: 4 });
  await page.mouse.up({ button: "right" });
  await states(page, 60);
  const seen = await eye();
  await openSection(page, "more");
  await page.click("#copy-link");
  await page.waitForSelector(".notice.told");
  const link = await page.evaluate(() => navigator.clipboard.readText());
  expect(link).toMatch(/^http:\/\/127\.0\.0\.1:\d+\/#show=.*camera=/);
  expect(link).not.toMatch(/SECRET|token/);
  await page.click(".notice.told button");
  await page.reload();
  expect(await page.isChecked("#cones")).toBe(true);
  expect(await page.isChecked("#drop")).toBe(false);
  expect(await page.inputValue("#section")).toBe("right");

  const other = await (await browser.newContext({ ...kWindow })).newPage();
  await other.goto(link);
  await other.waitForFunction(() => window.__hl.samples > 50);
  expect(await other.isChecked("#cones")).toBe(true);
  expect(await other.inputValue("#section-at")).toBe("0.3");
  const there = await other.evaluate(() => [0, 0.05].map((y) => window.__hl.project({ x: 0.01, y, z: 0.02 })));
  there.forEach((point, i) => {
    expect(Math.hypot(point.x - seen[i]!.x, point.y - seen[i]!.y)).toBeLessThan(2);
  });
  await other.context().close();
  await openSection(page, "view");
  await page.selectOption("#section", "off");
  await page.uncheck("#cones");
  await page.check("#drop");
});

test("the sound is off until it is asked for, and then follows the touch", async () => {
  expect(await page.evaluate(() => window.sounds.length)).toBe(0);
  await openSection(page, "more");
  await page.check("#sound");
  await expect.poll(() => page.evaluate(() => window.sounds.map(({ state }) => state))).toEqual(["running"]);
  server.explore = true;
  await states(page, 30);
  await page.uncheck("#sound");
  await expect.poll(() => page.evaluate(() => window.sounds.map(({ state }) => state))).toEqual(["suspended"]);
  server.explore = false;
});

test("a gamepad moves the hand, presses buttons, and lets go when its sticks do", async () => {
  server.received.length = 0;
  const from = await page.evaluate(() => window.__hl.finger!);
  await page.evaluate(() => (window.pad = { axes: [0, -1, 0, 0], pressed: [1] }));
  await page.waitForFunction(({ y }) => window.__hl.finger!.y > y + 0.01, from);
  await expect.poll(() => server.buttons).toBe(0b10);
  expect(await page.evaluate(() => window.__hl.holding)).toBe(true);
  await page.evaluate(() => (window.pad = { axes: [0, 0, 0, 0], pressed: [] }));
  await expect.poll(() => server.received.slice(-2).map(({ body }) => body.case)).toContain("release");
  await expect.poll(() => server.buttons).toBe(0);
  expect(await page.evaluate(() => window.__hl.holding)).toBe(false);
});

test("plots pause, and what they show is saved as a table; the view as a picture", async () => {
  server.explore = true;
  await openSection(page, "more");
  for (const size of kSizes) {
    await expectTidyLayout(page, size);
  }
  await resize(page, kSizes[0]);
  await openSection(page, "more");
  await states(page, 30);
  await page.keyboard.press("t");
  expect(await page.isChecked("#pause")).toBe(true);
  await states(page, 5);
  const plot = async () => (await page.locator("#plot-force").screenshot()).toString("base64");
  const before = await plot();
  await states(page, 20);
  expect(await plot()).toBe(before);
  const save = async (button: string) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  const table = await save("#save-samples");
  expect(table.name).toMatch(/^sphere-\d{4}-.*\.csv$/);
  const rows = table.bytes.toString("utf8").trim().split("\r\n").map((row) => row.split(","));
  expect(rows[0]).toEqual(["time_s", "force_N", "penetration_m"]);
  expect(rows.length).toBeGreaterThan(100);
  const times = rows.slice(1).map(([time]) => Number(time));
  expect(times.every((time, i) => i === 0 || time > times[i - 1]!)).toBe(true);
  expect(rows.slice(1).every((row) => Number(row[1]) >= 0 && row.length === 3)).toBe(true);
  const picture = await save("#save-picture");
  expect(picture.name).toMatch(/\.png$/);
  expect(picture.bytes.subarray(1, 4).toString()).toBe("PNG");
  // More than a plain background.
  expect(picture.bytes.length).toBeGreaterThan(5000);
  await screenshot(page, "tools_more");
  await page.keyboard.press("t");
  await expect.poll(async () => (await plot()) === before).toBe(false);
});

test("no console errors, and nothing from outside addresses", () => {
  expect(complaints.errors).toEqual([]);
  expect(complaints.foreign.filter((url) => !url.startsWith("blob:"))).toEqual([]);
});
