// Clouds of points on the page, against a real server: they are drawn, and felt where they are pressed.

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { kSizes, launch, listen, screenshot, states, type Complaints } from "./browser";
import { kProgram, startTouch, type Touch } from "./programs";

describe.skipIf(!kProgram)("a cloud of surfels", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    touch = await startTouch(0, "../scenes/examples/clouds.hl.json", "--explore", "off");
    browser = await launch();
    page = await browser.newPage({ viewport: kSizes[0], colorScheme: "dark" });
    complaints = listen(page, touch.url);
    await page.goto(touch.url);
    await page.waitForFunction(() => window.__hl.objects === 3 && window.__hl.samples > 100);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGKILL");
  });

  test("is felt where it is pressed", async () => {
    const at = await page.evaluate(() => window.__hl.project({ x: 0.12, y: 0.01, z: 0.05 }));
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.waitForFunction(() => window.__hl.contacts > 0);
    await states(page, 10);
    await screenshot(page, "clouds");
    await page.mouse.up();
    expect(complaints.errors).toEqual([]);
  });
});
