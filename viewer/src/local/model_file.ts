// In the place of ../model_file in the page without a server: the file is read by a worker and given to the engine.

import { shownName, type FileOpener } from "../file_drop";
import { openedLine } from "../opened_line";
import { formatSi } from "../units";
import { engine } from "./engine_worker";
import { kMeshEndings, type Triangles } from "./mesh_file";

const kMax_bytes = 100e6;
const kPatience_ms = 60_000;

/** What reads it ends when it has, when it fails, and when it takes too long. */
function readBeside(file: File, ending: string): Promise<Triangles> {
  const worker = new Worker(new URL("./mesh_worker.ts", import.meta.url), { type: "module" });
  return new Promise<Triangles>((resolve, reject) => {
    const fail = (line: string) => reject(new Error(line));
    setTimeout(() => fail("reading it takes too long"), kPatience_ms);
    worker.onmessage = ({ data }: MessageEvent<Triangles | string>) => {
      if (typeof data === "string") fail(data);
      else resolve(data);
    };
    worker.onerror = () => fail("it cannot be read");
    worker.postMessage({ ending, file });
  }).finally(() => worker.terminate());
}

/** One line, whatever a reader says. */
function lineOf(name: string, error: unknown): string {
  const text = error instanceof Error ? error.message : String(error);
  return `${name}: ${text.replace(/\s+/g, " ").slice(0, 200)}.`;
}

export class ModelFile implements FileOpener {
  readonly what = "3-D models";
  readonly endings = kMeshEndings;
  /** Of a server; here there is none. */
  limit_bytes = 0;

  constructor(private readonly expect_: (expected: boolean) => void, private readonly opened_: () => void) {}

  refusal(): undefined {
    return undefined;
  }

  async open(file: File, report: (line: string) => void): Promise<string> {
    const name = shownName(file.name);
    if (file.size === 0) throw new Error(`${name} is empty.`);
    if (file.size > kMax_bytes)
      throw new Error(`${name} has ${formatSi(file.size, "B")}; this page reads ${formatSi(kMax_bytes, "B")} at most.`);
    report(`Reading ${name}…`);
    this.expect_(true);
    try {
      const ending = this.endings.find((one) => file.name.toLowerCase().endsWith(one))!;
      const mesh = await readBeside(file, ending);
      const { triangles, worldPerDevice } = await engine.load({ name, ...mesh });
      this.opened_();
      return openedLine(name, { triangles, world_per_device: worldPerDevice, warnings: [] });
    } catch (error) {
      this.expect_(false);
      throw new Error(lineOf(name, error), { cause: error });
    }
  }
}
