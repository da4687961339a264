// The page without a server (scripts/build --web) from a plain file server: HL_WEB names its folder. Left out where it has
// not been built and is not named.

import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { fileOf, kWhole } from "../test-support/recording_bytes";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, pressModel, resize, screenshot, states, untilTouched,
  type Complaints,
} from "./browser";
import { boxObj, boxPly, boxStl, drop } from "./files";

const folder = process.env.HL_WEB ?? "../build/web";
const kTypes: Readonly<Record<string, string>> = {
  ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".wasm": "application/wasm",
};

describe.skipIf(process.env.HL_WEB === undefined && !existsSync(folder))("the page without a server", () => {
  let server: Server;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;
  let origin: string;
  let begin_ms: number;

  beforeAll(async () => {
    server = createServer((request, response) => {
      const name = new URL(request.url!, "http://localhost").pathname.replace(/\/$/, "/index.html");
      readFile(join(folder, name)).then(
        (bytes) => void response.setHeader("Content-Type", kTypes[extname(name)] ?? "application/octet-stream").end(bytes),
        () => void response.writeHead(404).end(),
      );
    });
    await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
    origin = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
    browser = await launch();
    page = await browser.newPage({ viewport: { width: 1280, height: 720 }, colorScheme: "dark" });
    complaints = listen(page, origin);
    begin_ms = performance.now();
    await page.goto(origin);
  });

  afterAll(async () => {
    await browser?.close();
    server?.close();
  });

  test("touches the model by itself, and says nothing to anybody else", async () => {
    await page.waitForFunction(() => window.__hl.samples > 0);
    await page.evaluate(() => document.getElementById("explore")!.click());
    await page.waitForFunction(() => window.__hl.contacts > 0 && window.__hl.peak(1).force_N > 0);
    console.log(`first touch ${((performance.now() - begin_ms) / 1000).toFixed(1)} s after the page was asked for`);
    await screenshot(page, "web_teapot");
    expect(complaints).toEqual({ errors: [], foreign: [] });
  });

  test("shows a recording, and goes back to its own session", async () => {
    const buffer = Buffer.from(await fileOf(...kWhole).arrayBuffer());
    await page.setInputFiles("#file", { name: "a.hlr", mimeType: "", buffer });
    await page.waitForFunction(() => window.__hl.recording !== undefined && window.__hl.triangles === 1);
    await page.keyboard.press("End");
    await page.waitForFunction(() => window.__hl.proxy!.x > 3.9);
    expect(await page.textContent("#recorded-origin")).toContain("a device");
    await page.keyboard.press("Escape");
    await page.waitForFunction(() => window.__hl.recording === undefined && window.__hl.triangles > 1000);
    expect(complaints).toEqual({ errors: [], foreign: [] });
  });

  const lastNotice = () => page.locator(".notice.told span").last().textContent();
  const sceneOf = () => page.evaluate(() => [window.__hl.sceneName, window.__hl.triangles]);
  const steps = (then: number) => page.waitForFunction((time) => window.__hl.time_s! > time, then);

  /** Presses where a point of the scene is drawn, and waits until it is felt there. */
  async function press(point: { x: number; y: number; z: number }): Promise<void> {
    const at = await page.evaluate((point) => window.__hl.project(point), point);
    await pressModel(page, at);
    await untilTouched(page, 0.2);
  }

  test("has the sliders of the engine's own quantities", async () => {
    const labels = await page.locator("#surface-knobs label > span").allTextContents();
    expect(labels).toEqual(["Stiffness", "Static friction", "Dynamic friction", "Viscosity", "Adhesion", "Compliance",
      "Strength"]);
  });

  test("is pressed and dragged", async () => {
    await page.uncheck("#explore");
    const { boundsMin: low, boundsMax: high } = await page.evaluate(() => window.__hl);
    const middle = { x: (low!.x + high!.x) / 2, y: (low!.y + high!.y) / 2, z: high!.z };
    await press(middle);
    const before = await page.evaluate(() => window.__hl.proxy!);
    const at = await page.evaluate((point) => window.__hl.project(point), { ...middle, x: middle.x + 0.2 * (high!.x - low!.x) });
    await page.mouse.move(at.x, at.y, { steps: 10 });
    await page.waitForFunction(
      ({ x, side }) => window.__hl.proxy!.x > x + 0.08 * side && window.__hl.contacts > 0,
      { x: before.x, side: high!.x - low!.x });
    await page.mouse.up();
  });

  test("shows another built-in scene, and keeps what was set", async () => {
    await page.check("#grip-firm", { force: true });
    const scenes = await page.locator("#scene option").allTextContents();
    expect(scenes).toContain("teapot");
    expect(scenes).toContain("terrain:10000");
    expect(await page.inputValue("#scene")).toBe("teapot");
    for (const scene of scenes) {
      await page.selectOption("#scene", scene);
      await page.waitForFunction((name) => window.__hl.sceneName === name, scene);
    }
    await page.selectOption("#scene", "sphere:10000");
    await page.waitForFunction(() => window.__hl.sceneName === "sphere:10000");
    await page.waitForFunction(() => document.querySelector<HTMLInputElement>("#grip-firm")!.checked);
    expect(await page.evaluate(() => window.__hl.meshes)).toBe(1);
    await expectTidyLayout(page, kSizes[0]);
    await screenshot(page, "web_sphere");
  });

  test.each([["box.obj", boxObj(2)], ["box.stl", boxStl(3)], ["box.ply", boxPly(4)]])(
    "opens %s, and it is felt where it is pressed", async (name, content) => {
      await drop(page, name, content);
      await expect.poll(sceneOf).toEqual([name, 12]);
      await expect.poll(lastNotice).toMatch(new RegExp(`^${name}: 12 triangles; 1.mm of the hand is `));
      const side = await page.evaluate(() => window.__hl.boundsMax!.x);
      await press({ x: side / 2, y: side / 2, z: side });
      expect(await page.evaluate(() => window.__hl.proxy!.z)).toBeGreaterThan(side);
      await page.mouse.up();
    });

  test.each([
    ["bad.obj", "no model", "bad.obj: there is no triangle in it."],
    ["holes.obj", "v 0 0 0\nf 1 2 3\n", "holes.obj: a vertex of it is no number."],
    ["flat.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 1 1\n", /^flat\.obj: nothing in this model can be touched/],
    ["empty.stl", "", "empty.stl is empty."],
    ["cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", /^cut\.ply: /],
    ["a.glb", "glTF", "a.glb cannot be opened here; recordings (.hlr) and 3-D models (.obj, .stl, .ply) can."],
  ])("that is no good gets one line, and the scene stays: %s", async (name, content, line) => {
    await drop(page, name, content);
    await expect.poll(lastNotice).toMatch(line);
    expect(await sceneOf()).toEqual(["box.ply", 12]);
    await steps(await page.evaluate(() => window.__hl.time_s!));
    complaints.errors.length = 0; // readers of files warn in the console
  });

  test("stops its clock while it is hidden, says so, and goes on", async () => {
    const setHidden = (hidden: boolean) => page.evaluate((hidden) => {
      Object.defineProperty(document, "hidden", { value: hidden, configurable: true });
      document.dispatchEvent(new Event("visibilitychange"));
    }, hidden);
    await setHidden(true);
    await expect.poll(() => page.title()).toBe("HL: stopped while hidden");
    // What was on its way has come when two looks see the same.
    let stopped = NaN;
    await expect.poll(async () => {
      const [before, now] = [stopped, await page.evaluate(() => window.__hl.time_s!)];
      stopped = now;
      return before === now;
    }).toBe(true);
    await page.waitForTimeout(500);
    expect(await page.evaluate(() => window.__hl.time_s)).toBe(stopped);
    const shown_ms = await page.evaluate(() => performance.now());
    await setHidden(false);
    await steps(stopped);
    await expect.poll(() => page.title()).toBe("HL");
    const [time_s, now_ms] = await page.evaluate(() => [window.__hl.time_s!, performance.now()]);
    expect(time_s - stopped, "what it missed is left out").toBeLessThan((now_ms - shown_ms) / 1e3 + 0.1);
  });

  test("moves the bodies of the workshop, by themselves and where they are pushed", async () => {
    const shop = await browser.newPage({ ...kWindow, colorScheme: "dark" });
    const heard = listen(shop, origin);
    await shop.goto(`${origin}?scene=workshop`);
    await shop.waitForFunction(() => window.__hl.objects > 20 && window.__hl.samples > 100);
    await expect.poll(() => shop.textContent("#bodies-count")).toMatch(/of\s25\sawake/);
    const domino = () => shop.evaluate(() => window.__hl.originOf(3));
    const begin = await domino();
    const [from, to] = await shop.evaluate((at) =>
      [0, 0.04].map((way) => window.__hl.project({ x: at.x + way, y: at.y, z: at.z })), begin);
    // On a slow machine the hand may not have come there yet when it is sent on: then it is sent again.
    const push = async () => {
      await shop.mouse.move(from!.x, from!.y);
      await shop.mouse.down();
      await shop.waitForFunction(() => window.__hl.contacts > 0);
      await shop.mouse.move(to!.x, to!.y, { steps: 40 });
      await states(shop, 30);
      await shop.mouse.up();
      return Math.abs((await domino()).x - begin.x);
    };
    await expect.poll(push).toBeGreaterThan(0.003);
    await screenshot(shop, "web_workshop");
    expect(heard).toEqual({ errors: [], foreign: [] });
    await shop.close();
  });

  test("draws snaps and fields, and takes them away with the key J", async () => {
    const board = await browser.newPage({ ...kWindow, colorScheme: "dark" });
    await board.goto(`${origin}?scene=snaps`);
    await board.waitForFunction(() => window.__hl.objects === 3 && window.__hl.samples > 100);
    await screenshot(board, "web_snaps");
    const socket = await board.evaluate(() => window.__hl.project({ x: -0.06, y: 0.028, z: -0.05 }));
    const picture = () => board.screenshot({ clip: { x: socket.x - 10, y: socket.y - 10, width: 20, height: 20 } });
    const drawn = await picture();
    await board.keyboard.press("j");
    await expect.poll(async () => (await picture()).equals(drawn)).toBe(false);
    await board.keyboard.press("j");
    await expect.poll(async () => (await picture()).equals(drawn)).toBe(true);
    await board.close();
  });

  test.each(["field:terrain:10000", "points:sphere:500", "depth:table", "sdf:torus"])(
    "draws what is no mesh: %s", async (scene) => {
      const other = await browser.newPage({ ...kWindow, colorScheme: "dark" });
      const heard = listen(other, origin);
      await other.goto(`${origin}?scene=${scene}`);
      await other.waitForFunction((name) => window.__hl.sceneName === name && window.__hl.samples > 0, scene);
      const size = await other.textContent("#model-size");
      expect(size).toMatch(scene.startsWith("points") ? /^500\spoints$/ : /^\d[\d\s]*\d{3}\striangles$/);
      await screenshot(other, `web_${scene.replaceAll(":", "_")}`);
      expect(heard).toEqual({ errors: [], foreign: [] });
      await other.close();
    });

  test("a slider moves the surface of a volume, which is drawn where it is felt", async () => {
    const scan = await browser.newPage({ ...kWindow, colorScheme: "dark" });
    const heard = listen(scan, origin);
    await scan.goto(`${origin}?scene=ct:phantom:64`);
    await scan.waitForFunction(() => window.__hl.objects === 2 && window.__hl.samples > 0);
    expect(await scan.textContent("label[for=iso-1] span")).toBe("Iso value of skin");
    expect(await scan.inputValue("#iso-2")).toBe("370");
    const drawn = () => scan.evaluate(() => window.__hl.triangles);
    const before = await drawn();
    await scan.evaluate(() => document.getElementById("explore")!.click());
    await scan.waitForFunction(() => window.__hl.contacts > 0);
    const height = await scan.evaluate(() => window.__hl.proxy!.y);
    await scan.fill("#iso-1", "600");
    await expect.poll(drawn).not.toBe(before);
    await scan.waitForFunction((skin) => window.__hl.contacts > 0 && window.__hl.proxy!.y < skin - 1e-3, height);
    await screenshot(scan, "web_scan");
    expect(heard).toEqual({ errors: [], foreign: [] });
    await scan.close();
  });

  test("shows the teapot where the address names no scene, and says so", async () => {
    const other = await browser.newPage({ ...kWindow, colorScheme: "light" });
    await other.goto(`${origin}?scene=nosuch`);
    await other.waitForFunction(() => window.__hl.sceneName === "teapot" && window.__hl.samples > 0);
    expect(await other.textContent(".notice.told span")).toMatch(/^no built-in scene 'nosuch'; there are teapot/);
    await screenshot(other, "web_nosuch");
    await resize(other, { width: 390, height: 844 });
    await screenshot(other, "web_phone");
    await other.close();
    expect(complaints).toEqual({ errors: [], foreign: [] });
  });
});
