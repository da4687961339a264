// Banners at the view. A keyed banner stands until its cause is gone; a line that is reported can be closed.

import { element } from "./elements";
import { lifeOf, stayingConnected, stayingWith, type ReportedLine } from "./reported_lines";

interface ReportedBanner extends ReportedLine {
  readonly banner: HTMLElement;
}

function withWords(banner: HTMLElement): HTMLElement {
  banner.append(document.createElement("span"));
  return banner;
}

/** The button stays the same from line to line, so that it is not taken away under a pointer. */
function showCancel(banner: HTMLElement, cancel: (() => void) | undefined): void {
  const old = banner.querySelector("button");
  if (cancel === undefined) {
    old?.remove();
    return;
  }
  const button = old ?? document.createElement("button");
  button.type = "button";
  button.className = "cancel";
  button.textContent = "Cancel";
  button.onclick = cancel;
  if (old === null) {
    banner.append(button);
  }
}

export class Notices {
  private readonly host_ = element("notices");
  private readonly standing_ = new Map<string, HTMLElement>();
  private reported_: readonly ReportedBanner[] = [];

  /** Shows or replaces the banner of one cause; undefined removes it. `cancel`: what a button beside the text does. */
  stand(cause: string, text: string | undefined, kind: "bad" | "warn" | "plain" = "bad", cancel?: () => void): void {
    const old = this.standing_.get(cause);
    if (text === undefined) {
      old?.remove();
      this.standing_.delete(cause);
      return;
    }
    const banner = old ?? withWords(document.createElement("div"));
    banner.className = `notice ${kind}`;
    banner.dataset.cause = cause;
    banner.setAttribute("role", kind === "bad" ? "alert" : "status");
    const words = banner.firstElementChild!;
    if (words.textContent !== text) {
      words.textContent = text;
    }
    showCancel(banner, cancel);
    if (old === undefined) {
      this.standing_.set(cause, banner);
      this.host_.prepend(banner);
    }
  }

  /**
   * A line with a button to close it. `about`: the user's action that it is about; `broke`: a connection did;
   * reported_lines.ts: when it goes.
   */
  report(text: string, bad: boolean, about?: string, broke = false): void {
    const line: ReportedBanner = { text, bad, about, broke, banner: this.made(text, bad) };
    this.keep([...stayingWith(this.reported_, line), line]);
    this.host_.append(line.banner);
    const life_ms = lifeOf(line);
    if (life_ms !== undefined) {
      this.endAfter(line.banner, life_ms);
    }
  }

  /** It went well, and there is nothing to report: what was reported of it is past. */
  settle(about: string): void {
    this.keep(this.reported_.filter((line) => line.about !== about));
  }

  /** The server is heard again. */
  connected(): void {
    this.keep(stayingConnected(this.reported_));
  }

  /** Escape closes the newest line that can be closed, where nothing else has taken it. */
  followEscape(): void {
    window.addEventListener("keydown", (event) => {
      const taken = event.defaultPrevented || event.repeat || element<HTMLDialogElement>("help").open ||
        event.target instanceof HTMLSelectElement;
      const newest = this.reported_.at(-1);
      if (event.key === "Escape" && !taken && newest !== undefined) {
        this.close(newest.banner);
      }
    });
  }

  private made(text: string, bad: boolean): HTMLElement {
    const banner = withWords(document.createElement("div"));
    banner.className = bad ? "notice bad told" : "notice told";
    banner.setAttribute("role", bad ? "alert" : "status");
    banner.firstElementChild!.textContent = text;
    const close = document.createElement("button");
    close.type = "button";
    close.textContent = "×";
    close.setAttribute("aria-label", "Close");
    close.addEventListener("click", () => this.close(banner));
    banner.append(close);
    return banner;
  }

  /** Nothing goes that nobody can have read, or that a pointer or the focus is on. */
  private endAfter(banner: HTMLElement, life_ms: number): void {
    setTimeout(() => {
      if (document.hidden || banner.matches(":hover, :focus-within")) {
        this.endAfter(banner, life_ms);
      } else {
        this.close(banner);
      }
    }, life_ms);
  }

  private close(banner: HTMLElement): void {
    this.keep(this.reported_.filter((line) => line.banner !== banner));
  }

  private keep(lines: readonly ReportedBanner[]): void {
    const kept = new Set(lines);
    this.reported_.filter((line) => !kept.has(line)).forEach(({ banner }) => banner.remove());
    this.reported_ = lines;
  }
}
