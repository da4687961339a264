// The page alone, against a stand-in server that does on command what a real one does rarely.

import { create } from "@bufbuild/protobuf";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { LedgerMode, SurfacesSchema, TicksEndedSchema } from "../src/gen/hl_pb";
import { FakeServer } from "../test-support/fake_server";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, modelPixels, openSection, resize, screenshot, states, turnWheel,
  type Complaints,
} from "./browser";

let browser: Browser;
let server: FakeServer;
let page: Page;
let complaints: Complaints;

beforeAll(async () => {
  browser = await launch();
  server = await FakeServer.start();
  page = await browser.newPage({ ...kWindow, colorScheme: "dark" });
  complaints = listen(page, server.url);
  await page.goto(server.url);
  await page.waitForFunction(() => window.__hl.samples > 100);
});

afterAll(async () => {
  await browser?.close();
  await server?.close();
});

/** Draws until the camera's own motion has died away. */
function atRest(): Promise<void> {
  return page.evaluate(async () => {
    const x = () => window.__hl.project({ x: 0, y: 0, z: 0.05 }).x;
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    for (let last = NaN, still = 0; still < 5; ) {
      await frame();
      still = Math.abs(x() - last) < 0.01 ? still + 1 : 0;
      last = x();
    }
  });
}

test("shows the model, and panels that do not overlap, in dark and light at both sizes", async () => {
  expect(await modelPixels(page)).toBeGreaterThan(0.05);
  await openSection(page, "view");
  await page.check("#planes");
  await page.check("#cones");
  for (const theme of ["dark", "light"]) {
    await page.click(`label:has(input[name=theme][value=${theme}])`);
    server.slipping = theme === "light";
    for (const size of kSizes) {
      for (const section of ["view", "surface"] as const) {
        await openSection(page, section);
        await expectTidyLayout(page, size);
      }
      await screenshot(page, `page_${theme}_${size.width}x${size.height}`);
    }
    await openSection(page, "view");
  }
});

test("gives a usable page in a small window", async () => {
  await resize(page, { width: 700, height: 600 });
  const widest = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(widest).toBeLessThanOrEqual(700);
  const middle = await page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0 }));
  expect(middle.x).toBeCloseTo(350, 0);
  await screenshot(page, "page_small");
  await resize(page, kSizes[0]);
});

test("remembers the theme that was chosen", async () => {
  await openSection(page, "view");
  await page.click("label:has(input[name=theme][value=light])");
  await page.reload();
  expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe("light");
  await openSection(page, "view");
  await page.click("label:has(input[name=theme][value=system])");
  expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe("dark");
  await page.waitForFunction(() => window.__hl.samples > 10);
});

test("settings reach the server: exploration, grip, stiffness within the device's limits", async () => {
  await expect.poll(() => page.isChecked("#explore")).toBe(true);
  await page.keyboard.press("e");
  await expect.poll(() => server.explore).toBe(false);
  await page.click("label:has(#grip-firm)");
  await expect.poll(() => server.handFirm).toBe(true);
  expect(await page.getAttribute("#stiffness", "max")).toBe("3500");
  await page.fill("#stiffness", "2000");
  await expect.poll(() => server.stiffness_N_m).toBe(2000);
  await expect.poll(() => page.textContent("#stiffness-value")).toMatch(/2.000.N\/m/);
});

test("surface controls reach the server whole, and what the server says moves them", async () => {
  await openSection(page, "surface");
  const texts = () => page.locator("#surface-fold output").allTextContents();
  expect(await texts()).toEqual(["scene", "scene", "scene", "scene"]);
  const shading = () => page.locator("#shading").evaluate((box: HTMLInputElement) =>
    box.indeterminate ? "dashed" : box.checked ? "ticked" : "not ticked");
  expect(await shading(), "the sphere of the scene is flat").toBe("not ticked");
  await page.fill("#surface-static-friction", "0.8");
  await page.fill("#surface-viscosity", "5");
  await page.check("#shading");
  await page.uncheck("#textures");
  await expect.poll(() => server.surfaces).toMatchObject({
    staticFriction: 0.8, viscosityNsM: 5, smooth: true, textures: false,
  });
  expect(server.surfaces.stiffness).toBeUndefined();
  server.surfaces = create(SurfacesSchema, { stiffness: 0.5, dynamicFriction: 0.25 });
  await expect.poll(texts).toEqual(["0.50", "scene", "0.25", "scene"]);
  await page.click("#surface-reset");
  await expect.poll(() => server.surfaces).toEqual(create(SurfacesSchema));
  await expect.poll(texts).toEqual(["scene", "scene", "scene", "scene"]);
  expect(await shading()).toBe("not ticked");
});

