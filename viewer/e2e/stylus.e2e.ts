// The stylus, end to end: `hl touch` and its page in a real browser. Held with Q the pointer turns it in place of moving
// the hand; G opens the gripper of a device that has one. HL_BIN names the `hl` program.

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { kWindow, launch, listen, screenshot, turnWheel, type Complaints } from "./browser";
import { kProgram, startTouch, type Touch } from "./programs";

const shaftUp = (page: Page) => page.evaluate(() => {
  const [x, y, z, w] = window.__hl.stylus! as [number, number, number, number];
  return 2 * (y * z - w * x);
});

describe.skipIf(!kProgram)("the stylus of a device with a wrist and a gripper", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    touch = await startTouch(0, "teapot", "--device", "sim:omega7");
    browser = await launch();
    page = await browser.newPage({ ...kWindow, colorScheme: "light" });
    complaints = listen(page, touch.url);
    await page.goto(touch.url);
    await page.waitForFunction(() => window.__hl.triangles > 0 && window.__hl.stylus !== undefined);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGKILL");
  });

  test("begins as a hand holds a pen at rest", async () => {
    expect(await shaftUp(page)).toBeCloseTo(Math.sin((35 * Math.PI) / 180), 2);
  });

  test("turns upright with the pointer while Q is held, and the hand goes on", async () => {
    const { x, y } = { x: 400, y: 300 };
    await page.mouse.move(x, y);
    await page.keyboard.down("q");
    for (let i = 1; i <= 10; ++i) await page.mouse.move(x, y - 20 * i);
    await page.waitForFunction(() => {
      const [a, b, c, d] = window.__hl.stylus! as [number, number, number, number];
      return Math.abs(2 * (b * c - d * a) - Math.sin((35 * Math.PI) / 180)) > 0.2;
    });
    await page.keyboard.up("q");
    expect(await page.evaluate(() => window.__hl.exploring)).toBe(true);
    await screenshot(page, "stylus_turned");
  });

  test("rolls about its shaft with the wheel, and turns by keys", async () => {
    const before = await page.evaluate(() => window.__hl.stylus!);
    await page.keyboard.down("q");
    await turnWheel(page, 400);
    for (let i = 0; i < 6; ++i) await page.keyboard.press("ArrowRight");
    await page.waitForFunction((was) => {
      const dot = window.__hl.stylus!.reduce((sum, part, i) => sum + part * was[i]!, 0);
      return 2 * Math.acos(Math.min(1, Math.abs(dot))) > 0.4;
    }, before);
    await page.keyboard.up("q");
  });

  test("opens its gripper with G", async () => {
    await page.keyboard.press("g");
    await page.waitForFunction(() => window.__hl.gripper_rad! > 0.4);
    await screenshot(page, "stylus_gripper");
    await page.keyboard.press("g");
    await page.waitForFunction(() => window.__hl.gripper_rad! < 0.05);
  });

  test("is hidden with Y, without a complaint of the page", async () => {
    await page.keyboard.press("y");
    expect(await page.isChecked("#stylus")).toBe(false);
    await screenshot(page, "stylus_hidden");
    expect(complaints.errors).toEqual([]);
  });
});
