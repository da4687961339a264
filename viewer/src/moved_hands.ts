// Which simulated hand of a server the page moves, and what it sends for it. Where there are several, a hand that is let go
// of keeps its goal, and so its force, until it is moved again: two can hold a body between them while the page moves one
// after the other. "All together" moves every simulated hand by the same way as the chosen one:
//
//   goal of hand i = goal of the chosen hand + (start of hand i - start of the chosen hand)
//
// where a hand starts at the goal that it was left with, or else where its finger is. No DOM: it can be tested alone.

import type { DeviceInfo, Hello, State } from "./gen/hl_pb";
import { handOf, type HandState } from "./hand_state";
import {
  encodeHandGoal, encodeHandTurn, encodePress, encodeRelease, encodeSettings, type SettingsChange, type Turned,
} from "./protocol";
import { add, length, sub, type Vec } from "./vec";

/** A server closes a page that sends 500 messages a second: the goals of all hands together stay below this. */
const kGoals_Hz = 330;
/** The server lets go after 3 s of silence. */
export const kSayAgain_ms = 250;
/** A finger this far from the goal that its hand was left with, m at the hand, has been moved by someone else. */
const kElsewhere_D = 0.06;
/** A finger this near to its proxy, m at the hand, has come up: some hundredths of a newton are left. */
const kUp_D = 1e-4;
/** It has come up by then, or is held there; and in a recording there is nothing to see of it. */
const kRise_ms = 500;

export interface MovedHandsHooks {
  send(message: Uint8Array<ArrayBuffer>): void;
  /** Says that the page is there, also while nothing else is sent. */
  here(): void;
  /** The newest one. */
  state(): State | undefined;
  /** Metres of the scene for one of the chosen hand. */
  worldPerHand(): number;
  /** The choice, or what can be chosen, is another one. */
  changed(): void;
}

/** What the page moves. Hands are named by the numbers of their devices. */
export interface HandChoice {
  /** Those that a page can move. */
  readonly simulated: readonly number[];
  readonly chosen: number;
  readonly together: boolean;
}

/** Whether a page could move this hand, but moves another one. */
export function isAside({ simulated, chosen, together }: HandChoice, device: number): boolean {
  return simulated.includes(device) && device !== chosen && !together;
}

/** A hand, and perhaps others with it, that is being moved. */
interface Hold {
  goal: Vec;
  unsent: boolean;
  /** From the chosen hand to those that go along. */
  readonly along: ReadonlyMap<number, Vec>;
}

export class MovedHands {
  private readonly hooks_: MovedHandsHooks;
  private devices_: readonly DeviceInfo[] = [];
  /** How many of the devices the newest state reports. */
  private reported_ = 0;
  private chosen_ = 0;
  private together_ = false;
  private hold_: Hold | undefined;
  /** Goals of hands that were let go of. */
  private readonly left_ = new Map<number, Vec>();
  /** The hand that was let go of, and comes up to its proxy. */
  private rising_: { readonly device: number; begin_ms?: number } | undefined;
  private buttons_ = 0;
  private sent_ms_ = -Infinity;

  constructor(hooks: MovedHandsHooks) {
    this.hooks_ = hooks;
  }

  get choice(): HandChoice {
    return { simulated: this.simulated, chosen: this.chosen_, together: this.together_ };
  }

  /** The device in the chosen hand. */
  get device(): DeviceInfo | undefined {
    return this.devices_[this.chosen_];
  }

  /** The chosen hand in the newest state. */
  get now(): HandState | undefined {
    return handOf(this.hooks_.state(), this.chosen_);
  }

  get movable(): boolean {
    return this.simulated.includes(this.chosen_);
  }

  /** A server begins. The choice stays as long as it has such a hand. */
  showHello(hello: Hello): void {
    this.devices_ = hello.devices.length > 0 ? hello.devices : hello.device ? [hello.device] : [];
    this.reported_ = this.devices_.length;
    this.hold_ = this.rising_ = undefined;
    this.left_.clear();
    this.chosen_ = this.movable ? this.chosen_ : this.firstHand;
    this.together_ &&= this.several;
    this.hooks_.changed();
  }

  /** A state came. */
  follow(state: State): void {
    const reported = Math.min(this.devices_.length, 1 + state.others.length);
    if (reported !== this.reported_) {
      this.reported_ = reported;
      this.choose(this.movable ? this.chosen_ : this.firstHand);
      this.setTogether(this.together_);
    }
    for (const device of this.left_.keys()) {
      if (handOf(state, device)?.exploring === true) this.left_.delete(device);
    }
  }

  /** Another hand is moved from now on; buttons that are down are its. No such hand: nothing changes. */
  choose(device: number): void {
    if (device !== this.firstHand && !this.simulated.includes(device)) return;
    this.letGo();
    if (device !== this.chosen_ && this.buttons_ !== 0) {
      this.hooks_.send(encodePress(0, this.chosen_));
      this.hooks_.send(encodePress(this.buttons_, device));
    }
    this.chosen_ = device;
    this.hooks_.changed();
  }

  chooseNext(): void {
    const { simulated } = this;
    this.choose(simulated[(simulated.indexOf(this.chosen_) + 1) % simulated.length] ?? this.firstHand);
  }

  /** One hand alone cannot be together with others. */
  setTogether(on: boolean): void {
    this.letGo();
    this.together_ = on && this.several;
    this.hooks_.changed();
  }

