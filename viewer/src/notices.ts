// Banners at the top of the view. A keyed banner stands until its cause is gone; a server's notice can be closed.

import { element } from "./elements";

const kNoticesMax = 4;

export class Notices {
  private readonly host_ = element("notices");
  private readonly standing_ = new Map<string, HTMLElement>();

  /** Shows or replaces the banner of one cause; undefined removes it. */
  stand(cause: string, text: string | undefined, kind: "bad" | "warn" | "plain" = "bad"): void {
    const old = this.standing_.get(cause);
    if (text === undefined) {
      old?.remove();
      this.standing_.delete(cause);
      return;
    }
    const banner = old ?? document.createElement("div");
    banner.className = `notice ${kind}`;
    banner.dataset.cause = cause;
    banner.setAttribute("role", kind === "bad" ? "alert" : "status");
    if (banner.textContent !== text) {
      banner.textContent = text;
    }
    if (old === undefined) {
      this.standing_.set(cause, banner);
      this.host_.prepend(banner);
    }
  }

  /** A message of the server, with a button to close it; the oldest ones go first. */
  tell(text: string, bad: boolean): void {
    const banner = document.createElement("div");
    banner.className = bad ? "notice bad told" : "notice told";
    const words = document.createElement("span");
    words.textContent = text;
    const close = document.createElement("button");
    close.type = "button";
    close.textContent = "×";
    close.setAttribute("aria-label", "Close");
    close.addEventListener("click", () => banner.remove());
    banner.append(words, close);
    this.host_.append(banner);
    const told = this.host_.querySelectorAll(".told");
    for (let i = 0; i < told.length - kNoticesMax; ++i) {
      told[i]!.remove();
    }
  }
}
