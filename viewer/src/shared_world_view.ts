// A world that several servers share, on the page: a section of the panel with a row for each other server, and in the
// scene the hands of all of them, in the colours and with the names of their servers.

import { create } from "@bufbuild/protobuf";
import * as THREE from "three";
import { element } from "./elements";
import { StateSchema, type OtherDevice, type State } from "./gen/hl_pb";
import { NameLabel } from "./name_label";
import { ProbeView } from "./probe_view";
import { nameOfHand, ServerColours, sharedShown, type HandRow, type ServerRow } from "./shared_world";
import { themeColour } from "./theme";

interface Hand {
  readonly probe: ProbeView;
  readonly label: NameLabel;
}

export class SharedWorldView {
  readonly group = new THREE.Group();
  private readonly section_ = element("shared");
  private readonly title_ = element("shared-title");
  private readonly line_ = element("shared-line");
  private readonly list_ = element("shared-list");
  private readonly colours_ = new ServerColours();
  private readonly hands_ = new Map<string, Hand>();
  private shown_ = "";
  private diagonal_m_ = 1;
  private stylusShown_ = true;

  setDiagonal(diagonal_m: number): void {
    this.diagonal_m_ = diagonal_m;
    this.hands_.forEach(({ probe }) => probe.setDiagonal(diagonal_m));
  }

  setStylusShown(shown: boolean): void {
    this.stylusShown_ = shown;
    this.hands_.forEach(({ probe }) => probe.stylus.setShown(shown));
  }

  applyTheme(): void {
    this.hands_.forEach(({ probe }) => probe.applyTheme());
    this.shown_ = "";
  }

  showNumbers(state: State): void {
    const shown = sharedShown(state);
    this.section_.hidden = shown === undefined;
    if (shown === undefined || JSON.stringify(shown) === this.shown_) return;
    this.shown_ = JSON.stringify(shown);
    this.title_.textContent = shown.title;
    this.line_.textContent = shown.line;
    this.line_.classList.toggle("ended", shown.ended);
    this.list_.replaceChildren(...shown.servers.map((server) => this.makeRow(server)));
  }

  /** Once per drawn frame. */
  showProbes(state: State | undefined, camera: THREE.Camera, metresPerPixel: number): void {
    const told = new Map((state?.remote ?? []).map((hand) => [nameOfHand(hand), hand]));
    this.forget(told);
    told.forEach((hand, name) => this.showHand(name, hand, camera, metresPerPixel));
  }

  private forget(told: ReadonlyMap<string, OtherDevice>): void {
    for (const [name, { probe, label }] of this.hands_) {
      if (told.has(name)) continue;
      this.group.remove(probe.group, label.sprite);
      label.dispose();
      this.hands_.delete(name);
    }
  }

  private showHand(name: string, told: OtherDevice, camera: THREE.Camera, metresPerPixel: number): void {
    const { finger, proxy, forceN, stylus } = told;
    const { probe, label } = this.handOf(name);
    const colour = this.colourOf(told.server);
    probe.setColour(colour);
    probe.setRadius(told.proxyRadius);
    probe.update(finger && proxy && forceN && create(StateSchema, { finger, proxy, forceN, ...(stylus && { stylus }) }));
    probe.face(camera, metresPerPixel);
    label.sprite.visible = probe.group.visible;
    label.setText(name, colour, themeColour("card"));
    if (proxy !== undefined) label.sprite.position.set(proxy.x, proxy.y, proxy.z);
    label.setSize(metresPerPixel);
  }

  private handOf(name: string): Hand {
    const known = this.hands_.get(name);
    if (known !== undefined) return known;
    const hand = { probe: new ProbeView(), label: new NameLabel() };
    hand.probe.setDiagonal(this.diagonal_m_);
    hand.probe.drop.setShown(false);
    hand.probe.stylus.setShown(this.stylusShown_);
    hand.probe.applyTheme();
    this.group.add(hand.probe.group, hand.label.sprite);
    this.hands_.set(name, hand);
    return hand;
  }

  private colourOf(server: string): string {
    return this.colours_.colourOf(server, document.documentElement.dataset.theme === "dark");
  }

  private makeRow(server: ServerRow): HTMLElement {
    const row = document.createElement("li");
    row.className = "shared-server";
    row.dataset.server = server.name;
    row.style.setProperty("--server", this.colourOf(server.name));
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
