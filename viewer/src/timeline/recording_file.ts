// Opens a recording: a worker reads it, and then the timeline shows it.

import { shownName, type FileOpener } from "../file_drop";
import type { Recording } from "./recording";
import type { WorkerMessage } from "./recording_worker";

export class RecordingFile implements FileOpener {
  readonly what = "recordings";
  readonly endings = [".hlr"];

  constructor(private readonly show_: (recording: Recording, name: string) => void) {}

  refusal(): string | undefined {
    return undefined;
  }

  open(file: File, report: (line: string) => void): Promise<string> {
    const name = shownName(file.name);
    const worker = new Worker(new URL("./recording_worker.ts", import.meta.url), { type: "module" });
    const read = new Promise<Recording>((resolve, reject) => {
      worker.onmessage = ({ data }: MessageEvent<WorkerMessage>) => {
        if (data.kind === "share") {
          report(`Reading ${name}: ${Math.floor(100 * data.share)} %`);
        } else if (data.kind === "recording") {
          resolve(data.recording);
        } else {
          reject(new Error(`${name} ${data.why}.`));
        }
      };
      worker.onerror = () => reject(new Error(`${name} cannot be read: there is not enough memory for it.`));
      worker.postMessage(file);
    });
    return read.finally(() => worker.terminate()).then((recording) => {
      this.show_(recording, name);
      return "";
    });
  }
}
