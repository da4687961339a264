// What a model's file says of its look is seen: colours and pictures, each on the side that it is meant for.

import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { deflateSync } from "node:zlib";
import type { Page } from "playwright-core";
import { describe, expect, test } from "vitest";
import { crc32 } from "../src/timeline/recording_blocks";
import { kWindow, launch, listen, screenshot } from "./browser";
import { kProgram, startTouch } from "./programs";

type Pixel = readonly [number, number, number];

/** A PNG file of whole colours, the upper row first. */
function png(rows: readonly (readonly Pixel[])[]): Uint8Array {
  const chunk = (type: string, data: Uint8Array) => {
    const body = Buffer.concat([Buffer.from(type), data]);
    const ends = Buffer.alloc(8);
    ends.writeUInt32BE(data.length, 0);
    ends.writeUInt32BE(crc32(body), 4);
    return Buffer.concat([ends.subarray(0, 4), body, ends.subarray(4)]);
  };
  const header = Buffer.from([0, 0, 0, rows[0]!.length, 0, 0, 0, rows.length, 8, 2, 0, 0, 0]);
  const pixels = Buffer.from(rows.flatMap((row) => [0, ...row.flat()]));
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10]);
  return Buffer.concat([
    signature, chunk("IHDR", header), chunk("IDAT", deflateSync(pixels)), chunk("IEND", Buffer.alloc(0)),
  ]);
}

const kRed: Pixel = [255, 0, 0], kGreen: Pixel = [0, 255, 0], kBlue: Pixel = [0, 0, 255], kGold: Pixel = [255, 200, 0];

/** A picture of four colours, two above and two below; each has room beside what is filtered. */
function quarters(...[a, b, c, d]: readonly [Pixel, Pixel, Pixel, Pixel]): Pixel[][] {
  const row = (left: Pixel, right: Pixel): Pixel[] => [...Array(4).fill(left), ...Array(4).fill(right)];
  return [...Array(4).fill(row(a, b)), ...Array(4).fill(row(c, d))];
}

/** A square in the plane of x and y, one metre wide, with its lower left corner at `x`. */
function square(x: number): string {
  return [[0, 0], [1, 0], [1, 1], [0, 1]].map(([u, v]) => `v ${x + u!} ${v} 0\nvt ${u} ${v}\n`).join("");
}

const kObj = `mtllib a.mtl\n${square(0)}${square(1)}usemtl map\nf 1/1 2/2 3/3 4/4\nusemtl plain\nf 5/5 6/6 7/7 8/8\n`;
const kMtl = "newmtl map\nKd 1 1 1\nmap_Kd map.png\nnewmtl plain\nKd 1 0.78 0\n";

/** What is seen at a place of the model: the brightest of red, green and blue, and whether green goes with red. */
async function hueAt(page: Page, at: { x: number; y: number; z: number }): Promise<string> {
  const { x, y } = await page.evaluate((place) => window.__hl.project(place), at);
  const clip = { x: Math.round(x) - 2, y: Math.round(y) - 2, width: 4, height: 4 };
  const picture = (await page.screenshot({ clip })).toString("base64");
  const [red, green, blue] = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const context = Object.assign(document.createElement("canvas"), { width: 4, height: 4 }).getContext("2d")!;
    context.drawImage(image, 0, 0);
    return [...context.getImageData(1, 1, 1, 1).data] as [number, number, number];
  }, picture);
  if (red > 2 * blue && green > 2 * blue && red < 2 * green) return "gold";
  return red > Math.max(green, blue) ? "red" : green > blue ? "green" : "blue";
}

describe.skipIf(!kProgram)("a model of its own colours", () => {
  test("is seen in them, with its picture the right way up", async () => {
    const folder = mkdtempSync(join(tmpdir(), "hl-look-"));
    writeFileSync(join(folder, "a.obj"), kObj);
    writeFileSync(join(folder, "a.mtl"), kMtl);
    writeFileSync(join(folder, "map.png"), png(quarters(kRed, kGreen, kBlue, kGold)));
    const touch = await startTouch(0, join(folder, "a.obj"));
    const browser = await launch();
    try {
      const page = await browser.newPage(kWindow);
      const complaints = listen(page, touch.url);
      await page.goto(touch.url);
      await page.waitForFunction(() => window.__hl.triangles === 4 && window.__hl.samples > 10);
      const { boundsMin: low, boundsMax: high } = await page.evaluate(() => window.__hl);
      const at = (u: number, v: number) =>
        ({ x: low!.x + u * (high!.x - low!.x), y: low!.y + v * (high!.y - low!.y), z: low!.z });
      const seen = async () => {
        const hues: string[] = [];
        for (const [u, v] of [[0.1, 0.8], [0.4, 0.8], [0.1, 0.2], [0.4, 0.2], [0.9, 0.8]]) {
          hues.push(await hueAt(page, at(u!, v!)));
        }
        return hues;
      };
      await expect.poll(seen, { timeout: 60_000 }).toEqual(["red", "green", "blue", "gold", "gold"]);
      await screenshot(page, "appearance");
      expect(complaints.errors).toEqual([]);
    } finally {
      await browser.close();
      touch.process.kill("SIGKILL");
    }
  });
});
