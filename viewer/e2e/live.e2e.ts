// A scene that changes while it is shown: objects come, circle, come to rest and go. HL_MOVING_SCENE names the program that
// serves it (tests/server/hl_moving_scene.cpp); without it these tests are skipped.

import { spawn, type ChildProcess } from "node:child_process";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, modelPixels, openSection, resize, screenshot, states, type Complaints,
} from "./browser";

const kProgram = process.env.HL_MOVING_SCENE;
const kDist = fileURLToPath(new URL("../dist", import.meta.url));

interface Server {
  readonly process: ChildProcess;
  readonly url: string;
}

async function start(): Promise<Server> {
  const child = spawn(kProgram!, [kDist], { stdio: ["pipe", "pipe", "inherit"] });
  for await (const line of createInterface({ input: child.stdout! })) {
    if (line.startsWith("page: ")) {
      child.stdout!.resume();
      return { process: child, url: line.slice("page: ".length) };
    }
  }
  throw new Error("hl_moving_scene ended without reporting its page");
}

describe.skipIf(!kProgram)("a scene that changes", () => {
  let server: Server;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;

  beforeAll(async () => {
    server = await start();
    browser = await launch();
    page = await browser.newPage({ ...kWindow, colorScheme: "dark" });
    complaints = listen(page, server.url);
    await page.goto(server.url);
    await page.waitForFunction(() => window.__hl.layout !== undefined && window.__hl.samples > 10);
  });

  afterAll(async () => {
    await browser?.close();
    server?.process.stdin!.end();
  });

  const send = (line: string) => server.process.stdin!.write(`${line}\n`);
  const objects = (count: number) => page.waitForFunction((wanted) => window.__hl.objects === wanted, count);
  const layoutNumber = () => page.evaluate(() => window.__hl.layout!);
  const cameraX = () => page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0 }).x);

  test("without objects says how to bring some", async () => {
    await page.waitForSelector("#empty:visible");
    expect(await page.textContent("#client-address")).toBe(`hl://${new URL(server.url).host}`);
    await screenshot(page, "live_empty");
  });

  test("shows surfaces, lines and points as they come, in the middle of the view", async () => {
    send("show mixed 5");
    await objects(5);
    await page.waitForSelector("#empty", { state: "hidden" });
    expect(await page.evaluate(() => window.__hl.meshes)).toBe(5);
    await expect.poll(() => modelPixels(page)).toBeGreaterThan(0.02);
    expect(await page.textContent("#model-size")).toMatch(/^5\sobjects, .*triangles, 12\ssegments, 8\spoints$/);
    await openSection(page, "view");
    for (const size of kSizes) {
      await expectTidyLayout(page, size);
    }
    await resize(page, kSizes[0]);
    await screenshot(page, "live_mixed");
  });

  test("moves them with the states, without new layouts, and leaves the camera alone", async () => {
    const [camera, layout] = [await cameraX(), await layoutNumber()];
    const from = await page.evaluate(() => window.__hl.originOf(0));
    await page.waitForFunction(
      ({ x, z }) => Math.hypot(window.__hl.originOf(0).x - x, window.__hl.originOf(0).z - z) > 0.05, from,
    );
    expect(await layoutNumber()).toBe(layout);
    // The camera is computed anew in each frame: its last bits may change.
    expect(await cameraX()).toBeCloseTo(camera, 6);
  });

  test("says which objects are touched", async () => {
    await page.waitForFunction(() => window.__hl.touched.length > 0);
    await screenshot(page, "live_touched");
  });

  test("what has come to rest stays where it is", async () => {
    send("still");
    const layout = await layoutNumber();
    await page.waitForFunction((before) => window.__hl.layout! > before, layout);
    const from = await page.evaluate(() => window.__hl.originOf(0));
    await states(page, 30);
    expect(await page.evaluate(() => window.__hl.originOf(0))).toEqual(from);
    send("move");
  });

  test("objects go, their meshes are forgotten, and the rest moves on", async () => {
    send("show mixed 2");
    await objects(2);
    await page.waitForFunction(() => window.__hl.meshes === 2);
    const from = await page.evaluate(() => window.__hl.originOf(1));
    await page.waitForFunction(({ x }) => Math.abs(window.__hl.originOf(1).x - x) > 0.005, from);
    await screenshot(page, "live_two");
  });

  test("a second page gets all of it immediately", async () => {
    const other = await browser.newPage({ ...kWindow, colorScheme: "light" });
    await other.goto(server.url);
    await other.waitForFunction(() => window.__hl.objects === 2 && window.__hl.meshes === 2);
    await screenshot(other, "live_light");
    await other.close();
  });

  test("a thousand moving objects are one mesh, and a press of R shows them all", async () => {
    send("show sphere:200 1000");
    await objects(1000);
    expect(await page.evaluate(() => window.__hl.meshes)).toBe(1);
    await page.keyboard.press("r");
    // The camera is there with the next frame that is drawn.
    await page.waitForFunction(({ width }) => {
      const corner = window.__hl.project(window.__hl.boundsMax!);
      return corner.y > 0 && corner.x < width;
    }, kSizes[0]);
    await states(page, 30);
    await openSection(page, "view");
    await page.check("#edges");
    await states(page, 5);
    await page.uncheck("#edges");
    await screenshot(page, "live_thousand");
  });

  test("a scene that empties says so again, and one of another size is fitted anew", async () => {
    send("show mixed 0");
    await page.waitForSelector("#empty:visible");
    expect(await page.evaluate(() => window.__hl.meshes)).toBe(0);
    send("show teapot 1");
    await objects(1);
    // Across all corners: the teapot may be turned so that two opposite ones lie above each other.
    await page.waitForFunction(() => {
      const { boundsMin, boundsMax } = window.__hl;
      const across = [boundsMin!, boundsMax!].flatMap(({ x }) =>
        [boundsMin!, boundsMax!].flatMap(({ y }) =>
          [boundsMin!, boundsMax!].map(({ z }) => window.__hl.project({ x, y, z }).x),
        ),
      );
      return Math.max(...across) - Math.min(...across) > 200;
    });
    await screenshot(page, "live_again");
  });

  test("no console errors, and nothing from outside addresses", () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign).toEqual([]);
  });
});