test("a slider under the pointer stays where it is, whatever another page sets", async () => {
  await openSection(page, "surface");
  const box = (await page.locator("#surface-static-friction").boundingBox())!;
  const value = () => page.inputValue("#surface-static-friction").then(Number);
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await expect.poll(() => server.surfaces.staticFriction).toBeCloseTo(0.75, 1);
  const held = await value();
  server.surfaces = create(SurfacesSchema, { staticFriction: 1.4 });
  const from_s = await page.evaluate(() => window.__hl.time_s!);
  // Longer than the page waits for any echo.
  await page.waitForFunction((time_s) => window.__hl.time_s! > time_s + 3, from_s);
  expect(await value()).toBe(held);
  await page.mouse.up();
  await expect.poll(value).toBe(1.4);
  server.surfaces = create(SurfacesSchema);
});

test("ticks that were cut short are counted, and a tooltip says why all of them ended", async () => {
  const texts = () => Promise.all(["caps", "out-of-work", "unplaced"].map((id) => page.textContent(`#${id}`)));
  await expect.poll(texts).toEqual(["0", "0", "0"]);
  server.ticksEnded = create(TicksEndedSchema, { reached: 7n, crowded: 1n, capped: 2n, outOfWork: 4n, unplaced: 5n });
  await expect.poll(texts).toEqual(["3", "4", "5"]);
  expect(await page.getAttribute("#ticks-ended", "title")).toBe(
    "Ticks by why they ended: reached 7, crowded 1, capped 2, out of work 4, unplaced 5",
  );
  const many = 999_999n;
  server.ticksEnded = create(TicksEndedSchema, { capped: many, outOfWork: many, unplaced: many });
  await expect.poll(() => page.textContent("#unplaced")).toMatch(/^999.999$/);
  await expectTidyLayout(page, kSizes[0]);
  server.ticksEnded = create(TicksEndedSchema);
});

test("the ledger: its mode, its tank, and a line for every cause", async () => {
  await openSection(page, "surface");
  await page.click("label:has(#ledger-report)");
  await expect.poll(() => server.ledger).toBe(LedgerMode.REPORT);
  await expect.poll(() => page.getAttribute("#tank-row", "class")).toMatch(/idle/);
  server.ledger = LedgerMode.TANK;
  await expect.poll(() => page.isChecked("#ledger-tank")).toBe(true);
  expect(await page.textContent("#tank")).toMatch(/^\d+\.\d of 50.mJ$/);
  expect(await page.locator("#plot-energy canvas").count()).toBe(1);
  expect(await page.locator("#plot-energy + .legend .key").count()).toBe(5);
});

test("the key C draws friction cones, in another colour while slipping", async () => {
  await openSection(page, "view");
  // On its way round the sphere the hand is stopped on the camera's side: a cone behind the sphere is not seen.
  const seen = () => page.evaluate(() => window.__hl.proxy!.z > 0.02);
  do {
    await page.check("#explore");
    await page.waitForFunction(() => window.__hl.proxy!.x < 0 && window.__hl.proxy!.z > 0.03);
    await page.uncheck("#explore");
    await states(page, 10);
  } while (!(await seen()));
  await page.uncheck("#cones");
  server.slipping = false;
  await states(page, 60);
  const { x, y } = await page.evaluate(() => window.__hl.project(window.__hl.proxy!));
  const picture = async () => {
    await states(page, 10);
    return page.screenshot({ clip: { x: x - 60, y: y - 60, width: 120, height: 120 } });
  };
  const without = await picture();
  expect((await picture()).equals(without)).toBe(true);
  await page.keyboard.press("c");
  await expect.poll(async () => (await picture()).equals(without), { timeout: 30_000 }).toBe(false);
  const sticking = await picture();
  server.slipping = true;
  await expect.poll(async () => (await picture()).equals(sticking), { timeout: 30_000 }).toBe(false);
  await page.check("#explore");
});

test("on a touch screen one finger drags the hand, a second one makes it a camera gesture", async () => {
  const context = await browser.newContext({ ...kWindow, hasTouch: true });
  const screen = await context.newPage();
  await screen.goto(server.url);
  await screen.waitForFunction(() => window.__hl.samples > 10);
  const cdp = await context.newCDPSession(screen);
  const touch = (type: "touchStart" | "touchMove" | "touchEnd", ...at: [number, number][]) =>
    cdp.send("Input.dispatchTouchEvent", { type, touchPoints: at.map(([x, y], id) => ({ x, y, id })) });
  const marker = () => screen.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0.05 }).x);
  const last = () => server.received.at(-1)?.body.case;
  server.received.length = 0;
  await touch("touchStart", [340, 600]);
  await touch("touchMove", [360, 600]);
  await expect.poll(last).toBe("handGoal");
  const before = await marker();
  await touch("touchStart", [360, 600], [460, 600]);
  await expect.poll(last).toBe("release");
  for (let i = 1; i <= 8; ++i) {
    await touch("touchMove", [360 + 10 * i, 600], [460 + 10 * i, 600]);
  }
  await expect.poll(async () => Math.abs((await marker()) - before)).toBeGreaterThan(5);
  await touch("touchEnd");
  expect(last()).toBe("release");
  await context.close();
});

