// Two hands that one mouse moves lift a block between them: one is brought to each side, and stays there as it is left;
// then both go up together.

import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { length, sub, type Vec } from "../src/vec";
import { expectTidyLayout, kSizes, kWindow, launch, listen, screenshot, states, type Complaints } from "./browser";
import { kProgram, startTouch, type Touch } from "./programs";

/** Half the side of the block, m. */
const kHalf_m = 0.02;
/** Where a hand comes down beside it. */
const kAside_m = 0.05;
const kNear_m = 0.004;
/** 1.5 N with a spring of 1000 N/m. */
const kPressed_m = 0.0015;
/** Number of the block among the scene's objects. */
const kBlock = 1;

const kScene = JSON.stringify({
  objects: [
    {
      name: "floor",
      primitives: {
        vertices: [-0.1, 0, 0.1, 0.1, 0, 0.1, 0.1, 0, -0.1, -0.1, 0, -0.1], polygons: [{ vertices: [0, 1, 2, 3] }],
      },
    },
    {
      name: "block",
      primitives: {
        vertices: [
          [-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1],
        ].flat().map((corner) => corner * kHalf_m),
        polygons: [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [3, 7, 6, 2], [0, 4, 7, 3], [1, 2, 6, 5]].map(
          (vertices) => ({ vertices }),
        ),
      },
      transform: { translate: { y: kHalf_m } },
      material: { staticFriction: 1, dynamicFriction: 0.9 },
      body: { massKg: 0.05, staticFriction: 0.4, shape: "BOX" },
    },
  ],
});

describe.skipIf(!kProgram)("two hands at a block", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;
  const folder = mkdtempSync(join(tmpdir(), "hl-e2e-"));

  beforeAll(async () => {
    const scene = join(folder, "block.hl.json");
    writeFileSync(scene, kScene);
    touch = await startTouch(0, scene, "--device", "left=sim", "--device", "right=sim", "--explore", "off", "--scale", "1");
    browser = await launch();
    page = await browser.newPage(kWindow);
    complaints = listen(page, touch.url);
    // Level, from the front: a drag moves a hand in x and y.
    await page.goto(`${touch.url}#show=drop,stylus,marks&camera=0,0.05,0.45,0,0.05,0`);
    await page.waitForFunction(() => window.__hl.objects === 2 && window.__hl.hands.length === 2);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGTERM");
    rmSync(folder, { recursive: true });
  });

  const finger = (device: number) => page.evaluate((number) => window.__hl.hands[number]!.finger!, device);
  const pixelOf = (at: Vec) => page.evaluate((point) => window.__hl.project(point), at);
  const touching = () => page.evaluate(() => window.__hl.hands.map((hand) => hand.touching));
  /** How far the spring between finger and proxy of each is stretched. */
  const springs_m = () => page.evaluate(() => window.__hl.hands.map(
    ({ finger, proxy }) => Math.hypot(finger!.x - proxy!.x, finger!.y - proxy!.y, finger!.z - proxy!.z),
  ));
  const height_m = () => page.evaluate((number) => window.__hl.originOf(number).y, kBlock);

  /** Drags the chosen hand to a place at the depth where it is, with the button down, until it is there. */
  async function lead(device: number, to: { x: number; y: number }): Promise<void> {
    const { z } = await finger(device);
    const pixel = await pixelOf({ ...to, z });
    await page.mouse.move(pixel.x, pixel.y, { steps: 5 });
    await expect.poll(async () => length(sub(await finger(device), { ...to, z }))).toBeLessThan(kNear_m);
  }

  /** Brings the chosen hand beside the block and presses it, `side` -1: from the left; leaves it there. */
  async function press(device: number, side: -1 | 1, goal_x_m: number): Promise<void> {
    const begin = await pixelOf(await finger(device));
    await page.mouse.move(begin.x, begin.y);
    await page.mouse.down();
    await lead(device, { x: side * kAside_m, y: 2 * kAside_m });
    await lead(device, { x: side * kAside_m, y: kHalf_m });
    const { z } = await finger(device);
    const goal = await pixelOf({ x: goal_x_m, y: kHalf_m, z });
    await page.mouse.move(goal.x, goal.y, { steps: 5 });
    await expect.poll(async () => (await touching())[device]).toBe(true);
    await page.mouse.up();
  }

  test("each comes to its side, and presses there when the mouse has left it", async () => {
    await page.click("label:has(#grip-firm)");
    await press(0, -1, -kHalf_m);
    await page.keyboard.press("h");
    await press(1, 1, 0);
    await expect.poll(async () => Math.min(...await springs_m())).toBeGreaterThan(kPressed_m);
  });

  test("together they lift it", async () => {
    await page.keyboard.press("a");
    await page.keyboard.down("ArrowUp");
    await expect.poll(height_m).toBeGreaterThan(2 * kHalf_m);
    await page.keyboard.up("ArrowUp");
    await states(page, 60);
    expect(await touching()).toEqual([true, true]);
    expect(await height_m()).toBeGreaterThan(2 * kHalf_m);
    await screenshot(page, "two_devices");
    for (const size of kSizes) await expectTidyLayout(page, size);
  });

  test("the page has complained of nothing", () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign).toEqual([]);
  });
});
