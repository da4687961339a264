// The main job, end to end: `hl touch teapot` and its page in a real browser. A drag pushes the finger into the model,
// the force rises, and the proxy stays outside: judged here from the bytes on the wire against every triangle, not by
// the page. Then the server dies and comes back. HL_BIN names the `hl` program; without it these tests are skipped.

import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, test } from "vitest";
import { decodeServerMessage } from "../src/protocol";
import type { Layout, Mesh } from "../src/scene_messages";
import { length, sub, type Vec } from "../src/vec";
import { knownVec } from "../src/wire_values";
import { distanceToTriangles } from "../test-support/closest_point";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, modelPixels, openSection, resize, screenshot, states, turnWheel,
  type Complaints,
} from "./browser";
import { ended, kProgram, startTouch, type Touch } from "./programs";

/** Positions of the mesh arrive as float32: exact to about this share of the model's size. */
const kWireRounding = 1e-6;

interface Pixel {
  readonly x: number;
  readonly y: number;
}

/** The scene, whose one object's frame is the world, and every proxy and finger that came over the wire. */
class WireTap {
  mesh: Mesh | undefined;
  layout: Layout | undefined;
  readonly proxies: Vec[] = [];
  deepest_m = 0;

  attach(page: Page): void {
    page.on("websocket", (socket) => {
      socket.on("framereceived", ({ payload }) => this.read(Buffer.from(payload)));
    });
  }

  private read(payload: Buffer): void {
    const message = decodeServerMessage(new Uint8Array(payload));
    if (message.kind === "mesh") {
      this.mesh = message.mesh;
    } else if (message.kind === "layout") {
      this.layout = message.layout;
    } else if (message.kind === "state") {
      const proxy = knownVec(message.state.proxy);
      const finger = knownVec(message.state.finger);
      if (proxy !== undefined && finger !== undefined) {
        this.proxies.push(proxy);
        this.deepest_m = Math.max(this.deepest_m, length(sub(proxy, finger)));
      }
    }
  }
}

describe.skipIf(!kProgram)("hl touch teapot", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;
  const tap = new WireTap();

  beforeAll(async () => {
    touch = await startTouch(0);
    browser = await launch();
    page = await browser.newPage({ ...kWindow, colorScheme: "dark" });
    complaints = listen(page, touch.url);
    tap.attach(page);
    await page.goto(touch.url);
    await page.waitForFunction(() => window.__hl.triangles > 0 && window.__hl.samples > 100);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGKILL");
  });

  /** A drag that failed halfway must not hold the button down in the tests after it. */
  afterEach(() => page.mouse.up());

  test("shows the model", async () => {
    await expect.poll(() => modelPixels(page)).toBeGreaterThan(0.05);
    expect(await page.textContent("#scene-name")).toMatch(/teapot/i);
    await screenshot(page, "touch_exploring");
  });

  test("a drag pushes the finger into the model, the force rises, the proxy stays outside", async () => {
    const before = await page.evaluate(() => {
      const { boundsMin: low, boundsMax: high, finger } = window.__hl;
      const centre = { x: (low!.x + high!.x) / 2, y: (low!.y + high!.y) / 2, z: (low!.z + high!.z) / 2 };
      return { from: window.__hl.project(finger!), to: window.__hl.project(centre) };
    });
    await page.mouse.move(before.from.x, before.from.y);
    await page.mouse.down();
    await page.waitForFunction(() => !window.__hl.exploring);
    const began_s = await page.evaluate(() => window.__hl.time_s!);
    const first = tap.proxies.length;
    tap.deepest_m = 0;
    // Above the model first, then slowly down to its middle: wherever the stroking hand was, the way crosses the surface.
    const above = { x: before.to.x, y: before.to.y - 160 };
    await moveInSteps(page, before.from, above, 8);
    await moveInSteps(page, above, before.to, 20);
    await pushUntilHeld(page);
    await screenshot(page, "touch_dragging");
    const peak = await page.evaluate((since_s) => window.__hl.peak(window.__hl.time_s! - since_s), began_s);
    expect(peak.force_N).toBeGreaterThan(0.5);
    expect(peak.penetration_m).toBeGreaterThan(1e-4);
    expect(tap.deepest_m).toBeGreaterThan(tap.layout!.proxyRadius_m);
    await page.mouse.up();
    expectOutside(tap, first);
  });

  test("surface controls act immediately, and what the server says moves them", async () => {
    await openSection(page, "surface");
    await page.fill("#surface-static-friction", "0.8");
    await page.fill("#surface-dynamic-friction", "0.4");
    await page.uncheck("#shading");
    await page.click("label:has(#ledger-strict)");
    await page.waitForFunction(() => {
      const { surfaces, ledger } = window.__hl;
      return surfaces.staticFriction === 0.8 && surfaces.dynamicFriction === 0.4 && surfaces.smooth === false &&
        ledger === "STRICT";
    });
    const other = await browser.newPage(kWindow);
    await other.goto(touch.url);
    await other.waitForFunction(() => document.querySelector("#surface-static-friction-value")?.textContent === "0.80");
    await other.click("#surface-reset");
    await page.waitForFunction(() => document.querySelector("#surface-static-friction-value")?.textContent === "scene");
    await other.close();
    await page.fill("#surface-static-friction", "0.6");
    await page.click("label:has(#ledger-tank)");
    expect(await page.locator("#plot-energy canvas").count()).toBe(1);
  });

  test("panels do not overlap, in dark and light, at both sizes", async () => {
    await page.check("#explore");
    await page.keyboard.press("p");
    await page.keyboard.press("c");
    for (const theme of ["light", "dark"]) {
      await openSection(page, "view");
      // The label is what is seen, and what waits until the folds stand still; the button itself is hidden.
      await page.click(`label:has(input[name=theme][value=${theme}])`);
      for (const size of kSizes) {
        for (const section of ["view", "surface"] as const) {
          await openSection(page, section);
          await expectTidyLayout(page, size);
        }
        await screenshot(page, `touch_${theme}_${size.width}x${size.height}`);
      }
    }
    await resize(page, kSizes[0]);
    expectOutside(tap, 0);
  });

  test("a killed server is reported, and a restarted one is found again", async () => {
    const port = Number(new URL(touch.url).port);
    touch.process.kill("SIGKILL");
    await page.waitForSelector("[data-cause=link]");
    expect(await page.textContent("[data-cause=link]")).toMatch(/server went away/);
    await screenshot(page, "touch_gone");
    touch = await startTouch(port);
    await page.waitForSelector("[data-cause=link]", { state: "detached" });
    await page.waitForFunction(() => window.__hl.link === "live" && window.__hl.samples > 10);
  });

  test("no console errors, nothing from outside addresses, and a clean end on SIGTERM", async () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign).toEqual([]);
    touch.process.kill("SIGTERM");
    expect(await ended(touch.process)).toBe(0);
  });
});

