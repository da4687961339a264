// What the end-to-end tests share: a Chromium with software GL that talks to nobody, a watch on the console, and the
// check that no two panels overlap.

import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium, type Browser, type Page } from "playwright-core";
import { expect } from "vitest";

export const kSizes = [
  { width: 1280, height: 720 },
  { width: 1920, height: 1080 },
] as const;

/** The usual window. Its canvas has a quarter of the pixels, as software GL takes its time for each; pictures have all. */
export const kWindow = { viewport: kSizes[0], deviceScaleFactor: process.env.HL_SCREENSHOTS ? 1 : 0.5 };

/** Turns the wheel by so many pixels of the page, up if negative: Chromium takes a test's pixels for those of the device. */
export function turnWheel(page: Page, turned_px: number): Promise<void> {
  return page.mouse.wheel(0, turned_px * kWindow.deviceScaleFactor);
}

/** Software GL takes all processors, which a servo without real-time priority has to share: HL_CHROMIUM comes last. */
const kYieldingChromium = fileURLToPath(new URL("yielding_chromium.sh", import.meta.url));

export function launch(): Promise<Browser> {
  return chromium.launch({
    executablePath: kYieldingChromium,
    headless: true,
    args: [
      "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      // Software GL draws the scene alone; laying the page together by it, too, takes two thirds of the frames.
      "--disable-gpu-compositing",
      "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
      "--disable-quic",
    ],
  });
}

/** What a page is waited for may come so late: software graphics on a machine that does other work, too. */
const kLate_ms = 120_000;

/** Everything that went wrong on the page, and every request that left the serving host. */
export interface Complaints {
  readonly errors: string[];
  readonly foreign: string[];
}

/** A failed connection to a server that was killed on purpose is logged by the browser itself: not an error. */
const kExpected = /WebSocket connection to .* failed|ERR_CONNECTION_REFUSED/;

export function listen(page: Page, origin: string): Complaints {
  page.setDefaultTimeout(kLate_ms);
  const complaints: Complaints = { errors: [], foreign: [] };
  page.on("console", (message) => {
    if ((message.type() === "error" || message.type() === "warning") && !kExpected.test(message.text())) {
      // The software renderer of the test machine reports its own slowness; that is no fault of the page.
      if (!/GPU stall due to ReadPixels/.test(message.text())) complaints.errors.push(message.text());
    }
  });
  page.on("pageerror", (error) => complaints.errors.push(String(error)));
  page.on("request", (request) => {
    if (!request.url().startsWith(origin) && !request.url().startsWith("data:")) complaints.foreign.push(request.url());
  });
  return complaints;
}

/** Pictures are for people: the plots get this long to fill. Nothing else waits for a time. */
const kPicture_ms = 2000;

/** Saves a picture into HL_SCREENSHOTS, when that is set. */
export async function screenshot(page: Page, name: string): Promise<void> {
  const folder = process.env.HL_SCREENSHOTS;
  if (folder) {
    mkdirSync(folder, { recursive: true });
    await page.waitForTimeout(kPicture_ms);
    await page.screenshot({ path: join(folder, `${name}.png`) });
  }
}

/** Sets the window's size and waits until the canvas has followed and no panel moves any more. */
export async function resize(page: Page, size: { width: number; height: number }): Promise<void> {
  await page.setViewportSize(size);
  await page.evaluate(async ({ width }) => {
    const ids = ["canvas", "controls", "readouts", "hints"];
    const boxes = () => JSON.stringify(ids.map((id) => document.getElementById(id)!.getBoundingClientRect()));
    const view = document.getElementById("view")!;
    const canvas = document.getElementById("canvas")!;
    const follows = () => window.innerWidth === width && canvas.clientWidth === view.clientWidth;
    for (let last = "", still = 0; still < 3; ) {
      await new Promise((resolve) => requestAnimationFrame(resolve));
      const now = boxes();
      still = follows() && now === last ? still + 1 : 0;
      last = now;
    }
  }, size);
}

