// Traces the same paths with the web module and with hl trace, and compares them bit for bit.
//   node web/tests/trace.test.mjs build/web-module build/bin/hl
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [moduleFolder, program] = process.argv.slice(2);
const kRows = 2000;
const kIn = 4;
/** Numbers of a row of the module: those, and the halves of the hash of the bodies. */
const kOut = 14;
const kTraced = 12;
/** The first column of hl trace's CSV that the module gives too: t and finger stand before it. */
const kFirstColumn = 4;
/** In the order of base/quantities.def. */
const kOptions = ["--stiffness", "--static-friction", "--dynamic-friction", "--viscosity", "--stribeck", "--presliding",
  "--adhesion", "--compliance", "--strength"];

const kCases = [
  { scene: "teapot", surface: {}, size: 0.05 },
  { scene: "teapot", surface: { "--static-friction": 0.6, "--dynamic-friction": 0.4 }, size: 0.05 },
  { scene: "teapot", surface: {}, shade: "smooth", size: 0.05 },
  { scene: "sphere:2000", surface: { "--viscosity": 2, "--stiffness": 0.7 }, shade: "smooth", size: 0.1 },
  { scene: "terrain:10000", surface: { "--static-friction": 0.3 }, size: 0.05 },
  { scene: "pits:1000", surface: {}, size: 0.05 },
  { scene: "snaps", surface: {}, size: 0.06 },
];

// What the module looks for in a worker of a browser; the bytes it is given.
Object.assign(globalThis, { self: { location: { href: "" } }, importScripts: () => undefined });
const { default: makeModule } = await import(pathToFileURL(resolve(moduleFolder, "hl_web.mjs")));
const web = await makeModule({ wasmBinary: readFileSync(join(moduleFolder, "hl_web.wasm")) });

/** A slow spiral through and around the origin, without a call of libm: the same numbers everywhere. */
function pathOf(size) {
  const path = new Float64Array(kRows * kIn);
  const triangle = (x) => 4 * Math.abs(x - Math.floor(x) - 0.5) - 1;
  for (let i = 0; i < kRows; ++i) {
    const s = i / kRows;
    path.set([i * 1e-3, size * triangle(3 * s), size * triangle(2 * s + 0.3), size * triangle(5 * s + 0.2)], kIn * i);
  }
  return path;
}

function webTrace({ scene, surface, shade }, path) {
  const name = web._malloc(64), numbers = web._malloc(8 * kOptions.length);
  const input = web._malloc(path.byteLength), output = web._malloc(8 * kRows * kOut);
  web.stringToUTF8(scene, name, 64);
  web.HEAPF64.set(kOptions.map((option) => surface[option] ?? NaN), numbers / 8);
  web.HEAPF64.set(path, input / 8);
  const smooth = shade === undefined ? -1 : Number(shade === "smooth");
  if (!web._hlWebTrace(name, 0.001, numbers, smooth, input, kRows, output)) throw new Error(web.UTF8ToString(web._hlWebError()));
  const result = web.HEAPF64.slice(output / 8, output / 8 + kRows * kOut);
  [name, numbers, input, output].forEach((pointer) => web._free(pointer));
  return result;
}

function nativeTrace({ scene, surface, shade }, path) {
  const folder = mkdtempSync(join(tmpdir(), "hl-web-"));
  const [from, to] = [join(folder, "path.csv"), join(folder, "out.csv")];
  const lines = Array.from({ length: kRows }, (_, i) => path.slice(kIn * i, kIn * (i + 1)).join(","));
  writeFileSync(from, `t,x,y,z\n${lines.join("\n")}\n`);
  const options = Object.entries(surface).flat().map(String);
  if (shade !== undefined) options.push("--shade", shade);
  execFileSync(program, ["trace", scene, "--path", from, "--out", to, "--radius", "0.001", ...options], { stdio: "pipe" });
  const [head, ...rows] = readFileSync(to, "utf8").trim().split("\n").map((line) => line.split(","));
  rmSync(folder, { recursive: true });
  const hashAt = head.indexOf("world_hash");
  const halves = (hash) => [hash.slice(0, 8), hash.slice(8)].map((half) => parseInt(half, 16));
  return Float64Array.from(rows.flatMap((row) =>
    [...row.slice(kFirstColumn, kFirstColumn + kTraced).map(Number), ...(hashAt < 0 ? [0, 0] : halves(row[hashAt]))]));
}

let failed = false;
for (const test of kCases) {
  const path = pathOf(test.size);
  const [ours, theirs] = [webTrace(test, path), nativeTrace(test, path)];
  const differing = [...ours].findIndex((x, i) => !Object.is(x, theirs[i]));
  const contacts = Array.from({ length: kRows }, (_, i) => ours[kOut * i + 9]).filter((count) => count > 0).length;
  const what = `${test.scene} ${test.shade ?? ""} ${JSON.stringify(test.surface)}: ${contacts} of ${kRows} rows in contact`;
  failed ||= differing >= 0 || ours.length !== theirs.length || contacts === 0;
  const where = `row ${Math.floor(differing / kOut)} number ${differing % kOut}: ${ours[differing]} / ${theirs[differing]}`;
  console.log(differing < 0 ? `same bits: ${what}` : `DIFFERENT: ${what}; ${where}`);
}
process.exit(failed ? 1 : 0);