  /** Takes the hands that are to be moved. Where the chosen one starts; undefined: that is not known. */
  grab(): Vec | undefined {
    const from = this.startOf(this.chosen_);
    if (from === undefined || !this.movable) return undefined;
    const along = new Map<number, Vec>();
    for (const device of this.moved) {
      const start = device === this.chosen_ ? undefined : this.startOf(device);
      if (start !== undefined) along.set(device, sub(start, from));
    }
    this.hold_ = { goal: from, unsent: false, along };
    this.rising_ = undefined;
    this.left_.delete(this.chosen_);
    return from;
  }

  /** Where the chosen hand is to be. */
  goal(position: Vec, now_ms: number): void {
    if (this.hold_ === undefined) return;
    this.hold_.goal = position;
    this.hold_.unsent = true;
    this.frame(now_ms);
  }

  /** Sends the newest goals when it is time. Once per drawn frame. */
  frame(now_ms: number): void {
    this.endRise(now_ms);
    const { hold_: hold } = this;
    if (hold?.unsent !== true || now_ms - this.sent_ms_ < (1000 * (1 + hold.along.size)) / kGoals_Hz) return;
    this.sent_ms_ = now_ms;
    this.sendGoals(hold);
  }

  /**
   * To be called every kSayAgain_ms: the server lets go of what a silent page holds. What is being moved is said again, so
   * that a page that was held up takes hold again.
   */
  sayAgain(): void {
    if (this.hold_ !== undefined) {
      this.sendGoals(this.hold_);
    } else if (this.left_.size > 0 || this.rising_ !== undefined) {
      this.hooks_.here();
    }
  }

  /** One hand alone lets its force go, and stays where its proxy is. Of several each keeps its goal. */
  letGo(): void {
    const { hold_: hold } = this;
    if (hold === undefined) return;
    if (hold.unsent) this.sendGoals(hold);
    this.hold_ = undefined;
    if (this.several) {
      this.left_.set(this.chosen_, hold.goal);
    } else {
      this.leave(this.chosen_);
    }
  }

  /** As letGo(), where nothing more can be sent soon: a hand alone does not come up to its proxy first. */
  letGoAtOnce(): void {
    this.letGo();
    if (this.rising_ !== undefined) this.release(this.rising_.device);
  }

  /** Lets the force of every hand go: what they held has gone. */
  releaseAll(): void {
    this.letGoAtOnce();
    for (const device of this.left_.keys()) this.hooks_.send(encodeRelease(device));
    this.left_.clear();
  }

  /** Bit i: button i of the chosen hand's device is down. */
  press(buttons: number): void {
    this.buttons_ = buttons;
    this.hooks_.send(encodePress(buttons, this.chosen_));
  }

  /** Turns the stylus of the chosen hand; absent: as it is. */
  turn(turned: Turned | undefined, gripper_rad: number | undefined): void {
    this.hooks_.send(encodeHandTurn(turned, gripper_rad, this.chosen_));
  }

  /** The hands that are moved explore; all have one grip, as states report that of the first alone; the rest is its. */
  sendSettings(change: SettingsChange): void {
    const { explore, handFirm, ...rest } = change;
    if (explore !== undefined) {
      this.moved.forEach((device) => this.hooks_.send(encodeSettings({ explore }, device)));
    }
    if (handFirm !== undefined) {
      for (const device of this.devices_.keys()) this.hooks_.send(encodeSettings({ handFirm }, device));
    }
    if (Object.keys(rest).length > 0) this.hooks_.send(encodeSettings(rest));
  }

  private get simulated(): number[] {
    return [...this.devices_.keys()].filter((i) => i < this.reported_ && this.devices_[i]!.simulatedHand);
  }

  private get several(): boolean {
    return this.simulated.length > 1;
  }

  /** The first that can be moved; none can: that of the first device. */
  private get firstHand(): number {
    return this.simulated[0] ?? 0;
  }

  /** What moves when the chosen hand does. */
  private get moved(): number[] {
    return this.together_ ? this.simulated : [this.chosen_];
  }

  /** A released hand wants to stay where its finger is. Beneath a surface it comes up to the proxy first. */
  private leave(device: number): void {
    const hand = handOf(this.hooks_.state(), device);
    if (hand?.proxy !== undefined && hand.touching && !hand.exploring) {
      this.rising_ = { device };
      this.hooks_.send(encodeHandGoal(hand.proxy, device));
    } else {
      this.release(device);
    }
  }

  private endRise(now_ms: number): void {
    const { rising_: rising } = this;
    if (rising === undefined) return;
    rising.begin_ms ??= now_ms;
    const hand = handOf(this.hooks_.state(), rising.device);
    const { finger, proxy } = hand ?? {};
    const near_m = kUp_D * this.hooks_.worldPerHand();
    const under = hand?.touching === true && finger !== undefined && proxy !== undefined &&
      length(sub(finger, proxy)) > near_m;
    if (!under || now_ms - rising.begin_ms > kRise_ms) this.release(rising.device);
  }

  private release(device: number): void {
    this.rising_ = undefined;
    this.hooks_.send(encodeRelease(device));
  }

  private startOf(device: number): Vec | undefined {
    const finger = handOf(this.hooks_.state(), device)?.finger;
    const left = this.left_.get(device);
    const elsewhere = left !== undefined && finger !== undefined &&
      length(sub(left, finger)) > kElsewhere_D * this.hooks_.worldPerHand();
    return elsewhere ? finger : left ?? finger;
  }

  private sendGoals(hold: Hold): void {
    hold.unsent = false;
    this.hooks_.send(encodeHandGoal(hold.goal, this.chosen_));
    for (const [device, offset] of hold.along) {
      const goal = add(hold.goal, offset);
      this.left_.set(device, goal);
      this.hooks_.send(encodeHandGoal(goal, device));
    }
  }
}
