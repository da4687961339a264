// What helps a person to see: the hand that is out of view, depth, the key, clean silhouettes, a browser without WebGL.
// Against a stand-in server.

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { FakeServer } from "../test-support/fake_server";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, openSection, resize, screenshot, states, type Complaints,
} from "./browser";

let browser: Browser;
let server: FakeServer;
let page: Page;
let complaints: Complaints;

beforeAll(async () => {
  browser = await launch();
  server = await FakeServer.start();
  server.explore = false;
  page = await browser.newPage({ ...kWindow, colorScheme: "dark" });
  complaints = listen(page, server.url);
  await page.goto(server.url);
  await page.waitForFunction(() => window.__hl.samples > 100);
});

afterAll(async () => {
  await browser?.close();
  await server?.close();
});

/** The middle of the sphere in the picture. */
const middle = () => page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0 }));

test("an arrow points to a hand that is out of view, and a click brings the hand back", async () => {
  await page.waitForSelector("#finder", { state: "hidden" });
  await page.mouse.move(360, 620);
  await page.mouse.down();
  await page.mouse.move(900, 40, { steps: 5 });
  await page.mouse.up();
  await page.mouse.move(360, 620);
  await page.mouse.down();
  await page.mouse.move(900, 60, { steps: 5 });
  await page.mouse.up();
  await page.waitForSelector("#finder:visible");
  const arrow = (await page.locator("#finder").boundingBox())!;
  expect(arrow.x).toBeGreaterThan(500);
  expect(arrow.y).toBeLessThan(100);
  expect(await page.textContent("#finder-distance")).toMatch(/^\d+(\.\d+)?.(mm|m)$/);
  await screenshot(page, "aids_lost");
  await page.click("#finder");
  await page.waitForSelector("#finder", { state: "hidden" });
  await expect.poll(() => server.received.at(-1)?.body.case).toBe("release");
  const at = await page.evaluate(() => window.__hl.project(window.__hl.finger!));
  const { x, y } = await middle();
  expect(Math.hypot(at.x - x, at.y - y)).toBeLessThan(60);
});

test("the key B brings the hand back too", async () => {
  await page.mouse.move(360, 620);
  await page.mouse.down();
  await page.mouse.move(600, 620, { steps: 5 });
  await page.mouse.up();
  const from = await page.evaluate(() => window.__hl.finger!);
  await page.keyboard.press("b");
  await page.waitForFunction(({ x, y }) => {
    const { finger } = window.__hl;
    return Math.hypot(finger!.x - x, finger!.y - y) > 0.01;
  }, from);
  await expect.poll(() => server.received.at(-1)?.body.case).toBe("release");
});

test("a line goes down from the proxy to what is below, and its key D takes it away", async () => {
  await states(page, 30);
  const picture = async () => {
    await states(page, 5);
    const { x, y } = await page.evaluate(() => window.__hl.project(window.__hl.proxy!));
    return page.screenshot({ clip: { x: x - 30, y: y + 16, width: 60, height: 80 } });
  };
  const withLine = await picture();
  expect((await picture()).equals(withLine)).toBe(true);
  await page.keyboard.press("d");
  await expect.poll(async () => (await picture()).equals(withLine)).toBe(false);
  await page.keyboard.press("d");
  await expect.poll(async () => (await picture()).equals(withLine)).toBe(true);
});

test("the key and the scale bar lie beside everything else, at both sizes", async () => {
  await page.click("#key > summary");
  for (const size of kSizes) {
    await expectTidyLayout(page, size);
  }
  await resize(page, kSizes[0]);
  expect(await page.textContent("#scale-length")).toMatch(/^(1|2|5)0*.mm$/);
  // The bar is as long as it says.
  const { bar_px, right_m, label } = await page.evaluate(() => {
    const origin = window.__hl.project({ x: 0, y: 0, z: 0 });
    const one = window.__hl.project({ x: 0.01, y: 0, z: 0 });
    return {
      bar_px: document.getElementById("scale-line")!.getBoundingClientRect().width,
      right_m: 0.01 / Math.hypot(one.x - origin.x, one.y - origin.y),
      label: document.getElementById("scale-length")!.textContent!,
    };
  });
  // The x axis is turned a little away from the screen at first.
  expect((bar_px * right_m * 1e3) / Number.parseFloat(label)).toBeCloseTo(1.05, 0);
  await screenshot(page, "aids_key");
  await page.click("#key > summary");
});

