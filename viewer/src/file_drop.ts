// A file that the user drops on the page or chooses. A table says what opens which ending; this module finds the opener,
// reports how far it is, and the result. One file at a time.

/** Shows a line while something goes on. `cancel`: what stops it, while that can be. */
export type ReportProgress = (line: string, cancel?: () => void) => void;

export interface FileOpener {
  /** What it opens, in the plural, for a sentence. */
  readonly what: string;
  /** Of the names, in lower case and with the dot; kAnyEnding: every file that no other opener takes. */
  readonly endings: readonly string[];
  /** In one line why it opens nothing now; undefined: it does. */
  refusal(): string | undefined;
  /**
   * Opens a file. Resolves with the line that says what is open now, or that it was cancelled, or "" where the user
   * sees that; rejects with an Error whose message is one line for the user, and then what was open before still is.
   */
  open(file: File, report: ReportProgress): Promise<string>;
}

export const kAnyEnding = "*";

/** Where the lines go; Notices is one. */
export interface FileLines {
  stand(cause: string, text: string | undefined, kind: "bad" | "warn" | "plain", cancel?: () => void): void;
  report(text: string, bad: boolean, about: string, broke?: boolean): void;
  settle(about: string): void;
}

const kShownName_characters = 60;
/** Of a long name the end stays: it states the format, to the server and to the user. */
const kShownEnd_characters = 16;
const kCause = "file";

/** A file's name as it may be shown: one line without control characters, of bounded length. */
export function shownName(name: string): string {
  const clean = name.replace(/[\p{Cc}\p{Cf}\p{Cs}\p{Zl}\p{Zp}]/gu, "").trim() || "file";
  const letters = [...clean];
  if (letters.length <= kShownName_characters) {
    return clean;
  }
  const begin = letters.slice(0, kShownName_characters - 1 - kShownEnd_characters);
  return `${begin.join("")}…${letters.slice(-kShownEnd_characters).join("")}`;
}

/** What the user asked for ended with the connection: nothing is wrong with the file. */
export class BrokenConnection extends Error {}

/** The opener of the longest ending that fits, so that ".hl.json" goes before ".json". */
export function openerOf(openers: readonly FileOpener[], name: string): FileOpener | undefined {
  const lower = name.toLowerCase();
  let found: FileOpener | undefined;
  let longest = -1;
  for (const opener of openers) {
    for (const ending of opener.endings) {
      const length = ending === kAnyEnding ? 0 : ending.length;
      if (length > longest && (ending === kAnyEnding || lower.endsWith(ending))) {
        found = opener;
        longest = length;
      }
    }
  }
  return found;
}

/** The one line for a file that nothing opens. */
export function unopened(openers: readonly FileOpener[], name: string): string {
  const kinds = openers.filter((opener) => opener.refusal() === undefined)
    .map(({ what, endings }) => `${what} (${endings.join(", ")})`);
  return `${shownName(name)} cannot be opened here; ${kinds.join(" and ")} can.`;
}

/** A folder looks like a file until it is read, and a file may have gone since it was chosen. */
async function isReadable(file: File): Promise<boolean> {
  return file.slice(0, 1).arrayBuffer().then(() => true, () => false);
}

function unreadable(name: string): string {
  return `${shownName(name)} cannot be read: it is a folder, or it has been moved, changed or deleted. Give the file again.`;
}

export class FileDrop {
  private busy_ = false;

  constructor(private readonly openers_: readonly FileOpener[], private readonly lines_: FileLines) {}

  /** Whether anything can be opened now. */
  get offered(): boolean {
    return this.openers_.some((opener) => opener.refusal() === undefined);
  }

  /** What was dropped or chosen; one file counts. */
  async take(files: readonly File[]): Promise<void> {
    const [file] = files;
    if (file === undefined) {
      return;
    }
    if (files.length > 1) {
      this.lines_.report(`${files.length} files at once: give one file.`, true, kCause);
    } else if (this.busy_) {
      this.lines_.report(`Busy with another file: give ${shownName(file.name)} again when it is done.`, true, kCause);
    } else {
      await this.open(file);
    }
  }

  private async open(file: File): Promise<void> {
    const opener = openerOf(this.openers_, file.name);
    const refusal = opener === undefined ? unopened(this.openers_, file.name) : opener.refusal();
    if (opener === undefined || refusal !== undefined) {
      this.lines_.report(refusal!, true, kCause);
      return;
    }
    this.busy_ = true;
    try {
      const opened = await opener.open(file, (line, cancel) => this.lines_.stand(kCause, line, "plain", cancel));
      if (opened === "") {
        this.lines_.settle(kCause);
      } else {
        this.lines_.report(opened, false, kCause);
      }
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      const readable = await isReadable(file);
      this.lines_.report(
        readable ? why : unreadable(file.name), true, kCause, readable && error instanceof BrokenConnection);
    } finally {
      this.busy_ = false;
      this.lines_.stand(kCause, undefined, "plain");
    }
  }
}
