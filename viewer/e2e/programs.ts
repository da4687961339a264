// Real servers for the end-to-end tests: `hl touch` on a free port, and its end.

import { spawn, type ChildProcess } from "node:child_process";
import { createInterface } from "node:readline";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

/** The `hl` program; without it the tests of real servers are skipped. */
export const kProgram = process.env.HL_BIN;

export interface Touch {
  readonly process: ChildProcess;
  readonly url: string;
}

/** The page under test, wherever the program was built. */
export const kDist = fileURLToPath(new URL("../dist", import.meta.url));

/** Starts `hl touch` on a scene and waits for the line that says it is ready. */
export async function startTouch(port: number, scene = "teapot", ...options: string[]): Promise<Touch> {
  const common = ["--port", String(port), "--no-open", "--page-dir", kDist];
  const child = spawn(kProgram!, ["touch", scene, ...common, ...options], {
    stdio: ["ignore", "pipe", "inherit"],
  });
  for await (const line of createInterface({ input: child.stdout! })) {
    const match = /^page: (http:\/\/127\.0\.0\.1:\d+\/)$/.exec(line);
    if (match) {
      child.stdout!.resume();
      return { process: child, url: match[1]! };
    }
  }
  throw new Error("hl touch ended without reporting its page");
}

/** Starts `hld` on a free port and waits until it is ready. */
export async function startServer(...options: string[]): Promise<Touch> {
  const program = join(dirname(kProgram!), "hld");
  const child = spawn(program, ["--port", "0", "--page-dir", kDist, ...options], { stdio: ["ignore", "ignore", "pipe"] });
  for await (const line of createInterface({ input: child.stderr! })) {
    const match = /event=ready address=(\S+)/.exec(line);
    if (match) {
      child.stderr!.resume();
      return { process: child, url: match[1]! };
    }
  }
  throw new Error("hld ended without reporting its page");
}

export function ended(child: ChildProcess): Promise<number | null> {
  return child.exitCode !== null || child.signalCode !== null
    ? Promise.resolve(child.exitCode)
    : new Promise((resolve) => child.once("exit", (code) => resolve(code)));
}
