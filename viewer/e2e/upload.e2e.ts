// A file of the user's in the place of the scene, against a real server: chosen and dropped, good and bad, and felt.

import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, test } from "vitest";
import { fileOf, kWhole } from "../test-support/recording_bytes";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, openSection, pressModel, resize, screenshot, states, untilTouched,
  type Complaints,
} from "./browser";
import { boxObj, drop } from "./files";
import { kProgram, startTouch, type Touch } from "./programs";
import { zipBomb } from "./zip_bomb";

const kPhone = { width: 390, height: 844 };

describe.skipIf(!kProgram)("a file of the user's", () => {
  const folder = mkdtempSync(join(tmpdir(), "hl-upload-"));
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    touch = await startTouch(0);
    browser = await launch();
    page = await browser.newPage({ ...kWindow, colorScheme: "dark" });
    complaints = listen(page, touch.url);
    await page.goto(touch.url);
    await page.waitForFunction(() => window.__hl.triangles > 0 && window.__hl.samples > 100);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGKILL");
  });

  afterEach(() => page.mouse.up());

  const lastNotice = () => page.locator(".notice.told span").last().textContent();

  async function choose(name: string, content: string): Promise<void> {
    const file = join(folder, name);
    writeFileSync(file, content);
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#open-file")]);
    await chooser.setFiles(file);
  }

  test("is cancelled while it is sent; what was open still is, and another one can be given", async () => {
    const network = await page.context().newCDPSession(page);
    const send = (uploadThroughput: number) => network.send("Network.emulateNetworkConditions",
      { offline: false, latency: 0, downloadThroughput: -1, uploadThroughput });
    await network.send("Network.enable");
    await send(50_000);
    const scene = await page.evaluate(() => window.__hl.sceneName);
    await choose("slow.obj", `${boxObj(4, 2, 3)}${"# long\n".repeat(300_000)}`);
    await page.click(".notice .cancel");
    await expect.poll(lastNotice).toBe("slow.obj is not opened: cancelled.");
    await send(-1);
    expect(await page.locator('.notice[data-cause="file"]').count()).toBe(0);
    expect(await page.evaluate(() => window.__hl.sceneName)).toBe(scene);
  });

  test("is chosen, becomes the scene, fits the view and is felt where it is pressed", async () => {
    await choose("box.obj", boxObj(4, 2, 3));
    await page.waitForFunction(() => window.__hl.sceneName === "box.obj" && window.__hl.triangles === 12);
    await expect.poll(lastNotice).toMatch(/^box\.obj: 12 triangles; 1.mm of the hand is 33\.3.mm of the scene\.$/);
    await page.uncheck("#explore");
    const { low, high, middle } = await page.evaluate(() => {
      const { boundsMin: low, boundsMax: high } = window.__hl;
      return { low: window.__hl.project(low!), high: window.__hl.project(high!),
        middle: window.__hl.project({ x: 2, y: 1, z: 3 }) };
    });
    const onCanvas = (at: { x: number; y: number }) => at.x > 0 && at.x < 1280 && at.y > 0 && at.y < 720;
    expect(onCanvas(low) && onCanvas(high), "the box is in view").toBe(true);
    expect(Math.hypot(high.x - low.x, high.y - low.y), "and fills it").toBeGreaterThan(200);
    await pressModel(page, middle);
    await untilTouched(page, 0.2);
    await states(page, 60);
    const { proxy, force_N, contacts } = await page.evaluate(() => window.__hl);
    expect(contacts).toBe(1);
    expect(proxy!.z, "the proxy is outside of the box").toBeGreaterThan(3);
    expect(force_N!.z, "and its force points out").toBeGreaterThan(0.2);
    await screenshot(page, "upload_chosen");
    await page.mouse.up();
  });

  test("is dropped; what it names beside it is left out in a line; a section of what was there is ended", async () => {
    await openSection(page, "view");
    await page.selectOption("#section", "front");
    await drop(page, "plate.obj", "", ["dragenter"]);
    await expect.poll(() => page.isVisible("#drop-target")).toBe(true);
    await screenshot(page, "upload_target");
    await drop(page, "plate.obj", boxObj(1, 0.2, 1, "mtllib plate.mtl\n"));
    await page.waitForFunction(() => window.__hl.sceneName === "plate.obj");
    await expect.poll(() => page.isVisible("#drop-target")).toBe(false);
    await expect.poll(lastNotice).toMatch(/^plate\.obj: 12 triangles; .* Comes alone, without plate\.mtl\.$/);
    expect(await page.inputValue("#section")).toBe("off");
  });

  test.skipIf(!existsSync(join(dirname(kProgram ?? ""), "hl-cad")))("of CAD becomes the scene, in metres", async () => {
    await drop(page, "flange.step", readFileSync("../scenes/examples/flange.step", "utf8"));
    await page.waitForFunction(() => window.__hl.sceneName === "flange.step" && window.__hl.triangles > 10_000);
    const high = await page.evaluate(() => window.__hl.boundsMax!);
    expect(high.x).toBeCloseTo(0.03, 6);
    await screenshot(page, "upload_cad");
    await drop(page, "cut.step", "ISO-10303-21;\nHEADER;\n");
    await expect.poll(lastNotice).toMatch(/^cut\.step: cannot be understood: it is no sound STEP file/);
  });

  test("of the same name is another scene, too, and the view fits it", async () => {
    await drop(page, "plate.obj", boxObj(100, 100, 100));
    await page.waitForFunction(() => window.__hl.boundsMax?.x === 100);
    const high = await page.evaluate(() => window.__hl.project(window.__hl.boundsMax!));
    expect(high.x > 0 && high.x < 1280 && high.y > 0 && high.y < 720).toBe(true);
  });

  test.each([
    ["bad.obj", "no model\n", "bad.obj: there is no geometry in it"],
    ["empty.obj", "", "empty.obj is empty."],
    ["picture.bin", "x", /^picture\.bin: files ending in '\.bin' cannot be read/],
    ["beside.gltf", '{"asset":{"version":"2.0"},"buffers":[{"uri":"beside.bin","byteLength":36}],' +
      '"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,' +
      '"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],' +
      '"scenes":[{"nodes":[0]}],"scene":0}', /^beside\.gltf: needs beside\.bin, and a file comes alone/],
  ])("that is no good gets one line, and the scene stays: %s", async (name, content, line) => {
    await drop(page, name, content);
    await expect.poll(lastNotice).toMatch(line);
    expect(await page.evaluate(() => [window.__hl.sceneName, window.__hl.boundsMax?.x])).toEqual(["plate.obj", 100]);
    complaints.errors.length = 0; // the browser logs the answer that refuses
  });

  test("that unpacks to gigabytes is refused in a line, and the scene stays", async () => {
    const answer = await fetch(`${touch.url}upload?name=bomb.3mf`, { method: "POST", body: new Uint8Array(zipBomb(3)) });
    expect(answer.status).toBe(422);
    expect(await answer.text()).toMatch(/^bomb\.3mf: .*\n$/);
    expect(await page.evaluate(() => [window.__hl.sceneName, window.__hl.boundsMax?.x])).toEqual(["plate.obj", 100]);
  });

  test("is shown in the place of a recording", async () => {
    const buffer = Buffer.from(await fileOf(...kWhole).arrayBuffer());
    await page.setInputFiles("#file", { name: "a.hlr", mimeType: "", buffer });
    await page.waitForFunction(() => window.__hl.sceneName === "a scene");
    await drop(page, "tall.obj", boxObj(1, 3, 1));
    await page.waitForFunction(() => window.__hl.sceneName === "tall.obj" && window.__hl.recording === undefined);
    const { low, high } = await page.evaluate(() => ({
      low: window.__hl.project(window.__hl.boundsMin!), high: window.__hl.project(window.__hl.boundsMax!),
    }));
    expect(low.y - high.y, "the view fits it").toBeGreaterThan(200);
    expect(low.y).toBeLessThan(kSizes[0].height);
  });

  test("leaves a tidy page, in the dark, in the light, and on a phone", async () => {
    await choose("box.obj", boxObj(4, 2, 3));
    await page.waitForFunction(() => window.__hl.sceneName === "box.obj");
    for (let last = page.locator(".notice.told button").last(); (await last.count()) > 0; ) await last.click();
    for (const size of kSizes) await expectTidyLayout(page, size);
    await resize(page, kSizes[0]);
    await drop(page, "other.obj", boxObj(4, 2, 3));
    await expect.poll(lastNotice).toMatch(/^other/);
    await page.emulateMedia({ colorScheme: "light" });
    await screenshot(page, "upload_light");
    await resize(page, kPhone);
    await screenshot(page, "upload_phone");
    expect(complaints).toEqual({ errors: [], foreign: [] });
  });
});

describe.skipIf(!kProgram)("a server that takes no files", () => {
  test("says no to a model; recordings can be opened all the same", async () => {
    const touch = await startTouch(0, "teapot", "--upload", "off");
    const browser = await launch();
    try {
      const page = await browser.newPage(kWindow);
      await page.goto(touch.url);
      await page.waitForFunction(() => window.__hl.samples > 0);
      expect(await page.isVisible("#open-file")).toBe(true);
      await drop(page, "a.obj", boxObj(1, 1, 1));
      await expect.poll(() => page.textContent(".notice.told span")).toBe(
        "This server takes no files: start it with hl touch --upload on.");
      const buffer = Buffer.from(await fileOf(...kWhole).arrayBuffer());
      await page.setInputFiles("#file", { name: "a.hlr", mimeType: "", buffer });
      await page.waitForFunction(() => window.__hl.sceneName === "a scene");
    } finally {
      await browser.close();
      touch.process.kill("SIGKILL");
    }
  });
});