test("on a touch screen a finger presses the model, and a second one changes the depth", async () => {
  const context = await browser.newContext({ ...kWindow, hasTouch: true });
  const screen = await context.newPage();
  await screen.goto(server.url);
  await screen.waitForFunction(() => window.__hl.samples > 10);
  const cdp = await context.newCDPSession(screen);
  const touch = (type: "touchStart" | "touchMove" | "touchEnd", ...at: [number, number][]) =>
    cdp.send("Input.dispatchTouchEvent", { type, touchPoints: at.map(([x, y], id) => ({ x, y, id })) });
  const at = await screen.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0 }));
  const goals = () => server.received.flatMap(({ body }) => (body.case === "handGoal" ? [body.value.position!] : []));
  const radius_m = () => Math.hypot(goals().at(-1)?.x ?? NaN, goals().at(-1)?.y ?? NaN, goals().at(-1)?.z ?? NaN);
  const separation_m = () => screen.evaluate(() => window.__hl.separation_m!);
  server.received.length = 0;
  await touch("touchStart", [at.x, at.y]);
  // The sphere of 50 mm, pressed 12 mm deep.
  await expect.poll(radius_m).toBeCloseTo(0.038, 3);
  await expect.poll(separation_m).toBeGreaterThan(0.01);
  await touch("touchStart", [at.x, at.y], [at.x + 80, at.y]);
  await touch("touchMove", [at.x, at.y], [at.x + 80, at.y - 40]);
  await expect.poll(radius_m).toBeLessThan(0.033);
  await touch("touchEnd");
  await expect.poll(() => server.received.at(-1)?.body.case).toBe("release");
  await context.close();
});

test("keys, the wheel and the release of the mouse move and let go of the hand", async () => {
  await page.keyboard.press("Escape");
  await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
  server.received.length = 0;
  const before = await page.evaluate(() => window.__hl.finger!);
  await page.keyboard.down("w");
  const goals = () => server.received.flatMap(({ body }) => (body.case === "handGoal" ? [body.value.position!] : []));
  const way_m = () => Math.hypot((goals().at(-1)?.x ?? NaN) - before.x, (goals().at(-1)?.z ?? NaN) - before.z);
  await expect.poll(way_m).toBeGreaterThan(1e-3);
  await page.keyboard.up("w");
  await expect.poll(() => server.received.at(-1)?.body.case).toBe("release");
  await page.mouse.move(640, 360);
  await page.mouse.down();
  await turnWheel(page, -300);
  await expect.poll(() => server.received.at(-1)?.body.case).toBe("handGoal");
  expect(await page.evaluate(() => window.__hl.holding)).toBe(true);
  await page.mouse.up();
  await expect.poll(() => server.received.at(-1)?.body.case).toBe("release");
});

test("right-drag, Shift-drag and, when chosen, drags on empty space orbit the camera and leave the hand alone", async () => {
  await page.waitForFunction(() => !window.__hl.exploring);
  server.received.length = 0;
  const marker = () => page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0.05 }).x);
  await atRest();
  const empty = { x: 330, y: 560 };
  const drag = async (button: "left" | "right") => {
    const before = await marker();
    await page.mouse.move(empty.x, empty.y);
    await page.mouse.down({ button });
    await page.mouse.move(empty.x + 60, empty.y, { steps: 4 });
    await page.mouse.up({ button });
    await atRest();
    return Math.abs((await marker()) - before);
  };
  expect(await drag("right")).toBeGreaterThan(5);
  await page.keyboard.down("Shift");
  expect(await drag("left")).toBeGreaterThan(5);
  await page.keyboard.up("Shift");
  await openSection(page, "view");
  await page.check("#empty-orbit");
  expect(await drag("left")).toBeGreaterThan(5);
  expect(server.received.map(({ body }) => body.case)).toEqual([]);
  await page.uncheck("#empty-orbit");
  expect(await drag("left")).toBeLessThan(0.5);
  expect(server.received.map(({ body }) => body.case)).toContain("handGoal");
  await page.click("#reset-view");
});

