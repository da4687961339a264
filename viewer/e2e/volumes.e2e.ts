// The iso value of a volume changes while its surface is touched: the slider of the page against a real server.

import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, test } from "vitest";
import { kWindow, launch, listen, pressModel, screenshot, states, untilTouched, type Complaints } from "./browser";
import { kProgram, startTouch, type Touch } from "./programs";

describe.skipIf(!kProgram)("the slider of a volume", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    touch = await startTouch(0, "ct:phantom:81", "--explore", "off");
    browser = await launch();
    page = await browser.newPage({ ...kWindow, colorScheme: "dark" });
    complaints = listen(page, touch.url);
    await page.goto(touch.url);
    await page.waitForFunction(() => window.__hl.objects === 2 && window.__hl.samples > 100);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGKILL");
  });

  afterEach(() => page.mouse.up());

  const layout = () => page.evaluate(() => window.__hl.layout!);
  const setIso = async (value: number) => {
    const before = await layout();
    await page.fill("#iso-1", String(value));
    await page.waitForFunction((old) => window.__hl.layout! > old, before);
    await states(page, 60);
  };

  test("reaches over the values of the volume", async () => {
    expect(await page.inputValue("#iso-1")).toBe("-480");
    expect(await page.inputValue("#iso-2")).toBe("370");
    expect(await page.textContent("label[for=iso-1] output")).toContain("HU");
    expect(await page.textContent("label[for=iso-1] span")).toBe("Iso value of skin");
    expect(await page.textContent("label[for=iso-2] span")).toBe("Iso value of bone");
  });

  test("moves the surface under the hand, from skin to bone and back", async () => {
    const at = await page.evaluate(() => window.__hl.project({ x: 0, y: 0.02, z: 0.05 }));
    await pressModel(page, at);
    await untilTouched(page);
    await states(page, 60);
    const onSkin = await page.evaluate(() => window.__hl.proxy!);
    await screenshot(page, "volume_skin");
    await setIso(300);
    await screenshot(page, "volume_bone");
    await setIso(-480);
    await untilTouched(page);
    const again = await page.evaluate(() => window.__hl.proxy!);
    expect(Math.hypot(again.x - onSkin.x, again.y - onSkin.y, again.z - onSkin.z)).toBeLessThan(0.02);
    expect(await page.evaluate(() => window.__hl.safety)).toBe("ON");
  });

  test("has its matter on either side of the value", async () => {
    expect(await page.isChecked("#below-1")).toBe(false);
    const before = await layout();
    await page.check("#below-1");
    await page.waitForFunction((old) => window.__hl.layout! > old, before);
    await page.reload();
    await page.waitForFunction(() => window.__hl.objects === 2);
    expect(await page.isChecked("#below-1")).toBe(true);
    expect(await page.isChecked("#below-2")).toBe(false);
    await page.uncheck("#below-1");
  });

  test("keeps its value when the page is loaded again", async () => {
    await setIso(-600);
    await page.reload();
    await page.waitForFunction(() => window.__hl.objects === 2);
    expect(await page.inputValue("#iso-1")).toBe("-600");
    expect(complaints.errors).toEqual([]);
  });
});
