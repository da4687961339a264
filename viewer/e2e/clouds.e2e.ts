// Clouds of points on the page, against a real server: they are drawn, and felt where they are pressed.

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { kWindow, launch, listen, pressModel, screenshot, states, untilTouched, type Complaints } from "./browser";
import { kProgram, startTouch, type Touch } from "./programs";

/** Red, green and blue of the page at a place of its window. */
async function colourAt(page: Page, { x, y }: { x: number; y: number }): Promise<number[]> {
  const clip = { x: Math.round(x), y: Math.round(y), width: 1, height: 1 };
  const png = (await page.screenshot({ clip })).toString("base64");
  return page.evaluate(async (data) => {
    const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const context = new OffscreenCanvas(1, 1).getContext("2d")!;
    context.drawImage(bitmap, 0, 0);
    return Array.from(context.getImageData(0, 0, 1, 1).data.slice(0, 3));
  }, png);
}

describe.skipIf(!kProgram)("a cloud of surfels", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    touch = await startTouch(0, "../scenes/examples/clouds.hl.json", "--explore", "off");
    browser = await launch();
    page = await browser.newPage({ ...kWindow, colorScheme: "dark" });
    complaints = listen(page, touch.url);
    await page.goto(touch.url);
    await page.waitForFunction(() => window.__hl.objects === 3 && window.__hl.samples > 100);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGKILL");
  });

  test("shows the colours of its points", async () => {
    // Stones of clouds.hl.json: yellow with more red, green, blue.
    const stones = [{ x: -0.03, y: -0.07, z: 0 }, { x: 0.03, y: -0.07, z: 0 }, { x: 0, y: -0.06, z: 0.03 }];
    const colours = [];
    for (const stone of stones) {
      const at = await page.evaluate((place) => window.__hl.project(place), stone);
      colours.push(await colourAt(page, at));
    }
    expect(colours.map((colour) => colour.indexOf(Math.max(...colour)))).toEqual([0, 1, 2]);
    const spread = (colour: number[]) => Math.max(...colour) - Math.min(...colour);
    const ball = await page.evaluate(() => window.__hl.project({ x: 0.12, y: 0, z: 0.05 }));
    expect(Math.min(...colours.map(spread))).toBeGreaterThan(spread(await colourAt(page, ball)) + 30);
  });

  test("is felt where it is pressed", async () => {
    const at = await page.evaluate(() => window.__hl.project({ x: 0.12, y: 0.01, z: 0.05 }));
    await pressModel(page, at);
    await untilTouched(page);
    await states(page, 10);
    await screenshot(page, "clouds");
    await page.mouse.up();
    expect(complaints.errors).toEqual([]);
  });
});
