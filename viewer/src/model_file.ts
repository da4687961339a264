// Opens a model file: sends it to the server, which reads it and puts it in the place of the scene.

import { BrokenConnection, kAnyEnding, shownName, type FileOpener, type ReportProgress } from "./file_drop";
import { openedLine, type Opened } from "./opened_line";
import { formatSi } from "./units";

export class ModelFile implements FileOpener {
  readonly what = "3-D models";
  readonly endings = [kAnyEnding];
  /** The largest file that the server takes, bytes; 0: it takes none. */
  limit_bytes = 0;

  /** `expect`: a file begins to take the place of the scene, or does not after all; `opened`: it has. */
  constructor(private readonly expect_: (expected: boolean) => void, private readonly opened_: () => void) {}

  refusal(): string | undefined {
    return this.limit_bytes > 0 ? undefined : "This server takes no files: start it with hl touch --upload on.";
  }

  open(file: File, report: ReportProgress): Promise<string> {
    const name = shownName(file.name);
    if (file.size === 0) {
      return Promise.reject(new Error(`${name} is empty.`));
    }
    if (file.size > this.limit_bytes) {
      return Promise.reject(new Error(
        `${name} has ${formatSi(file.size, "B")}; this server takes ${formatSi(this.limit_bytes, "B")} at most.`));
    }
    this.expect_(true);
    return new Promise<string>((resolve, reject) => this.send(file, name, { report, resolve, reject })).catch(
      (error: unknown) => {
        this.expect_(false);
        throw error;
      },
    );
  }

  private send(file: File, name: string, on: {
    report: ReportProgress; resolve(line: string): void; reject(error: Error): void;
  }): void {
    const request = new XMLHttpRequest();
    request.upload.onprogress = ({ loaded, total }) => {
      const part = `${formatSi(total, "B")}, ${Math.floor((100 * loaded) / Math.max(total, 1))} %`;
      on.report(`Sending ${name}: ${formatSi(loaded, "B")} of ${part}`, () => request.abort());
    };
    request.onabort = () => {
      this.expect_(false);
      on.resolve(`${name} is not opened: cancelled.`);
    };
    request.upload.onload = () => on.report(`Reading ${name}…`);
    request.onload = () => {
      if (request.status === 200) {
        const opened = JSON.parse(request.responseText) as Opened;
        this.opened_();
        on.resolve(openedLine(opened.name, opened));
      } else {
        on.reject(new Error(request.responseText.trim() || `The server refused ${name} (${request.status}).`));
      }
    };
    request.onerror = () => on.reject(new BrokenConnection(`${name} could not be sent: the connection broke.`));
    request.open("POST", `upload?name=${encodeURIComponent(name)}`);
    request.setRequestHeader("Content-Type", "application/octet-stream");
    request.send(file);
  }
}
