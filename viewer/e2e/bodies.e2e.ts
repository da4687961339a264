// Bodies, end to end: what the mouse pushes moves, on the page too, and its energy is reported to the joule.

import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { decodeServerMessage } from "../src/protocol";
import type { Bodies } from "../src/gen/hl_pb";
import type { Vec } from "../src/vec";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, openSection, pressModel, screenshot, states, untilTouched,
  type Complaints,
} from "./browser";
import { kProgram, startTouch, type Touch } from "./programs";

const kBlocks = fileURLToPath(new URL("../../scenes/examples/blocks.hl.json", import.meta.url));
/** Number of the block among the scene's objects. */
const kBlock = 1;

/** What motion, height and springs hold, J. */
const heldBy = (bodies: Bodies): number => bodies.kineticJ + bodies.gravityJ + bodies.springJ;
/** What has come in since the bodies began, J. */
const broughtTo = (bodies: Bodies): number =>
  bodies.byHandJ - bodies.contactJ - bodies.frictionJ - bodies.jointsJ + bodies.solverJ;

describe.skipIf(!kProgram)("hl touch with bodies", () => {
  let touch: Touch;
  let browser: Browser;
  let page: Page;
  let complaints: Complaints;
  const received: Bodies[] = [];
  const record = () => page.evaluate(() => document.getElementById("record")!.click());
  const block = () => page.evaluate((number) => window.__hl.originOf(number), kBlock);
  const folder = mkdtempSync(join(tmpdir(), "hl-e2e-"));
  let pushed: { begin: Vec; end: Vec };

  beforeAll(async () => {
    touch = await startTouch(0, kBlocks);
    browser = await launch();
    page = await browser.newPage(kWindow);
    complaints = listen(page, touch.url);
    page.on("websocket", (socket) => {
      socket.on("framereceived", ({ payload }) => {
        const message = decodeServerMessage(new Uint8Array(Buffer.from(payload)));
        if (message.kind === "state" && message.state.bodies !== undefined) received.push(message.state.bodies);
      });
    });
    await page.goto(touch.url);
    await page.waitForFunction(() => window.__hl.objects === 3 && window.__hl.samples > 100);
  });

  afterAll(async () => {
    await browser?.close();
    touch?.process.kill("SIGKILL");
    rmSync(folder, { recursive: true });
  });

  test("are counted, in cards that fit", async () => {
    await expect.poll(() => page.textContent("#bodies-count")).toMatch(/of\s2\sawake/);
    for (const size of kSizes) await expectTidyLayout(page, size);
  });

  test("a block that the hand pushes moves", async () => {
    await record();
    await expect.poll(() => page.textContent("#record-told")).toMatch(/^Recording: /);
    const begin = await block();
    await page.uncheck("#explore");
    const { from, to } = await page.evaluate((block) => {
      const at = window.__hl.originOf(block);
      return { from: window.__hl.project(at), to: window.__hl.project({ ...at, x: at.x + 0.06 }) };
    }, kBlock);
    await pressModel(page, from);
    await untilTouched(page);
    const steps = 40;
    for (let i = 1; i <= steps; ++i) {
      await page.mouse.move(from.x + (i / steps) * (to.x - from.x), from.y + (i / steps) * (to.y - from.y));
      await states(page);
    }
    await screenshot(page, "bodies_pushed");
    await page.mouse.up();
    await states(page, 5);
    const end = await block();
    pushed = { begin, end };
    expect(Math.hypot(end.x - begin.x, end.z - begin.z)).toBeGreaterThan(0.003);
    expect(end.y).toBeGreaterThan(0.0199);
  });

  test("their energy is what hands gave less what was lost", async () => {
    await states(page, 5);
    const [first, last] = [received[0]!, received.at(-1)!];
    expect(last.byHandJ).toBeGreaterThan(1e-5);
    expect(last.frictionJ).toBeGreaterThan(1e-5);
    expect(heldBy(last) - heldBy(first)).toBeCloseTo(broughtTo(last) - broughtTo(first), 9);
  });

  test("are in the saved scene, which hl opens with the same bodies and joints", async () => {
    await openSection(page, "more");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-scene")]);
    const file = join(folder, "saved.hl.json");
    await download.saveAs(file);
    const infoOf = (scene: string) => execFileSync(kProgram!, ["info", scene], { encoding: "utf8" })
      .split("\n").filter((line) => /^(body|joint|gravity)/.test(line));
    // A door that was pushed has its range from where it is.
    const width = (line: string) => line.replace(/(-?[\d.]+) \.\. (-?[\d.]+) rad/,
      (_, low, high) => `a range of ${(Number(high) - Number(low)).toFixed(2)} rad`);
    const begin = infoOf(kBlocks).map(width);
    expect(begin).toHaveLength(4);
    expect(infoOf(file).map(width)).toEqual(begin);
  });

  test("are drawn on the timeline of a recording where they were", async () => {
    const [download] = await Promise.all([page.waitForEvent("download"), record()]);
    const file = join(folder, "session.hlr");
    await download.saveAs(file);
    expect(execFileSync(kProgram!, ["replay", file], { encoding: "utf8" })).toContain("reproduced: bit for bit");
    await page.setInputFiles("#file", file);
    await page.waitForSelector("#timeline:visible");
    const off_m = (from: Vec, to: Vec) => Math.hypot(from.x - to.x, from.y - to.y, from.z - to.z);
    await page.keyboard.press("End");
    await expect.poll(async () => off_m(await block(), pushed.end)).toBeLessThan(1e-4);
    await page.keyboard.press("Home");
    await expect.poll(async () => off_m(await block(), pushed.begin)).toBeLessThan(1e-4);
    await page.keyboard.press("Escape");
    await expect.poll(async () => off_m(await block(), pushed.end)).toBeLessThan(1e-4);
  });

  test("without an error, and without asking anybody else", () => {
    expect(complaints.errors).toEqual([]);
    expect(complaints.foreign).toEqual([]);
  });
});