/** A drag whose steps are each at least one state of the server long. */
async function moveInSteps(page: Page, from: Pixel, to: Pixel, steps: number): Promise<void> {
  for (let i = 1; i <= steps; ++i) {
    const share = i / steps;
    await page.mouse.move(from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share);
    await states(page);
  }
}

/**
 * Turns the wheel toward the depth of the model's middle until the surface holds the finger back by more than the
 * proxy's radius: the finger is then inside. The hand's grip is light, a few newtons: it cannot push much deeper.
 */
async function pushUntilHeld(page: Page): Promise<void> {
  const kTurns = 150;
  for (let i = 0; i < kTurns; ++i) {
    const { separation, farther_m } = await page.evaluate(() => {
      const { boundsMin: low, boundsMax: high, finger } = window.__hl;
      const centre = { x: (low!.x + high!.x) / 2, y: (low!.y + high!.y) / 2, z: (low!.z + high!.z) / 2 };
      return {
        separation: window.__hl.separation_m! / window.__hl.proxyRadius_m!,
        farther_m: window.__hl.project(centre).depth_m - window.__hl.project(finger!).depth_m,
      };
    });
    if (separation > 1) {
      return;
    }
    await turnWheel(page, farther_m > 0 ? -60 : 60);
    await states(page, 3);
  }
  throw new Error(`the surface did not hold the finger back in ${kTurns} turns of the wheel`);
}

/** Proxies since `first`, evenly picked, at most this many: each is asked of every triangle. */
const kProxiesMax = 400;

/** The proxies since `first` keep their radius from every triangle. */
function expectOutside(tap: WireTap, first: number): void {
  const { positions, triangles } = tap.mesh!;
  const { proxyRadius_m } = tap.layout!;
  const since = tap.proxies.slice(first);
  expect(since.length).toBeGreaterThan(30);
  const every = Math.ceil(since.length / kProxiesMax);
  const proxies = since.filter((_proxy, i) => i % every === 0);
  const nearest = Math.min(...proxies.map((proxy) => distanceToTriangles(proxy, positions, triangles)));
  const size = positions.reduce((largest, value) => Math.max(largest, Math.abs(value)), 0);
  expect(nearest).toBeGreaterThan(proxyRadius_m - kWireRounding * size);
}
