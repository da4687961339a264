// What is under the pointer, and the ways of the hand: presses on the model, the way back into view, what lies straight
// below a place, and the marks that show it.

import { element, setText } from "./elements";
import type { State } from "./gen/hl_pb";
import { HandFinder } from "./hand_finder";
import type { HandInput } from "./hand_input";
import { worldPerHand, type HandState } from "./hand_state";
import type { LiveScene } from "./live_scene";
import { describeObject } from "./object_words";
import { Errand, kAbove_D, Press, type SurfaceHit } from "./press";
import { beside } from "./route";
import { sectionOf, type Section, type Side } from "./section";
import type { Stage } from "./stage";
import { settingsOf } from "./surfaces";
import { planWay, steadyDepth, surfaceUnder, type AimScene } from "./touch_aim";
import { length, sub, type Vec } from "./vec";

/** A press this near to the proxy or the finger is meant for the hand. */
const kGrabRadius_px = 30;
const kUp: Vec = { x: 0, y: 1, z: 0 };
const kDown: Vec = { x: 0, y: -1, z: 0 };

export class Pointing {
  private readonly stage_: Stage;
  private readonly live_: LiveScene;
  private readonly state_: () => State | undefined;
  private readonly hand_: () => HandState | undefined;
  private pointer_px_: { x: number; y: number } | undefined;
  private cut_: { side: Side; share: number } = { side: "off", share: 0.5 };
  private section_: Section | undefined;
  private finder_: HandFinder | undefined;

  /** `state`: the newest one; `hand`: the one that the page moves. */
  constructor(
    stage: Stage, live: LiveScene, state: () => State | undefined, hand: () => HandState | undefined,
  ) {
    this.stage_ = stage;
    this.live_ = live;
    this.state_ = state;
    this.hand_ = hand;
    const { canvas } = stage;
    canvas.addEventListener("pointermove", ({ offsetX, offsetY }) => (this.pointer_px_ = { x: offsetX, y: offsetY }));
    canvas.addEventListener("pointerleave", () => (this.pointer_px_ = undefined));
  }

  /** Metres of the scene for one of the hand. */
  get worldPerHand(): number {
    return worldPerHand(this.live_.layout, this.hand_());
  }

  surfaceAt(x_px: number, y_px: number): SurfaceHit | undefined {
    return surfaceUnder(this.aimScene(), this.stage_.rayAt(x_px, y_px));
  }

  /**
   * A press on the marks of a hand that touches nothing takes the hand; any other press on the model touches it there.
   */
  press(x_px: number, y_px: number): Press | undefined {
    const hit = this.surfaceAt(x_px, y_px);
    const touching = this.hand_()?.touching ?? false;
    if (hit === undefined || (!touching && this.isNearHand(x_px, y_px))) {
      return undefined;
    }
    return new Press(this.worldPerHand, hit, {
      plan: (to) => this.wayTo(to),
      steady: (pressed) => steadyDepth(this.aimScene(), pressed),
    });
  }

  isNearHand(x_px: number, y_px: number): boolean {
    return [this.hand_()?.proxy, this.hand_()?.finger].some((point) => {
      if (point === undefined) {
        return false;
      }
      const at = this.stage_.project(point);
      return Math.hypot(at.x - x_px, at.y - y_px) < kGrabRadius_px;
    });
  }

  /** Sends the hand to a place above what is in the middle of the view, or to what the view turns about. */
  bringBack(hand: HandInput): void {
    const { left, right, top, bottom } = this.stage_.visible;
    const hit = this.surfaceAt((left + right) / 2, (top + bottom) / 2);
    const to = hit ? beside(hit.point, hit.normal, kAbove_D * this.worldPerHand) : this.stage_.target;
    hand.send(new Errand(this.worldPerHand, this.wayTo(to)));
  }

  /** What is straight below a place: a surface or the floor. */
  below(place: Vec): { point: Vec; normal: Vec } | undefined {
    const floor = this.stage_.floorBelow(place);
    const reach_m = floor === undefined ? Infinity : place.y - floor.y;
    const met = this.live_.model.cast(place, kDown, reach_m);
    return met ?? (floor && { point: floor, normal: kUp });
  }

  /** Draws the model without a share of it, and looks through what is not drawn. */
  cut(side: Side, share: number): void {
    this.cut_ = { side, share };
    this.layoutChanged();
  }

  layoutChanged(): void {
    this.section_ = sectionOf(this.cut_.side, this.cut_.share, this.live_.layout?.bounds);
    this.live_.model.setSection(this.section_);
  }

  /** Points to a hand that is out of view. `known`: where the finger is, is known. */
  showFinder(known: boolean, hand: HandInput): void {
    this.finder_ ??= new HandFinder(() => this.bringBack(hand));
    const finger = known ? this.hand_()?.finger : undefined;
    const distance_m = finger === undefined ? 0 : length(sub(finger, this.stage_.target));
    this.finder_.show(finger && this.stage_.project(finger), this.stage_.visible, distance_m);
  }

  /** Shows what is pressed or else under the pointer: the object and its material there. */
  showPicked(pressed: SurfaceHit | undefined): void {
    const placed = this.live_.layout?.placed ?? [];
    const at = this.pointer_px_;
    const hit = pressed ?? (at && this.surfaceAt(at.x, at.y));
    this.live_.model.setPointed(hit?.object);
    element("picked").hidden = hit === undefined;
    if (hit !== undefined) {
      const over = settingsOf(this.state_()?.surfaces);
      setText("picked", describeObject(hit.object, placed[hit.object], placed.length, hit.material, over));
    }
  }

  private aimScene(): AimScene {
    const { layout, model, store } = this.live_;
    return {
      model,
      bounds: () => model.bounds(store.poses),
      proxyRadius_m: this.hand_()?.radius_m ?? layout?.proxyRadius_m ?? 0,
      worldPerHand: this.worldPerHand,
      section: this.section_,
    };
  }

  private wayTo(to: Vec): Vec[] {
    const proxy = this.hand_()?.proxy ?? to;
    const finger = this.hand_()?.finger ?? proxy;
    return planWay(this.aimScene(), proxy, sub(proxy, finger), to);
  }
}
