// What the panels show and for whom: materials by name, a spring that vibrates, another model, a telephone, a screen
// reader, forced colours. Against a stand-in server.

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { PageRecording_Phase } from "../src/gen/hl_pb";
import { FakeServer } from "../test-support/fake_server";
import {
  expectTidyLayout, kSizes, kWindow, launch, listen, openSection, resize, screenshot, states, type Complaints,
} from "./browser";

const kPhone = { width: 390, height: 844 };
const kTarget_px = 44;

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

test("materials that people know set the sliders, say where they are from, and follow the server", async () => {
  await openSection(page, "surface");
  await page.selectOption("#material", "Rubber");
  await expect.poll(() => server.surfaces).toMatchObject({ stiffness: 0.6, staticFriction: 1, dynamicFriction: 0.8 });
  // The stand-in knows nothing of adhesion, so it is sent nothing of it.
  expect(server.surfaces.adhesionN).toBeUndefined();
  expect(await page.textContent("#material-origin")).toMatch(/measured/);
  await expectTidyLayout(page, kSizes[0]);
  await screenshot(page, "panels_rubber");
  await page.locator("#material").blur();
  await page.fill("#surface-static-friction", "0.3");
  await expect.poll(() => page.inputValue("#material")).toBe("own");
  expect(await page.textContent("#material-origin")).toBe("");
  await page.click("#surface-reset");
  await expect.poll(() => page.inputValue("#material")).toBe("scene");
  await expect.poll(() => server.surfaces.stiffness).toBeUndefined();
});

test("a force that vibrates is reported, with the device's limit in the plot, until it has ceased", async () => {
  expect(await page.locator("[data-cause=vibration]").count()).toBe(0);
  server.shaking = true;
  await page.waitForSelector("[data-cause=vibration]");
  expect(await page.textContent("[data-cause=vibration]")).toMatch(/vibrates by 8\.5.N at \d+.Hz/);
  for (const size of kSizes) {
    await expectTidyLayout(page, size);
  }
  await resize(page, kSizes[0]);
  await screenshot(page, "panels_vibration");
  server.shaking = false;
  await page.waitForSelector("[data-cause=vibration]", { state: "detached" });
});

test("a spring that the server holds below what is set is shown at its slider", async () => {
  server.held_N_m = 563.6;
  await expect.poll(() => page.textContent("#stiffness-value")).toMatch(/^1.000.N\/m, held at 564$/);
  expect(await page.textContent("#softened")).toMatch(/held below 564/);
  server.held_N_m = 0;
  await expect.poll(() => page.textContent("#stiffness-value")).toMatch(/^1.000.N\/m$/);
});

test("the iso value that was set stays until the server has it, however long that takes and whatever comes before", async () => {
  const say = (iso: number) => {
    server.volumes = [{ placed: 0, surface: 7n, iso, low: -1000, high: 2000 }];
    server.place(1);
  };
  const value = () => page.inputValue("#iso-1").then(Number);
  say(-500);
  await expect.poll(value).toBe(-500);
  await page.fill("#iso-1", "-200");
  await expect.poll(() => server.received.some(({ body }) => body.case === "iso" && body.value.value === -200)).toBe(true);
  const from_s = await page.evaluate(() => window.__hl.time_s!);
  await page.waitForFunction((time_s) => window.__hl.time_s! > time_s + 3, from_s);
  for (const between of [-500, -400]) {
    const before = await page.evaluate(() => window.__hl.layout!);
    say(between);
    await page.waitForFunction((layout) => window.__hl.layout! > layout, before);
    await states(page, 30);
    expect(await value()).toBe(-200);
  }
  const before = await page.evaluate(() => window.__hl.layout!);
  say(-200);
  await page.waitForFunction((layout) => window.__hl.layout! > layout, before);
  say(100);
  await expect.poll(value).toBe(100);
  server.volumes = [];
  server.place(1);
  await expect.poll(() => page.locator("#iso-1").count()).toBe(0);
});

