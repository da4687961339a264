// What the panels tell and for whom: materials by name, a spring that vibrates, another model, a telephone, a screen
// reader, forced colours. Against a stand-in server.

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { FakeServer } from "../test-support/fake_server";
import {
  expectTidyLayout, kSizes, launch, listen, openSection, resize, screenshot, states, type Complaints,
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
  page = await browser.newPage({ viewport: kSizes[0], colorScheme: "dark" });
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
  // The stand-in knows nothing of adhesion, so it is told nothing of it.
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

test("a force that vibrates is told, with the device's limit in the plot, and no more when it has ceased", async () => {
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

test("a spring that the server holds below what is set is told at its slider", async () => {
  server.held_N_m = 563.6;
  await expect.poll(() => page.textContent("#stiffness-value")).toMatch(/^1.000.N\/m, held at 564$/);
  expect(await page.textContent("#softened")).toMatch(/held below 564/);
  server.held_N_m = 0;
  await expect.poll(() => page.textContent("#stiffness-value")).toMatch(/^1.000.N\/m$/);
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
  expect(await place()).toEqual(before);
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

test("with forced colours a choice and the keys of the plots are still seen", async () => {
  const context = await browser.newContext({ viewport: kSizes[0], forcedColors: "active" });
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

test("no console errors, and nothing from outside addresses", () => {
  expect(complaints.errors).toEqual([]);
  expect(complaints.foreign).toEqual([]);
});
