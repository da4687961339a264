// Two devices, end to end: the page names both, shows the state and the force of each, and both hands in the scene; it moves
// the one that is chosen, and both together.

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { length, sub, type Vec } from "../src/vec";
import { expectTidyLayout, kSizes, kWindow, launch, listen, screenshot, states, type Complaints } from "./browser";
import { ended, kProgram, startTouch, type Touch } from "./programs";

describe.skipIf(!kProgram)("hl touch with two devices", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    touch = await startTouch(0, "teapot", "--device", "left=sim:touch", "--device", "right=sim:premium1.5");
    browser = await launch();
    page = await browser.newPage(kWindow);
    complaints = listen(page, touch.url);
    await page.goto(touch.url);
  });
  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGTERM");
    if (touch) expect(await ended(touch.process)).toBe(0);
  });

  test("each has a row with its name, its state and its force", async () => {
    await page.waitForSelector("#devices:not([hidden])");
    await expect.poll(() => page.locator("#device-list .safety-state").allTextContents()).toEqual(["left", "right"]);
    await expect.poll(() => page.locator('#device-list [data-safety="ON"]').count()).toBe(2);
    await expect.poll(() => page.locator("#device-list output").allTextContents()).toEqual(
      [expect.stringMatching(/^[0-9.]+\sN$/), expect.stringMatching(/^[0-9.]+\sN$/)],
    );
    expect(await page.locator("#device-list .safety-state").nth(1).getAttribute("title")).toContain("Premium 1.5");
    expect(await page.textContent("#device")).toBe("left: simulated 3D Systems Touch");
    expect(await page.textContent("#force-of")).toBe("Force on the hand: left");
    await page.uncheck("#explore");  // the right hand goes on
    await page.click("#device-list .move >> nth=1");
    expect(await page.textContent("#explore-text")).toBe("Explore by itself: right");
    for (const size of kSizes) await expectTidyLayout(page, size);
  });

  test("the page has complained of nothing", () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign).toEqual([]);
  });
});

/** A hand moves at 0.3 m/s at most, and has come to rest when it moves less than this between states. */
const kStill_m = 1e-4;
const kFar_m = 0.02;
const kNear_m = 0.002;
/** Farther than kFar_m at the hand's depth. */
const kDrag_px = 60;

describe.skipIf(!kProgram)("two hands that the page moves", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    touch = await startTouch(0, "teapot", "--device", "left=sim", "--device", "right=sim", "--explore", "off");
    browser = await launch();
    page = await browser.newPage(kWindow);
    complaints = listen(page, touch.url);
    await page.goto(touch.url);
    await page.waitForSelector("#devices:not([hidden])");
  });
  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGTERM");
  });

  const fingers = () => page.evaluate(() => window.__hl.hands.map(({ finger }) => finger!)) as Promise<[Vec, Vec]>;

  /** Where both fingers are when they have come to rest. */
  async function atRest(): Promise<[Vec, Vec]> {
    for (let last = await fingers(); ; ) {
      await states(page, 10);
      const now = await fingers();
      if (now.every((finger, i) => length(sub(finger, last[i]!)) < kStill_m)) return now;
      last = now;
    }
  }

  /** How far each hand went while `act` moved some, when both have come to rest. */
  async function moved(act: (before: readonly Vec[]) => Promise<void>): Promise<[Vec, Vec]> {
    const before = await atRest();
    await act(before);
    const after = await atRest();
    return [sub(after[0], before[0]), sub(after[1], before[1])];
  }

  /** Taps a key until the hand has gone far. */
  const byKey = (key: string, device: 0 | 1) => moved(async (before) => {
    await expect.poll(async () => {
      await page.keyboard.press(key, { delay: 50 });
      return length(sub((await fingers())[device], before[device]!));
    }).toBeGreaterThan(kFar_m);
  });

  /** Drags the right hand up. */
  const byPointer = () => moved(async ([, right]) => {
    const from = await page.evaluate((finger) => window.__hl.project(finger), right!);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x, from.y - kDrag_px, { steps: 6 });
    await page.mouse.up();
  });

  const pressed = () => page.locator("#device-list .move").evaluateAll(
    (buttons) => buttons.map((button) => button.getAttribute("aria-pressed")),
  );

  test("the first hand moves until another is chosen", async () => {
    expect(await pressed()).toEqual(["true", "false"]);
    const [left, right] = await byKey("ArrowLeft", 0);
    expect(length(left)).toBeGreaterThan(kFar_m);
    expect(length(right)).toBeLessThan(kNear_m);
  });

  test("the second hand moves when it is chosen, by keys and by the pointer, and the first stays", async () => {
    await page.click("#device-list .move >> nth=1");
    expect(await pressed()).toEqual(["false", "true"]);
    const [left, right] = await byKey("ArrowRight", 1);
    expect(length(right)).toBeGreaterThan(kFar_m);
    expect(length(left)).toBeLessThan(kNear_m);
    const [stayed, dragged] = await byPointer();
    expect(length(dragged)).toBeGreaterThan(kFar_m);
    expect(length(stayed)).toBeLessThan(kNear_m);
  });

  test("a key chooses the next hand", async () => {
    await page.keyboard.press("h");
    expect(await pressed()).toEqual(["true", "false"]);
    await page.keyboard.press("h");
    expect(await pressed()).toEqual(["false", "true"]);
  });

  test("all together go the same way", async () => {
    await page.keyboard.press("a");
    expect(await page.getAttribute("#together", "aria-pressed")).toBe("true");
    const [left, right] = await byPointer();
    expect(length(left)).toBeGreaterThan(kFar_m);
    expect(length(sub(left, right))).toBeLessThan(kNear_m);
    await screenshot(page, "two_hands_together");
  });

  test("the page has complained of nothing", () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign).toEqual([]);
  });
});
