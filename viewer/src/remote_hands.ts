// The hands of other servers of a shared world, in the scene: each in the colour of its server and with its name.

import { create } from "@bufbuild/protobuf";
import * as THREE from "three";
import { StateSchema, type OtherDevice, type State } from "./gen/hl_pb";
import { depthOf, metresPerPixel, type ViewFrame } from "./hand_mapping";
import { NameLabel } from "./name_label";
import { markInView, placeNames, type Mark, type NamedHand, type Point } from "./name_places";
import { ProbeView } from "./probe_view";
import { handsByKey, nameOfHand, type ServerColours } from "./shared_world";
import { themeColour } from "./theme";
import { knownVec } from "./wire_values";

interface Hand {
  readonly probe: ProbeView;
  readonly label: NameLabel;
}

export class RemoteHands {
  readonly group = new THREE.Group();
  private readonly hands_ = new Map<string, Hand>();
  /** Of hands that have gone, for those that come. */
  private readonly spare_: Hand[] = [];
  private readonly theme_ = new Map<string, string>();
  private places_: ReadonlyMap<string, Point> = new Map();
  private diagonal_m_ = 1;
  private stylusShown_ = true;

  constructor(private readonly colours_: ServerColours) {}

  setDiagonal(diagonal_m: number): void {
    this.diagonal_m_ = diagonal_m;
    this.hands_.forEach(({ probe }) => probe.setDiagonal(diagonal_m));
  }

  setStylusShown(shown: boolean): void {
    this.stylusShown_ = shown;
    this.hands_.forEach(({ probe }) => probe.stylus.setShown(shown));
  }

  applyTheme(): void {
    this.theme_.clear();
    this.hands_.forEach(({ probe }) => probe.applyTheme());
  }

  /** Once per drawn frame. */
  showProbes(state: State | undefined, camera: THREE.Camera, view: ViewFrame): void {
    const remote = handsByKey(state?.remote ?? []);
    for (const [key, hand] of this.hands_) {
      if (!remote.has(key)) this.putAway(key, hand);
    }
    remote.forEach((hand, key) => this.showHand(key, hand, camera, view));
    this.showNames(state, remote, view);
  }

  private putAway(key: string, hand: Hand): void {
    this.group.remove(hand.probe.group, hand.label.sprite);
    this.hands_.delete(key);
    this.spare_.push(hand);
  }

  private showHand(key: string, hand: OtherDevice, camera: THREE.Camera, view: ViewFrame): void {
    const { finger, proxy, forceN, stylus } = hand;
    const { probe, label } = this.hands_.get(key) ?? this.takeOut(key);
    const colour = this.colourOf(this.colours_.colourOf(hand.server));
    probe.setColour(colour);
    probe.setRadius(hand.proxyRadius);
    probe.update(finger && proxy && forceN && create(StateSchema, { finger, proxy, forceN, ...(stylus && { stylus }) }));
    if (proxy !== undefined) probe.face(camera, metresPerPixel(view, depthOf(view, proxy)));
    label.setText(nameOfHand(hand), colour, this.colourOf("card"));
  }

  private showNames(state: State | undefined, remote: ReadonlyMap<string, OtherDevice>, view: ViewFrame): void {
    const named: NamedHand[] = [];
    remote.forEach((hand, key) => {
      const { probe, label } = this.hands_.get(key)!;
      const at = probe.group.visible ? markOf(hand, view) : undefined;
      label.sprite.visible = at !== undefined;
      if (at !== undefined) named.push({ key, at, width_px: label.width_px });
    });
    const own = state === undefined ? [] : [markOf(state, view), ...state.others.map((hand) => markOf(hand, view))];
    this.places_ = placeNames(named, own.filter((mark) => mark !== undefined), this.places_);
    this.places_.forEach((place, key) => {
      const proxy = knownVec(remote.get(key)!.proxy)!;
      this.hands_.get(key)!.label.stand(proxy, place, metresPerPixel(view, depthOf(view, proxy)));
    });
  }

  private takeOut(key: string): Hand {
    const hand = this.spare_.pop() ?? { probe: new ProbeView(), label: new NameLabel() };
    hand.probe.setDiagonal(this.diagonal_m_);
    hand.probe.drop.setShown(false);
    hand.probe.stylus.setShown(this.stylusShown_);
    hand.probe.applyTheme();
    this.group.add(hand.probe.group, hand.label.sprite);
    this.hands_.set(key, hand);
    return hand;
  }

  /** Of the theme, which is asked once for each: hands are shown at each frame. */
  private colourOf(name: string): string {
    const known = this.theme_.get(name) ?? themeColour(name);
    this.theme_.set(name, known);
    return known;
  }
}

function markOf(hand: Pick<OtherDevice, "proxy"> & { proxyRadius?: number }, view: ViewFrame): Mark | undefined {
  const proxy = knownVec(hand.proxy);
  return proxy && markInView(view, proxy, hand.proxyRadius ?? 0);
}
