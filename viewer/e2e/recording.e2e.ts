// Recordings on the page, against the real `hl`: recorded by a button, run again by hl replay, shown on the timeline;
// and the scene saved as a file that hl trace feels. HL_BIN names the program; without it these tests are skipped.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, BrowserContext, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, modelPixels, openSection, resize, screenshot, states, type Complaints,
} from "./browser";
import { ended, kProgram, startTouch, type Touch } from "./programs";

const kPhone = { width: 390, height: 844 };

describe.skipIf(!kProgram)("recordings and scene files", () => {
  const folder = mkdtempSync(join(tmpdir(), "hl-e2e-"));
  const recordingFile = join(folder, "session.hlr");
  let touch: Touch;
  let browser: Browser;
  let context: BrowserContext;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    touch = await startTouch(0, "teapot", "--black-box", "off");
    browser = await launch();
    context = await browser.newContext({ ...kWindow, colorScheme: "dark", acceptDownloads: true });
    page = await context.newPage();
    complaints = listen(page, touch.url);
    await page.goto(touch.url);
    await page.waitForFunction(() => window.__hl.samples > 50 && window.__hl.triangles > 0);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGTERM");
    expect(await ended(touch.process)).toBe(0);
    rmSync(folder, { recursive: true });
  });

  const hl = (...words: string[]) => execFileSync(kProgram!, words, { encoding: "utf8" });
  const recordOf = (target: Page) => target.evaluate(() => document.getElementById("record")!.click());
  const recordLine = (target: Page) => target.textContent("#record-told");
  const shown = (target: Page) => target.evaluate(() => window.__hl.recording);
  const frames = (count: number) => page.evaluate(async (wanted) => {
    for (let i = 0; i < wanted; ++i) await new Promise((resolve) => requestAnimationFrame(resolve));
  }, count);
  type Given = Parameters<Page["setInputFiles"]>[1];
  const choose = (file: Given) => page.setInputFiles("#file", file);

  test("records the session, notifies other pages, and hl replay runs the file again bit for bit", async () => {
    const other = await context.newPage();
    await other.goto(touch.url);
    await other.waitForFunction(() => window.__hl.samples > 10);
    await openSection(page, "more");
    await recordOf(page);
    await expect.poll(() => recordLine(page)).toMatch(/^Recording: [2-9]/);
    expect(await page.textContent("#record")).toBe("Stop recording");
    await expect.poll(() => recordLine(other)).toMatch(/^Another page records: /);
    expect(await other.isDisabled("#record")).toBe(true);
    await other.close();
    await screenshot(page, "recording_runs");
    const [download] = await Promise.all([page.waitForEvent("download"), recordOf(page)]);
    expect(download.suggestedFilename()).toMatch(/^teapot-.*\.hlr$/);
    await download.saveAs(recordingFile);
    const report = hl("replay", recordingFile);
    expect(report).toContain("reproduced: bit for bit");
    expect(report).toContain("ended:      stopped");
    expect(report).not.toContain("missing");
    await expect.poll(() => page.textContent("#notices")).toContain("The recording is saved (stopped)");
    await page.click("#notices button");
    const metrics = await (await page.request.get(`${touch.url}metrics`)).text();
    expect(metrics).toMatch(/^hl_page_recordings_total 1$/m);
  });

  test("a page that goes away ends its recording, and nobody else gets it", async () => {
    const other = await context.newPage();
    await other.goto(touch.url);
    await other.waitForFunction(() => window.__hl.samples > 10);
    await recordOf(other);
    await expect.poll(() => recordLine(page)).toMatch(/^Another page records/);
    await other.close();
    await expect.poll(() => recordLine(page)).toBe("");
    expect(await page.isEnabled("#record")).toBe(true);
    expect((await page.request.get(`${touch.url}recording.hlr?owner=1`)).status()).toBe(404);
  });

  test("shows a recording on the timeline, and goes back to the live session", async () => {
    const proxy = () => page.evaluate(() => window.__hl.proxy);
    const eye = () => page.evaluate(() => [0, 0.05].map((y) => window.__hl.project({ x: 0.01, y, z: 0.02 })));
    await page.mouse.move(600, 560);
    await page.mouse.down({ button: "right" });
    await page.mouse.move(660, 540, { steps: 4 });
    await page.mouse.up({ button: "right" });
    let turned = await eye();
    for (let last: typeof turned = []; JSON.stringify(last) !== JSON.stringify(turned); ) {
      await frames(10);
      [last, turned] = [turned, await eye()];
    }
    await choose(recordingFile);
    await page.waitForSelector("#timeline:visible");
    const { begin_s, end_s } = (await shown(page))!;
    const [length_s, middle_s] = [end_s - begin_s, (begin_s + end_s) / 2];
    expect(length_s).toBeGreaterThan(1);
    expect(await page.isVisible("#plot-force")).toBe(false);
    await page.waitForFunction(() => window.__hl.triangles > 0 && window.__hl.proxy !== undefined);
    await expect.poll(() => modelPixels(page)).toBeGreaterThan(0.02);
    const still = await proxy();
    await frames(10);
    expect(await proxy()).toEqual(still);
    // The slider has the focus: keys move it, and it says where it is.
    const slider = page.getByRole("slider", { name: "Time in the recording" });
    await page.keyboard.press("End");
    await page.waitForFunction((end) => window.__hl.recording!.time_s > end - 0.02, end_s);
    expect(await slider.getAttribute("aria-valuetext")).toMatch(/^\d+\.\d\d\ss of \d+\.\d\d\ss$/);
    await expect.poll(proxy).not.toEqual(still);
    await page.keyboard.press("Home");
    await expect.poll(proxy).toEqual(still);
    await page.keyboard.press(" ");
    await page.waitForFunction(() => window.__hl.recording!.playing && window.__hl.recording!.time_s > 0.3);
    await page.keyboard.press(" ");
    expect((await shown(page))!.playing).toBe(false);
    const plot = (await page.locator("#plot-recorded-force").boundingBox())!;
    await page.mouse.click(plot.x + 52 + (plot.width - 68) / 2, plot.y + plot.height / 2);
    await expect.poll(async () => Math.abs((await shown(page))!.time_s - middle_s) < 0.05 * length_s).toBe(true);
    await page.click("text=¼×");
    await page.click("#timeline-play");
    await page.waitForFunction((half) => window.__hl.recording!.time_s > half + 0.05, middle_s);
    await page.click("#timeline-play");
    await page.keyboard.press("Escape");
    await page.waitForSelector("#plot-force:visible");
    expect(await shown(page)).toBeUndefined();
    await states(page, 5);
    expect(await page.evaluate(() => [window.__hl.link, window.__hl.triangles > 0, window.__hl.sceneName]))
      .toEqual(["live", true, "teapot"]);
    (await eye()).forEach(({ x, y }, i) => {
      expect(Math.hypot(x - turned[i]!.x, y - turned[i]!.y)).toBeLessThan(1);
    });
    await page.keyboard.press("r");
  });

  test("the timeline has the times and forces of hl replay's table", async () => {
    const table = join(folder, "steps.csv");
    hl("replay", recordingFile, "--csv", table);
    const [head, ...lines] = readFileSync(table, "utf8").trim().split("\n");
    const columns = ["t", "force_x", "force_y", "force_z"].map((name) => head!.split(",").indexOf(name));
    const rows = lines.map((line) => line.split(",")).map((cells) => columns.map((column) => Number(cells[column])));
    await choose(recordingFile);
    await page.waitForSelector("#timeline:visible");
    const { begin_s, end_s } = (await shown(page))!;
    // A CSV has all digits of a double, and the page computes with other roundings.
    expect(begin_s).toBeCloseTo(rows[0]![0]!, 8);
    expect(end_s).toBeCloseTo(rows.at(-1)![0]!, 8);
    for (const share of [0.3, 0.7]) {
      await page.evaluate((to) => {
        const slider = document.getElementById("timeline-at") as HTMLInputElement;
        slider.value = String(to);
        slider.dispatchEvent(new Event("input"));
      }, begin_s + share * (end_s - begin_s));
      await frames(3);
      const { time_s, force } = await page.evaluate(() => ({
        time_s: window.__hl.recording!.time_s, force: window.__hl.force_N!,
      }));
      const row = rows.filter(([t]) => t! <= time_s).at(-1)!;
      // The page keeps single precision.
      [force.x, force.y, force.z].forEach((value, i) => expect(value).toBeCloseTo(row[i + 1]!, 5));
    }
    await page.keyboard.press("Escape");
  });

  test("while a recording is shown the hand is not driven, and the live scene goes on", async () => {
    await page.evaluate(() => document.getElementById("explore")!.click());
    await page.waitForFunction(() => !window.__hl.exploring);
    await states(page, 20);
    const finger = await page.evaluate(() => window.__hl.finger!);
    await choose(recordingFile);
    await page.waitForSelector("#timeline:visible");
    await page.locator("#canvas").focus();
    await page.keyboard.down("ArrowUp");
    await page.keyboard.press("e");
    await page.mouse.move(600, 300);
    await page.mouse.down();
    await page.mouse.move(660, 260, { steps: 5 });
    expect(await page.evaluate(() => window.__hl.holding)).toBe(false);
    await page.mouse.up();
    await page.keyboard.up("ArrowUp");
    await page.click("#timeline-close");
    await page.waitForFunction(() => window.__hl.time_s !== undefined && window.__hl.recording === undefined);
    await states(page, 3);
    const now = await page.evaluate(() => window.__hl);
    expect(now.exploring).toBe(false);
    expect(Math.hypot(now.finger!.x - finger.x, now.finger!.y - finger.y, now.finger!.z - finger.z)).toBeLessThan(1e-3);
  });

  test("a broken or foreign file is refused in one line, and nothing changes", async () => {
    const good = readFileSync(recordingFile);
    const cut = good.subarray(0, 4);
    const foreign = Buffer.from("solid cube\nendsolid\n");
    const first = Buffer.concat([Buffer.from("HLREC1\r\n"), good.subarray(8)]);
    for (const [buffer, line] of [
      [cut, "broken.hlr is no recording of HL."], [foreign, "broken.hlr is no recording of HL."],
      [Buffer.concat([good.subarray(0, 8), Buffer.alloc(400)]), "broken.hlr is cut short: nothing of it can be read."],
      [first, "broken.hlr is a recording of form 1, and this page reads form 2: use the version of HL that made it."],
    ] as const) {
      await choose({ name: "broken.hlr", mimeType: "", buffer });
      await expect.poll(() => page.textContent("#notices .bad span")).toBe(line);
      await page.click("#notices .bad button");
      expect(await shown(page)).toBeUndefined();
    }
    expect(await page.evaluate(() => window.__hl.link)).toBe("live");
  });

  test("a file that is cut short shows what is good of it", async () => {
    const good = readFileSync(recordingFile);
    await choose({ name: "cut.hlr", mimeType: "", buffer: good.subarray(0, Math.floor(0.7 * good.length)) });
    await page.waitForSelector("#timeline:visible");
    expect(await page.textContent("#recorded-origin")).toMatch(/ended: its last \d+ bytes are cut short or damaged/);
    await page.keyboard.press("Escape");
  });

  test("the timeline is tidy at each size, dark and light", async () => {
    await choose(recordingFile);
    await page.waitForSelector("#timeline:visible");
    await page.locator("#timeline-at").fill("1");
    for (const scheme of ["dark", "light"] as const) {
      await page.emulateMedia({ colorScheme: scheme });
      for (const size of kSizes) {
        await expectTidyLayout(page, size);
        await screenshot(page, `timeline_${scheme}_${size.width}`);
      }
      await resize(page, kPhone);
      await screenshot(page, `timeline_${scheme}_phone`);
    }
    await resize(page, kSizes[0]);
    await page.emulateMedia({ colorScheme: "dark" });
    await page.keyboard.press("Escape");
    await openSection(page, "more");
    await screenshot(page, "more_open");
  });

  test("the scene is saved with the material that is felt, and hl trace feels the same", async () => {
    const set = (id: string, value: number) => page.evaluate(([name, to]) => {
      const slider = document.getElementById(name!) as HTMLInputElement;
      slider.value = String(to);
      slider.dispatchEvent(new Event("input"));
    }, [id, value] as const);
    await set("surface-stiffness", 0.5);
    await set("surface-static-friction", 0.6);
    await set("surface-dynamic-friction", 0.4);
    await page.waitForFunction(() => window.__hl.surfaces.dynamicFriction === 0.4);
    await openSection(page, "more");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-scene")]);
    expect(download.suggestedFilename()).toMatch(/^teapot-.*\.hl\.json$/);
    const file = join(folder, "saved.hl.json");
    await download.saveAs(file);
    expect(hl("info", file)).toMatch(/3 ?408/);
    const path = join(folder, "path.csv");
    // Down onto the lid, and along it.
    const rows = Array.from({ length: 1500 }, (_, i) =>
      `${1e-3 * i},${3e-5 * Math.max(0, i - 800)},${Math.max(0.044, 0.06 - 2e-5 * i)},${1e-5 * Math.max(0, i - 800)}`);
    writeFileSync(path, `t,x,y,z\n${rows.join("\n")}\n`);
    const traced = (...words: string[]) => {
      const out = join(folder, "out.csv");
      hl("trace", ...words, "--path", path, "--out", out);
      const [head, ...lines] = readFileSync(out, "utf8").trim().split("\n");
      const first = head!.split(",").indexOf("force_x");
      return lines.map((line) => line.split(",").slice(first, first + 3).map(Number));
    };
    const surfaces = ["--stiffness", "0.5", "--static-friction", "0.6", "--dynamic-friction", "0.4"];
    const theirs = traced("teapot", ...surfaces, "--shade", "smooth");
    const ours = traced(file, "--shade", "smooth");
    expect(Math.max(...theirs.flat().map(Math.abs))).toBeGreaterThan(0.5);
    // A float has 24 bits: of coordinates of 0.1 m, 6e-9 m, and at 1000 N/m 6e-6 N.
    const apart = ours.map((force, i) => Math.hypot(...force.map((value, k) => value - theirs[i]![k]!)));
    expect(Math.max(...apart)).toBeLessThan(1e-4);
  });

  test("no console errors, and nothing from outside addresses", () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign.filter((url) => !url.startsWith(`blob:${touch.url.slice(0, -1)}`))).toEqual([]);
  });
});