test("several objects are shown side by side, and the touched one has a tint", async () => {
  await openSection(page, "view");
  await page.uncheck("#cones");
  server.explore = true;
  server.place(3);
  await page.waitForFunction(() => window.__hl.objects === 3);
  await page.click("#reset-view");
  await atRest();
  expect(await page.textContent("#model-size")).toMatch(/^3\sobjects, /);
  await page.waitForFunction(() => window.__hl.touched.length === 1);
  await screenshot(page, "page_objects");
  server.place(0);
  await page.waitForSelector("#empty:visible");
  for (const size of kSizes) {
    await expectTidyLayout(page, size);
  }
  await resize(page, kSizes[0]);
  await screenshot(page, "page_empty");
  server.place(1);
  await page.waitForSelector("#empty", { state: "hidden" });
  await page.click("#reset-view");
});

test("the device's buttons appear when one is pressed, and say which are down", async () => {
  expect(await page.locator("#buttons:visible").count()).toBe(0);
  server.buttons = 0b10;
  await page.waitForSelector("#buttons:visible");
  expect(await page.locator("#buttons .lamp").allTextContents()).toEqual(["1", "2"]);
  expect(await page.locator("#buttons .lamp.down").allTextContents()).toEqual(["2"]);
  for (const size of kSizes) {
    await expectTidyLayout(page, size);
  }
  await resize(page, kSizes[0]);
  server.buttons = 0;
  await expect.poll(() => page.locator("#buttons .lamp.down").count()).toBe(0);
});

test("keys 1 to 4 press the buttons of a device that a simulated hand holds, as long as they are down", async () => {
  const lit = () => page.locator("#buttons .lamp.down").allTextContents();
  server.received.length = 0;
  await page.keyboard.down("2");
  await expect.poll(lit).toEqual(["2"]);
  await page.keyboard.down("1");
  await expect.poll(lit).toEqual(["1", "2"]);
  await page.keyboard.up("2");
  await expect.poll(lit).toEqual(["1"]);
  const presses = () => server.received.filter(({ body }) => body.case === "press").length;
  const before = presses();
  await expect.poll(presses).toBeGreaterThan(before + 1); // said again while it is down
  await page.evaluate(() => window.dispatchEvent(new Event("blur")));
  await expect.poll(lit).toEqual([]);
  await page.keyboard.up("1");
});

test("a fault shows its reason and can be re-armed", async () => {
  server.fault = "the target is 50 ms old";
  await page.waitForSelector("#rearm:visible");
  expect(await page.textContent("#fault")).toBe("the target is 50 ms old");
  for (const size of kSizes) {
    await expectTidyLayout(page, size);
  }
  await resize(page, kSizes[0]);
  await screenshot(page, "page_fault");
  await page.click("#rearm");
  await page.waitForSelector("#rearm", { state: "hidden" });
  expect(server.fault).toBe("");
});

test("a server that says nothing, or speaks nonsense, is reported to the user and the page recovers", async () => {
  server.silent = true;
  await page.waitForSelector("[data-cause=link]");
  server.silent = false;
  await page.waitForSelector("[data-cause=link]", { state: "detached" });
  server.sendRaw(Uint8Array.of(0x12, 0xff, 0x01));
  await page.waitForSelector(".notice.told");
  await page.waitForFunction(() => window.__hl.link === "live", undefined);
  await page.click(".notice.told button");
});

test("the help opens and closes", async () => {
  await page.keyboard.press("?");
  await page.waitForSelector("#help[open]");
  await screenshot(page, "page_help");
  await page.keyboard.press("Escape");
  await page.waitForSelector("#help:not([open])", { state: "attached" });
});

test("moves nothing when a person holds the device, and lets every drag orbit", async () => {
  server.simulatedHand = false;
  await page.reload();
  await page.waitForFunction(() => window.__hl.samples > 10);
  for (const id of ["#explore", "#grip-light", "#empty-orbit"]) {
    expect(await page.locator(id).isVisible()).toBe(false);
  }
  await expectTidyLayout(page, kSizes[0]);
  await screenshot(page, "page_person");
  await atRest();
  const before = await page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0.05 }));
  const sent = server.received.length;
  const at = await page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0 }));
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 80, at.y, { steps: 5 });
  await page.mouse.up();
  await page.keyboard.press("KeyW");
  await page.keyboard.press("KeyE");
  await atRest();
  const after = await page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0.05 }));
  expect(Math.hypot(after.x - before.x, after.y - before.y)).toBeGreaterThan(5);
  expect(server.received.length).toBe(sent);
  server.simulatedHand = true;
  await page.reload();
  await page.waitForFunction(() => window.__hl.samples > 10);
  expect(await page.locator("#explore").isVisible()).toBe(true);
});

test("no console errors, and nothing from outside addresses", () => {
  expect(complaints.errors).toEqual([]);
  expect(complaints.foreign).toEqual([]);
});
