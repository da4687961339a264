// All that moves a simulated hand: pointer, touch, keys, gamepad, buttons and the turning of its stylus, for the hand that
// is chosen, and for all together.

import { ButtonInput } from "./button_input";
import { padState } from "./gamepad";
import type { Hello, State } from "./gen/hl_pb";
import { HandInput } from "./hand_input";
import type { LiveScene } from "./live_scene";
import { kSayAgain_ms, MovedHands } from "./moved_hands";
import type { Pointing } from "./pointing";
import type { SettingsChange } from "./protocol";
import type { Stage } from "./stage";
import { TurnInput } from "./turn_input";

export interface HandControlHooks {
  send(message: Uint8Array<ArrayBuffer>): void;
  /** Says that the page is there. */
  here(): void;
  /** The newest one. */
  state(): State | undefined;
  /** Whether the server is heard now: where a hand is, is known. */
  heard(): boolean;
  /** The choice, or what can be chosen, is another one. */
  changed(): void;
}

export class HandControls {
  readonly hands: MovedHands;
  readonly input: HandInput;
  private readonly buttons_: ButtonInput;
  private readonly turn_: TurnInput;
  private active_ = true;

  constructor(stage: Stage, live: LiveScene, pointing: Pointing, hooks: HandControlHooks) {
    this.hands = new MovedHands({
      send: (message) => hooks.send(message),
      here: () => hooks.here(),
      state: () => hooks.state(),
      worldPerHand: () => pointing.worldPerHand,
      changed: () => {
        this.turn_.setDevice(this.hands.device);
        this.enable();
        hooks.changed();
      },
    });
    this.input = this.makeInput(stage, live, pointing, hooks);
    this.buttons_ = new ButtonInput((down) => this.hands.press(down));
    this.turn_ = new TurnInput(
      (turned, gripper_rad) => this.hands.turn(turned, gripper_rad), () => stage.camera.quaternion,
      () => this.hands.now?.stylus, () => this.buttons_.enabled,
    );
    setInterval(() => this.hands.sayAgain(), kSayAgain_ms);
    // Timers of a hidden page are too slow for that.
    document.addEventListener("visibilitychange", () => document.hidden && this.release());
  }

  /** False while something else than the live session is shown: no hand moves. */
  set active(on: boolean) {
    this.active_ = on;
    this.enable();
  }

  showHello(hello: Hello): void {
    this.input.cancel();
    this.hands.showHello(hello);
  }

  choose(device: number): void {
    this.change(() => this.hands.choose(device));
  }

  chooseNext(): void {
    this.change(() => this.hands.chooseNext());
  }

  toggleTogether(): void {
    this.change(() => this.hands.setTogether(!this.hands.choice.together));
  }

  /** Another scene has taken the place of the one that the hands touched. */
  release(): void {
    this.input.cancel();
    this.hands.releaseAll();
  }

  sendSettings(change: SettingsChange): void {
    this.hands.sendSettings(change);
  }

  /** Nothing is sent to the session for a while. */
  leave(): void {
    this.input.cancel();
    this.hands.letGoAtOnce();
    this.active = false;
  }

  /** Once per drawn frame. */
  frame(now_ms: number): void {
    const { direction, buttons } = padState(navigator.getGamepads?.() ?? []);
    this.input.push(direction);
    this.buttons_.setPad(buttons);
    this.input.frame();
    this.hands.frame(now_ms);
    this.turn_.frame();
  }

  /** What is held is left first. One hand alone is no choice: its hold goes on. */
  private change(act: () => void): void {
    if (this.hands.choice.simulated.length > 1) {
      this.input.cancel();
      act();
    }
  }

  private enable(): void {
    this.input.movable = this.buttons_.enabled = this.active_ && this.hands.movable;
  }

  private makeInput(stage: Stage, live: LiveScene, pointing: Pointing, hooks: HandControlHooks): HandInput {
    const { hands } = this;
    return new HandInput(stage, {
      finger: () => (hooks.heard() ? hands.grab() : undefined),
      proxy: () => hands.now?.proxy,
      goal: (position) => hands.goal(position, performance.now()),
      release: () => hands.letGo(),
      moving: () => live.moving,
      // Together the hands are moved as they are: what they hold between them is under the pointer.
      press: (x_px, y_px) => (hands.choice.together ? undefined : pointing.press(x_px, y_px)),
      surface: (x_px, y_px) => pointing.surfaceAt(x_px, y_px),
      isTarget: (x_px, y_px) => pointing.isNearHand(x_px, y_px) || pointing.surfaceAt(x_px, y_px) !== undefined,
    });
  }
}