/** Waits until the page has drawn `count` more states of the server. */
export function states(page: Page, count = 1): Promise<void> {
  return page.evaluate(async (wanted) => {
    for (let seen = 0, last = window.__hl.time_s; seen < wanted; ) {
      await new Promise((resolve) => requestAnimationFrame(resolve));
      seen += window.__hl.time_s === last ? 0 : 1;
      last = window.__hl.time_s;
    }
  }, count);
}

/** Nearer to the pointer than this, a hand that touches nothing is taken by a press; see pointing.ts. With room to spare. */
const kHandMarks_px = 45;

/** Presses the model at a pixel. A hand that hovers there would be taken instead: it is dragged away first. */
export async function pressModel(page: Page, at: { x: number; y: number }): Promise<void> {
  const hovers = () => page.evaluate(({ x, y, near_px }) => {
    const { finger, proxy, contacts, project } = window.__hl;
    const near = (px: { x: number; y: number }) => Math.hypot(px.x - x, px.y - y) < near_px;
    return contacts === 0 && (near(project(finger!)) || near(project(proxy!)));
  }, { ...at, near_px: kHandMarks_px });
  await page.mouse.move(at.x, at.y);
  while (await hovers()) {
    await page.mouse.down();
    await page.mouse.move(at.x + 2 * kHandMarks_px, at.y, { steps: 5 });
    await states(page, 10);
    await page.mouse.up();
    await page.mouse.move(at.x, at.y);
  }
  await page.mouse.down();
}

/** Waits until something is touched with such a force; else, or in a fault, says what was. */
export async function untilTouched(page: Page, least_N = 0): Promise<void> {
  const touchedOrFault = (least: number) => {
    const { contacts, fault, peak } = window.__hl;
    return fault !== "" || (contacts > 0 && peak(0.2).force_N > least);
  };
  await page.waitForFunction(touchedOrFault, least_N).catch(async (error: unknown) => {
    const state = await page.evaluate(() => JSON.stringify(window.__hl));
    throw new Error(`${String(error)}\n${state}`);
  });
  expect(await page.evaluate(() => window.__hl.fault)).toBe("");
}

/** No two panels overlap, none leaves the window, none has to scroll or cuts off its text. */
export async function expectTidyLayout(page: Page, size: { width: number; height: number }): Promise<void> {
  await resize(page, size);
  const boxes = await page.evaluate(() =>
    ["controls", "readouts", "notices", "hints", "key", "scale-bar", "timeline"].map((id) => {
      const target = document.getElementById(id)!;
      const { left, top, right, bottom } = target.getBoundingClientRect();
      const clipped = target.scrollHeight > target.clientHeight + 1 || target.scrollWidth > target.clientWidth + 1;
      return { id, left, top, right, bottom, clipped };
    }),
  );
  for (const box of boxes) {
    expect(box, `${box.id} fits ${size.width}x${size.height}`).toMatchObject({ clipped: false });
    expect(box.left >= 0 && box.top >= 0 && box.right <= size.width && box.bottom <= size.height, box.id).toBe(true);
  }
  for (const a of boxes) {
    for (const b of boxes) {
      const apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
      expect(a === b || apart, `${a.id} and ${b.id} apart at ${size.width}x${size.height}`).toBe(true);
    }
  }
}

/** In low windows only one section is open. */
export async function openSection(page: Page, name: "surface" | "view" | "more"): Promise<void> {
  await page.evaluate((id) => (document.querySelector<HTMLDetailsElement>(id)!.open = true), `#${name}-fold`);
}

/** Share of the pixels in the middle of the window that differ from its background colour. */
export async function modelPixels(page: Page): Promise<number> {
  const { width, height } = page.viewportSize()!;
  const clip = { x: width * 0.25, y: height * 0.15, width: width * 0.45, height: height * 0.65 };
  const png = (await page.screenshot({ clip })).toString("base64");
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.width;
    canvas.height = image.height;
    const context = canvas.getContext("2d")!;
    context.drawImage(image, 0, 0);
    const { data: pixels } = context.getImageData(0, 0, canvas.width, canvas.height);
    let different = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      const distance = Math.abs(pixels[i]! - pixels[0]!) + Math.abs(pixels[i + 1]! - pixels[1]!);
      different += distance > 40 ? 1 : 0;
    }
    return different / (pixels.length / 4);
  }, png);
}
