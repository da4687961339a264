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
import { launch, listen, screenshot, type Complaints } from "./browser";

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
});
