// A press on the model touches it there: against real servers, judged by what they say of contact and force.

import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, test, vi } from "vitest";
import { kWindow, launch, listen, pressModel, screenshot, states, turnWheel, type Complaints } from "./browser";
import { kProgram, startTouch, type Touch } from "./programs";

/** The proxy lies its radius above the surface, and the hand gives way: its picture is this near to the pointer. */
const kNear_px = 25;

interface Felt {
  /** Of the server. */
  readonly time_s: number;
  readonly contacts: number;
  readonly force_N: number;
  /** From the pointer to the proxy's picture. */
  readonly off_px: number;
  /** Drawn since the page was opened, and whether its hand is held. */
  readonly frames: number;
  readonly holding: boolean;
}

declare global {
  interface Window {
    drawn: number;
  }
}

/** Two plates side by side, of different materials, in one file. */
const kTwoMaterials = {
  objects: [
    { builtin: "plane:8", material: { staticFriction: 0.4, dynamicFriction: 0.2 } },
    { builtin: "plane:8", transform: { translate: { x: 1.5 } }, material: { stiffness: 0.3 } },
  ],
};

describe.skipIf(!kProgram)("the pointer", () => {
  test("names the materials of a scene file, each where it is", async () => {
    const file = join(mkdtempSync(join(tmpdir(), "hl-page-")), "two.hl.json");
    writeFileSync(file, JSON.stringify(kTwoMaterials));
    const touch = await startTouch(0, file);
    const browser = await launch();
    try {
      const page = await browser.newPage(kWindow);
      await page.goto(touch.url);
      await page.waitForFunction(() => window.__hl.triangles === 16 && window.__hl.samples > 100);
      const { left, right } = await page.evaluate(() => {
        const { boundsMin: low, boundsMax: high } = window.__hl;
        const middle = { y: (low!.y + high!.y) / 2, z: (low!.z + high!.z) / 2 };
        const at = (share: number) => window.__hl.project({ x: low!.x + share * (high!.x - low!.x), ...middle });
        return { left: at(0.1), right: at(0.9) };
      });
      await page.mouse.move(left.x, left.y);
      await expect.poll(() => page.textContent("#picked")).toBe("The model: stiffness 1, friction 0.4, sliding 0.2");
      await page.mouse.move(right.x, right.y);
      await expect.poll(() => page.textContent("#picked")).toBe("The model: stiffness 0.3, friction 0");
    } finally {
      await browser.close();
      touch.process.kill("SIGKILL");
    }
  });
});