test("the open key leaves the middle of the view free, and takes no press, in a small window", async () => {
  await page.click("#key > summary");
  await resize(page, { width: 1000, height: 640 });
  const seen = await page.evaluate(() => {
    const key = document.getElementById("key")!.getBoundingClientRect();
    const list = document.querySelector("#key ul")!.getBoundingClientRect();
    const middle = window.__hl.project({ x: 0, y: 0, z: 0 });
    const pressed = document.elementFromPoint(list.left + list.width / 2, list.top + list.height / 2)!.id;
    return { top: key.top, middle: middle.y, pressed };
  });
  expect(seen.pressed).toBe("canvas");
  expect(seen.top).toBeGreaterThan(seen.middle + 25);
  await screenshot(page, "aids_key_small");
  await resize(page, kSizes[0]);
  await page.click("#key > summary");
});

/** Pixels in the middle of the window that are much darker than almost all around them. */
async function speckles(): Promise<number> {
  const png = (await page.screenshot({ clip: { x: 340, y: 60, width: 560, height: 560 } })).toString("base64");
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext("2d")!;
    context.drawImage(image, 0, 0);
    const { data: pixels, width, height } = context.getImageData(0, 0, image.width, image.height);
    const light = (x: number, y: number) => {
      const at = 4 * (y * width + x);
      return pixels[at]! + pixels[at + 1]! + pixels[at + 2]!;
    };
    let count = 0;
    for (let y = 1; y < height - 1; ++y) {
      for (let x = 1; x < width - 1; ++x) {
        const around = [-1, 0, 1].flatMap((i) => [-1, 0, 1].map((j) => light(x + i, y + j))).sort((a, b) => a - b);
        count += light(x, y) < 0.6 * around[3]! ? 1 : 0;
      }
    }
    return count;
  }, png);
}

test("silhouettes have no dark speckles, with mesh edges they have their offset back", async () => {
  await openSection(page, "view");
  await page.click("label:has(input[name=theme][value=light])");
  await page.keyboard.press("d");
  await states(page, 5);
  expect(await speckles()).toBeLessThan(5);
  await page.keyboard.press("m");
  await states(page, 5);
  await screenshot(page, "aids_edges");
  await page.keyboard.press("m");
  await page.keyboard.press("d");
  await page.click("label:has(input[name=theme][value=system])");
});

test("without WebGL the page says so, and numbers and controls work", async () => {
  const blind = await browser.newPage({ ...kWindow, colorScheme: "dark" });
  const heard = listen(blind, server.url);
  await blind.addInitScript(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
      return kind.startsWith("webgl") ? null : (original as (...all: unknown[]) => unknown).call(this, kind, ...rest);
    } as typeof original;
  });
  await blind.goto(server.url);
  await blind.waitForSelector("[data-cause=drawing]");
  expect(await blind.textContent("[data-cause=drawing]")).toMatch(/WebGL/);
  await blind.waitForFunction(() => window.__hl.link === "live" && window.__hl.samples > 10);
  await expect.poll(() => blind.textContent("#force")).toMatch(/\d\.\d\d.N/);
  await blind.fill("#stiffness", "1500");
  await expect.poll(() => server.stiffness_N_m).toBe(1500);
  await screenshot(blind, "aids_without_webgl");
  expect(heard.errors).toEqual([]);
  await blind.close();
});

test("a graphics context that is lost is reported, and drawing goes on when it is back", async () => {
  const other = await browser.newPage(kWindow);
  await other.goto(server.url);
  await other.waitForFunction(() => window.__hl.samples > 10);
  await other.evaluate(() => {
    const context = (document.getElementById("canvas") as HTMLCanvasElement).getContext("webgl2")!;
    const lose = context.getExtension("WEBGL_lose_context")!;
    lose.loseContext();
    (window as unknown as { restore: () => void }).restore = () => lose.restoreContext();
  });
  await other.waitForSelector("[data-cause=drawing]");
  const from_s = await other.evaluate(() => window.__hl.time_s!);
  await other.waitForFunction((time_s) => window.__hl.time_s! > time_s + 0.2, from_s);
  await other.evaluate(() => (window as unknown as { restore: () => void }).restore());
  await other.waitForSelector("[data-cause=drawing]", { state: "detached" });
  await other.close();
});

test("no console errors, and nothing from outside addresses", () => {
  expect(complaints.errors).toEqual([]);
  expect(complaints.foreign).toEqual([]);
});