test("a screen reader hears what is touched, seldom, and no number that runs", async () => {
  server.explore = true;
  const said = await page.evaluate(async () => {
    const heard: { text: string; at_ms: number }[] = [];
    const target = document.getElementById("announce")!;
    new MutationObserver(() => heard.push({ text: target.textContent!, at_ms: performance.now() }))
      .observe(target, { childList: true, characterData: true, subtree: true });
    const start_ms = performance.now();
    while (performance.now() - start_ms < 9000 && heard.length < 3) {
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    return heard;
  });
  expect(said.length).toBeGreaterThanOrEqual(2);
  said.forEach(({ text }) => expect(text).toMatch(/^touching (the model, \d\.\d N|nothing)$/));
  const gaps_ms = said.slice(1).map(({ at_ms }, i) => at_ms - said[i]!.at_ms);
  expect(Math.min(...gaps_ms)).toBeGreaterThan(1900);
  const outputs = await page.locator("output").evaluateAll((all) => all.map((one) => one.getAttribute("aria-live")));
  expect(new Set(outputs)).toEqual(new Set(["off"]));
});

test("has one heading of the first rank, and the view can take the focus", async () => {
  expect(await page.locator("h1").allTextContents()).toEqual(["sphere"]);
  await page.focus("#canvas");
  expect(await page.evaluate(() => document.activeElement?.id)).toBe("canvas");
});

/** Waits for states of a server that has begun with so many objects. */
const shown = (objects: number) =>
  page.waitForFunction(
    (count) => window.__hl.link === "live" && window.__hl.objects === count && window.__hl.samples > 50, objects,
  );

test("another model at the same address is fitted anew, the same one leaves the view as it is", async () => {
  const place = () => page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0.05 }));
  await page.keyboard.press("r");
  await states(page, 30);
  await page.mouse.move(640, 100);
  await page.mouse.down({ button: "right" });
  await page.mouse.move(700, 100, { steps: 3 });
  await page.mouse.up({ button: "right" });
  await states(page, 60);
  const before = await place();
  server.begin("sphere", 1);
  await shown(1);
  // The camera is computed anew in each frame: its last bits may change.
  const { x, y } = await place();
  expect(x).toBeCloseTo(before.x, 6);
  expect(y).toBeCloseTo(before.y, 6);
  server.begin("two spheres", 2);
  await shown(2);
  // Both are in the part of the window that the cards leave free.
  const far = await page.evaluate(() => window.__hl.project({ x: 0.2, y: 0, z: 0 }));
  expect(far.x).toBeLessThan(940);
  server.begin("sphere", 1);
  await shown(1);
});

