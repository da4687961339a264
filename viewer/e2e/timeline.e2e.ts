// What the timeline takes the place of, and gives back: the hand, notices, the hint of an empty scene; and a finger on
// its plots. Against a stand-in server, with recordings made by the test.

import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect, test } from "vitest";
import { PageRecording_Phase } from "../src/gen/hl_pb";
import { FakeServer } from "../test-support/fake_server";
import { fileOf, kStart, kWhole, steps as recordedSteps, type BlockBody } from "../test-support/recording_bytes";
import { kWindow, launch, listen, openSection, screenshot, type Complaints } from "./browser";

const kPhone = { width: 390, height: 844 };
const kBlackBox: BlockBody = {
  case: "start", value: { ...(kStart.value as object), blackBox: true, fault: "it was too fast" },
};

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
  await page.waitForFunction(() => window.__hl.samples > 50);
});

afterAll(async () => {
  await browser?.close();
  await server?.close();
});

afterEach(async () => {
  await page.mouse.up();
  await page.keyboard.press("Escape");
});

async function show(target: Page, bodies: readonly BlockBody[]): Promise<void> {
  const buffer = Buffer.from(await fileOf(...bodies).arrayBuffer());
  await target.setInputFiles("#file", { name: "a.hlr", mimeType: "", buffer });
  await target.waitForSelector("#timeline:visible");
}

test("a hand that is held when a recording opens is let go", async () => {
  const releases = () => server.received.filter(({ body }) => body.case === "release").length;
  const { x, y } = await page.evaluate(() => window.__hl.project(window.__hl.proxy!));
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.waitForFunction(() => window.__hl.holding);
  const before = releases();
  await show(page, kWhole);
  await expect.poll(releases).toBe(before + 1);
});

test("what is reported of the live force is away with it", async () => {
  server.shaking = true;
  await page.waitForSelector("[data-cause=vibration]");
  await show(page, kWhole);
  expect(await page.locator("[data-cause=vibration]").count()).toBe(0);
  server.shaking = false;
});

test("a black box does not ask for a client to bring objects", async () => {
  await show(page, [kBlackBox, recordedSteps(31)]);
  await page.waitForFunction(() => window.__hl.sceneName === "black box");
  expect(await page.isVisible("#empty")).toBe(false);
  expect(await page.textContent("#proxy-radius")).toBe("–");
  await screenshot(page, "timeline_black_box");
});

test("a black box shows the finger", async () => {
  await show(page, [kBlackBox, recordedSteps(31)]);
  await page.waitForFunction(() => window.__hl.sceneName === "black box");
  const { x, y } = await page.evaluate(() => window.__hl.project({ x: 0, y: 0, z: 0 }));
  const clip = { x: x - 4, y: y - 4, width: 8, height: 8 };
  const picture = async () => (await page.screenshot({ clip })).toString("base64");
  await page.keyboard.press("Home");
  await page.waitForFunction(() => window.__hl.finger?.x === 0);
  const there = await picture();
  await page.keyboard.press("End");
  await page.waitForFunction(() => window.__hl.finger!.x > 0.2);
  await expect.poll(picture).not.toBe(there);
});

test("a second recording takes the place of the first, and the live scene comes back after it", async () => {
  await show(page, kWhole);
  await show(page, [kBlackBox, recordedSteps(31)]);
  await page.waitForFunction(() => window.__hl.sceneName === "black box");
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => window.__hl.sceneName === "sphere" && window.__hl.triangles > 1000);
});

test("what was reported of a recording is not shown while the server is silent", async () => {
  server.recording = { phase: PageRecording_Phase.RUNNING, owner: 5, timeS: 1, bytes: 1n, maxTimeS: 600, maxBytes: 9n };
  await openSection(page, "more");
  await page.waitForSelector("#record-told:visible");
  server.recording = { phase: PageRecording_Phase.NONE };
  await page.waitForSelector("#record:enabled");
  server.silent = true;
  await page.waitForSelector("#record:disabled");
  server.silent = false;
  await page.waitForSelector("#record:enabled");
});

test("on a phone a notice leaves the force in sight", async () => {
  const phone = await browser.newPage({ viewport: kPhone });
  await phone.goto(server.url);
  await phone.waitForFunction(() => window.__hl.samples > 50);
  await phone.setInputFiles("#file", { name: "a.hlr", mimeType: "", buffer: Buffer.from("no recording") });
  const badge = (await phone.locator("#force-badge").boundingBox())!;
  const notice = (await phone.locator(".notice.told").boundingBox())!;
  expect(notice.y).toBeGreaterThanOrEqual(badge.y + badge.height);
  await screenshot(phone, "timeline_notice_phone");
  await phone.close();
});

test("on a touch screen a finger that is drawn along a plot goes through the times", async () => {
  const phone = await browser.newPage({ viewport: kPhone, hasTouch: true, isMobile: true });
  await phone.goto(server.url);
  await phone.waitForFunction(() => window.__hl.samples > 50);
  await show(phone, kWhole);
  const plot = phone.locator("#plot-recorded-force");
  await plot.scrollIntoViewIfNeeded();
  const { x, y, width, height } = (await plot.boundingBox())!;
  const client = await phone.context().newCDPSession(phone);
  const touch = (type: "touchStart" | "touchMove" | "touchEnd", share: number) => client.send("Input.dispatchTouchEvent", {
    type, touchPoints: type === "touchEnd" ? [] : [{ x: x + 52 + share * (width - 68), y: y + height / 2 }],
  });
  await touch("touchStart", 0.1);
  for (let share = 0.1; share < 0.9; share += 0.2) await touch("touchMove", share);
  await touch("touchMove", 0.9);
  await phone.waitForFunction(() => window.__hl.recording!.time_s > 2.5);
  await touch("touchEnd", 0.9);
  const slider = (await phone.locator("#timeline-at").boundingBox())!;
  expect(slider.height).toBeGreaterThanOrEqual(44);
  await screenshot(phone, "timeline_touch");
  await phone.close();
});

test("a drag along a plot goes on beside the plot", async () => {
  await show(page, kWhole);
  const { x, y, width, height } = (await page.locator("#plot-recorded-force").boundingBox())!;
  await page.mouse.move(x + 52 + (width - 68) / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2, y - 40);
  await page.mouse.move(x - 100, y - 40);
  await page.waitForFunction(() => window.__hl.recording!.time_s === 0);
});

test("no console errors, and nothing from outside addresses", () => {
  expect(complaints.errors).toEqual([]);
  expect(complaints.foreign.filter((url) => !url.startsWith(`blob:${server.url.slice(0, -1)}`))).toEqual([]);
});
