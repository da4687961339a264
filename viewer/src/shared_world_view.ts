// A world that several servers share, in the panel: a section with a row for each other server, in its colour.

import { element } from "./elements";
import type { State } from "./gen/hl_pb";
import { sharedShown, type HandRow, type ServerColours, type ServerRow } from "./shared_world";

export class SharedWorldView {
  private readonly section_ = element("shared");
  private readonly title_ = element("shared-title");
  private readonly line_ = element("shared-line");
  private readonly list_ = element("shared-list");
  private shown_ = "";

  constructor(private readonly colours_: ServerColours) {}

  showNumbers(state: State): void {
    const shown = sharedShown(state);
    this.section_.hidden = shown === undefined;
    if (shown === undefined || JSON.stringify(shown) === this.shown_) return;
    this.shown_ = JSON.stringify(shown);
    this.title_.textContent = shown.title;
    // What has not changed is not read out again.
    if (this.line_.textContent !== shown.line) this.line_.textContent = shown.line;
    this.line_.classList.toggle("ended", shown.ended);
    this.list_.replaceChildren(...shown.servers.map((server) => this.makeRow(server)));
  }

  private makeRow(server: ServerRow): HTMLElement {
    const row = document.createElement("li");
    row.className = "shared-server";
    row.dataset.server = server.name;
    row.style.setProperty("--server", `var(--${this.colours_.colourOf(server.name)})`);
    const name = document.createElement("strong"), line = document.createElement("span");
    name.textContent = server.name;
    line.textContent = server.line;
    row.append(name, line, ...server.hands.map(makeHandLine));
    return row;
  }
}

function makeHandLine(hand: HandRow): HTMLElement {
  const line = document.createElement("span");
  line.className = "shared-hand";
  line.textContent = `${hand.label === "" ? "hand" : hand.label}: ${hand.force}${hand.touches ? ", touches" : ""}`;
  return line;
}