test("on a telephone nothing overflows, the force is in the view, and targets are large", async () => {
  const context = await browser.newContext({ viewport: kPhone, hasTouch: true, isMobile: true, colorScheme: "dark" });
  const phone = await context.newPage();
  await phone.goto(server.url);
  await phone.waitForFunction(() => window.__hl.samples > 50);
  expect(await phone.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(kPhone.width);
  await expect.poll(() => phone.textContent("#force-badge")).toMatch(/\d\.\d\d.N/);
  await screenshot(phone, "panels_phone_top");
  await openSection(phone, "view");
  await phone.locator("#help-open").scrollIntoViewIfNeeded();
  const badge = (await phone.locator("#force-badge").boundingBox())!;
  expect(badge.y).toBeGreaterThanOrEqual(0);
  await screenshot(phone, "panels_phone");
  const small = await phone.evaluate((least) =>
    ["button", "summary", "select", ".switch", ".inline", ".segments label", "input[type=range]"]
      .flatMap((kind) => [...document.querySelectorAll<HTMLElement>(`#controls ${kind}`)])
      .filter((target) => target.offsetParent !== null && target.getBoundingClientRect().height < least)
      .map((target) => `${target.id || target.textContent} ${target.getBoundingClientRect().height}`), kTarget_px);
  expect(small).toEqual([]);
  await context.close();
});

test("in small windows the cards scroll and the page does not, whatever is open and has the focus", async () => {
  const small = await browser.newPage({ viewport: { width: 800, height: 600 }, colorScheme: "dark" });
  listen(small, server.url);
  await small.goto(server.url);
  await small.waitForFunction(() => window.__hl.samples > 50);
  for (const size of [{ width: 800, height: 600 }, { width: 390, height: 700 }, { width: 640, height: 400 }]) {
    await resize(small, size);
    for (const section of ["surface", "view", "more"] as const) {
      await openSection(small, section);
      const { page_px, moved } = await small.evaluate(() => {
        const moved: string[] = [];
        for (const control of document.querySelectorAll<HTMLElement>("button, input, select, summary, canvas, [tabindex]")) {
          control.focus();
          if (window.scrollY !== 0) moved.push(control.id || control.textContent!);
        }
        return { page_px: document.documentElement.scrollHeight, moved };
      });
      expect(page_px, `${section} at ${size.width}x${size.height}`).toBe(size.height);
      expect(moved, `${section} at ${size.width}x${size.height}`).toEqual([]);
    }
    await screenshot(small, `panels_${size.width}x${size.height}`);
  }
  await small.close();
});

test("in small windows hints, key, scale and notices leave each other and the model in sight", async () => {
  const small = await browser.newPage({ viewport: { width: 1000, height: 500 }, colorScheme: "dark" });
  listen(small, server.url);
  await small.goto(server.url);
  await small.waitForFunction(() => window.__hl.samples > 50);
  server.shaking = true;
  await small.waitForSelector("[data-cause=vibration]");
  const box = async (selector: string) => (await small.locator(selector).boundingBox())!;
  for (const size of [{ width: 1000, height: 500 }, { width: 920, height: 600 }]) {
    await resize(small, size);
    const hints = await box("#hints");
    for (const above of ["#key", "#scale-bar"]) {
      const { y, height } = await box(above);
      expect(y + height, `${above} at ${size.width}x${size.height}`).toBeLessThanOrEqual(hints.y);
    }
    expect((await box("[data-cause=vibration]")).height).toBeLessThan(0.25 * size.height);
    await screenshot(small, `panels_notice_${size.width}x${size.height}`);
  }
  for (const size of [{ width: 390, height: 700 }, { width: 640, height: 400 }]) {
    await resize(small, size);
    const view = await box("#view");
    expect((await box("[data-cause=vibration]")).y).toBeGreaterThanOrEqual(view.y + view.height);
    await screenshot(small, `panels_notice_${size.width}x${size.height}`);
  }
  server.shaking = false;
  await small.close();
});

test("with forced colours a choice and the keys of the plots are still seen", async () => {
  const context = await browser.newContext({ ...kWindow, forcedColors: "active" });
  const forced = await context.newPage();
  await forced.goto(server.url);
  await forced.waitForFunction(() => window.__hl.samples > 50);
  const { chosen, other, key } = await forced.evaluate(() => {
    const background = (selector: string) => getComputedStyle(document.querySelector(selector)!).backgroundColor;
    return {
      chosen: background("input[name=theme]:checked + span"),
      other: background("input[name=theme]:not(:checked) + span"),
      key: background(".key.force"),
    };
  });
  expect(chosen).not.toBe(other);
  expect(key).not.toBe("rgba(0, 0, 0, 0)");
  await screenshot(forced, "panels_forced_colours");
  await context.close();
});

test("a scene on its way is reported until it is there, the first one and one that a file brings", async () => {
  const late = await FakeServer.start();
  late.withholding = true;
  late.uploadBytes = 1000n;
  const waiting = await browser.newPage({ ...kWindow, colorScheme: "dark" });
  listen(waiting, late.url);
  await waiting.goto(late.url);
  const line = '[data-cause="receiving"]';
  await waiting.waitForSelector(line);
  expect(await waiting.textContent("#model-size")).toBe("not received yet");
  late.sendMesh();
  await expect.poll(() => waiting.textContent(line)).toMatch(/^Receiving the scene… 16.384.triangles so far$/);
  await screenshot(waiting, "panels_receiving");
  late.sendScene();
  await waiting.waitForSelector(line, { state: "detached" });
  const opened = { name: "other", triangles: 0, primitives: 170688, world_per_device: 1, warnings: [] };
  await waiting.route("**/upload?*", (route) => route.fulfill({ json: opened }));
  await waiting.setInputFiles("#file", { name: "a.obj", mimeType: "", buffer: Buffer.from("v 0 0 0") });
  await waiting.waitForSelector(line);
  expect(await waiting.textContent(".notice.told span")).toMatch(/^other: 170.688 primitives; /);
  late.name = "other";
  late.place(1);
  await waiting.waitForSelector(line, { state: "detached" });
  await waiting.close();
  await late.close();
});

test("without the server nothing takes input that only it could act on, and no number of before stands as one of now", async () => {
  server.explore = true;
  await page.waitForFunction(() => window.__hl.contacts > 0);
  await expect.poll(() => page.textContent("#force")).toMatch(/\d\.\d\d.N/);
  for (const section of ["surface", "more"] as const) {
    await openSection(page, section);
    expect(await page.isEnabled("#stiffness"), "with a server").toBe(true);
  }
  const { port } = server;
  const controls = ["#grip-firm", "#explore", "#stiffness", "#material", "#surface-static-friction", "#shading",
    "#surface-reset", "#ledger-strict", "#save-scene", "#record"];
  const enabled = () => page.evaluate((ids) =>
    ids.filter((id) => document.querySelector(id)!.matches(":enabled")), controls);
  server.recording = { phase: PageRecording_Phase.NONE };
  await expect.poll(enabled).toEqual(controls);
  await server.close();
  await page.waitForFunction(() => window.__hl.link === "lost");
  expect(await enabled()).toEqual([]);
  const measured = await page.evaluate(() =>
    [...document.querySelectorAll("#force-badge, #readouts .live-only :is(output, td, dd)")].map((e) => e.textContent));
  expect(measured.length).toBeGreaterThan(20);
  expect(new Set(measured)).toEqual(new Set(["–"]));
  // What is of the page alone goes on.
  expect(await page.isEnabled("#edges")).toBe(true);
  await screenshot(page, "panels_lost");
  server = await FakeServer.start(port);
  server.recording = { phase: PageRecording_Phase.NONE };
  await page.waitForFunction(() => window.__hl.link === "live");
  await expect.poll(enabled).toEqual(controls);
  await expect.poll(() => page.textContent("#force")).toMatch(/\d\.\d\d.N/);
});

test("no console errors, and nothing from outside addresses", () => {
  expect(complaints.errors).toEqual([]);
  expect(complaints.foreign).toEqual([]);
});
