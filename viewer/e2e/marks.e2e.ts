// What is felt and not seen is drawn: snaps, the one that holds the proxy, fields, joints.

import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, openSection, screenshot, states, type Complaints,
} from "./browser";
import { kProgram, startTouch, type Touch } from "./programs";

/** The socket of the scene `snaps`, m: it is the first snap. */
const kSocket = { x: -0.09, y: 0.028, z: -0.05 };

describe.skipIf(!kProgram)("hl touch snaps", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;
  const folder = mkdtempSync(join(tmpdir(), "hl-e2e-"));

  beforeAll(async () => {
    const path = join(folder, "path.csv");
    const { x, y, z } = kSocket;
    writeFileSync(path, `t,x,y,z\n0,${x},${y + 0.05},${z}\n1,${x},${y},${z}\n2,${x + 0.001},${y},${z}\n`);
    touch = await startTouch(0, "snaps", "--hand-path", path);
    browser = await launch();
    page = await browser.newPage({ ...kWindow, colorScheme: "dark" });
    complaints = listen(page, touch.url);
    await page.goto(touch.url);
    await page.waitForFunction(() => window.__hl.objects === 3 && window.__hl.samples > 100);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGKILL");
    rmSync(folder, { recursive: true });
  });

  /** The picture about a place, without what the cards cover. */
  async function pictureAt(place: { x: number; y: number; z: number }): Promise<Buffer> {
    const { x, y } = await page.evaluate((at) => window.__hl.project(at), place);
    return page.screenshot({ clip: { x: x - 20, y: y - 20, width: 40, height: 40 } });
  }

  test("says which snap holds the proxy", async () => {
    await page.waitForFunction(() => window.__hl.snap === 0);
  });

  test("draws them, in both themes, and its key J takes them away", async () => {
    await states(page, 5);
    await screenshot(page, "marks_snaps");
    const kFarSocket = { ...kSocket, x: -0.06 };
    const drawn = await pictureAt(kFarSocket);
    await page.keyboard.press("j");
    await states(page, 5);
    expect((await pictureAt(kFarSocket)).equals(drawn)).toBe(false);
    expect(await page.isChecked("#marks")).toBe(false);
    await page.keyboard.press("j");
    await states(page, 5);
    expect((await pictureAt(kFarSocket)).equals(drawn)).toBe(true);
    await openSection(page, "view");
    await page.click("label:has(input[name=theme][value=light])");
    await screenshot(page, "marks_snaps_light");
    await page.click("label:has(input[name=theme][value=system])");
  });

  test("has them in the key, in cards that fit", async () => {
    await page.click("#key > summary");
    for (const size of kSizes) await expectTidyLayout(page, size);
    await page.click("#key > summary");
  });

  test("keeps them in the saved scene", async () => {
    await openSection(page, "more");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-scene")]);
    const file = join(folder, "saved.hl.json");
    await download.saveAs(file);
    const infoOf = (scene: string) => execFileSync(kProgram!, ["info", scene], { encoding: "utf8" })
      .split("\n").filter((line) => /^(snap|field)/.test(line));
    const begin = infoOf("snaps");
    expect(begin).toHaveLength(8);
    expect(infoOf(file)).toEqual(begin);
  });

  test("draws the joints of the workshop", async () => {
    const shop = await startTouch(0, "workshop", "--explore", "off");
    const other = await browser.newPage({ viewport: kSizes[1], colorScheme: "dark" });
    const heard = listen(other, shop.url);
    await other.goto(shop.url);
    await other.waitForFunction(() => window.__hl.objects > 10 && window.__hl.samples > 100);
    await screenshot(other, "marks_workshop");
    expect(heard.errors).toEqual([]);
    await other.close();
    shop.process.kill("SIGKILL");
  });

  test("without an error, and without asking anybody else", () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign).toEqual([]);
  });
});
