// Two devices, end to end: the page names both, shows the state and the force of each, and both hands in the scene.

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { expectTidyLayout, kSizes, launch, listen, screenshot, type Complaints } from "./browser";
import { ended, kProgram, startTouch, type Touch } from "./programs";

describe.skipIf(!kProgram)("hl touch with two devices", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    touch = await startTouch(0, "teapot", "--device", "left=sim:touch", "--device", "right=sim:premium1.5");
    browser = await launch();
    page = await browser.newPage({ viewport: kSizes[0] });
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
    await page.uncheck("#explore");  // the right hand goes on
    await screenshot(page, "two_devices");
    for (const size of kSizes) await expectTidyLayout(page, size);
  });

  test("the page has complained of nothing", () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign).toEqual([]);
  });
});