describe.skipIf(!kProgram)("a press on the model", () => {
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
    await page.uncheck("#explore");
    await page.evaluate(() => {
      window.drawn = 0;
      const frame = () => {
        ++window.drawn;
        requestAnimationFrame(frame);
      };
      frame();
    });
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGKILL");
  });

  // A test that ends early leaves nothing pressed.
  afterEach(async () => {
    await page.mouse.up();
    await page.keyboard.up("Shift");
  });

  const felt = (at: { x: number; y: number }): Promise<Felt> =>
    page.evaluate(({ x, y }) => {
      const { time_s, contacts, force_N, proxy, holding } = window.__hl;
      const picture = window.__hl.project(proxy!);
      const force = force_N === undefined ? 0 : Math.hypot(force_N.x, force_N.y, force_N.z);
      const off_px = Math.hypot(picture.x - x, picture.y - y);
      return { time_s: time_s!, contacts, force_N: force, off_px, frames: window.drawn, holding };
    }, at);
  const isTouched = ({ contacts, force_N, off_px }: Felt) => contacts > 0 && force_N > 0.1 && off_px < kNear_px;

  /**
   * Waits until the place under the pointer is touched. For so many seconds of the server it was seen not to be: a busy
   * machine looks seldom.
   */
  async function secondsUntouched(at: { x: number; y: number }): Promise<number> {
    const first = await felt(at);
    let last = first;
    for (let tries = 0; ; ++tries) {
      await states(page);
      const now = await felt(at);
      if (isTouched(now)) return last.time_s - first.time_s;
      last = now;
      expect(tries, `what is under the pointer is touched, not ${JSON.stringify(last)}`).toBeLessThan(600);
    }
  }

  /** Waits until the force is as wanted. If it never is, the error says what is felt, and what was before. */
  async function untilForce(
    at: { x: number; y: number }, wanted: string, is: (force_N: number) => boolean,
  ): Promise<void> {
    const first = await felt(at);
    await vi.waitFor(async () => {
      const now = await felt(at);
      expect(is(now.force_N), `a force ${wanted}: ${JSON.stringify({ first, now })}`).toBe(true);
    }, { timeout: 120_000 });
  }

  /** The middle of the teapot's body in the picture. */
  const belly = () => page.evaluate(() => {
    const { boundsMin: low, boundsMax: high } = window.__hl;
    const middle = { x: (low!.x + high!.x) / 2, y: (low!.y + high!.y) / 2, z: (low!.z + high!.z) / 2 };
    const { x, y } = window.__hl.project(middle);
    return { x: Math.round(x), y: Math.round(y) };
  });

  test("in the middle of the picture is felt there within two seconds", async () => {
    const at = await belly();
    await pressModel(page, at);
    expect(await secondsUntouched(at)).toBeLessThan(2);
    await screenshot(page, "press_belly");
  });

  test("that is dragged slides along the surface and stays in contact", async () => {
    const from = await belly();
    await pressModel(page, from);
    await secondsUntouched(from);
    for (let i = 1; i <= 30; ++i) {
      const at = { x: from.x - 3 * i, y: from.y + i };
      await page.mouse.move(at.x, at.y);
      await states(page, 2);
      expect((await felt(at)).contacts).toBeGreaterThan(0);
    }
    await secondsUntouched({ x: from.x - 90, y: from.y + 30 });
  });

  test("gets deeper with the wheel and with Shift, and the force grows", async () => {
    const at = await belly();
    await pressModel(page, at);
    await secondsUntouched(at);
    await states(page, 60);
    const light_N = (await felt(at)).force_N;
    await turnWheel(page, -150);
    await untilForce(at, `a fifth above ${light_N}`, (force_N) => force_N > 1.2 * light_N);
    await turnWheel(page, 150);
    await states(page, 60);
    // As it was, but for the friction of the device: what was turned is turned back.
    await untilForce(at, `near ${light_N}`, (force_N) => force_N > 0.8 * light_N && force_N < 1.1 * light_N);
    await page.keyboard.down("Shift");
    await page.mouse.move(at.x, at.y - 40, { steps: 5 });
    await untilForce(at, `a fifth above ${light_N}`, (force_N) => force_N > 1.2 * light_N);
    await page.keyboard.up("Shift");
  });

  test("on the far side, where the hand is not: it goes around and touches from outside", async () => {
    const { x, y } = await belly();
    // Half around with the right button: what was behind is in front now, and the hand is behind.
    const behind = () => page.evaluate(() => {
      const { boundsMin: low, boundsMax: high, proxy } = window.__hl;
      const middle = { x: (low!.x + high!.x) / 2, y: (low!.y + high!.y) / 2, z: (low!.z + high!.z) / 2 };
      return window.__hl.project(proxy!).depth_m > window.__hl.project(middle).depth_m;
    });
    await pressModel(page, { x, y });
    await secondsUntouched({ x, y });
    await page.mouse.up();
    await page.mouse.move(400, 200);
    await page.mouse.down({ button: "right" });
    await page.mouse.move(400 + 360, 200, { steps: 12 });
    await page.mouse.up({ button: "right" });
    await expect.poll(behind).toBe(true);
    await states(page, 60);
    const at = await belly();
    await pressModel(page, at);
    expect(await secondsUntouched(at)).toBeLessThan(3);
    await screenshot(page, "press_far_side");
    await page.mouse.up();
    await page.keyboard.press("r");
    await states(page, 30);
    const back = await belly();
    await pressModel(page, back);
    expect(await secondsUntouched(back)).toBeLessThan(3);
  });

  test("on handle and spout is felt there", async () => {
    await page.keyboard.press("r");
    await states(page, 30);
    const { low, high } = await page.evaluate(() => {
      const { boundsMin: a, boundsMax: b } = window.__hl;
      const level = { y: a!.y + 0.62 * (b!.y - a!.y), z: (a!.z + b!.z) / 2 };
      const at = (share: number) => window.__hl.project({ x: a!.x + share * (b!.x - a!.x), ...level });
      return { low: at(0.04), high: at(0.87) };
    });
    for (const at of [low, high]) {
      await pressModel(page, at);
      await secondsUntouched(at);
      await screenshot(page, `press_${at === low ? "low" : "high"}`);
      // However much deeper: a goal beyond the middle of what is thin would let the proxy slip around it.
      await turnWheel(page, -2000);
      await states(page, 60);
      await secondsUntouched(at);
      await page.mouse.up();
    }
  });

  test("that was deep leaves no force when the mouse lets go", async () => {
    const at = await belly();
    await pressModel(page, at);
    await secondsUntouched(at);
    await turnWheel(page, -2000);
    await untilForce(at, "above 1.5 N", (force_N) => force_N > 1.5);
    await page.mouse.up();
    // The device has friction of its own.
    await untilForce(at, "below 0.1 N", (force_N) => force_N < 0.1);
    await states(page, 60);
    expect((await felt(at)).force_N).toBeLessThan(0.1);
  });

  test("leaves no console errors, and asks nobody else", () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign).toEqual([]);
  });
});
