// Mouse, touch and keys to hand goals. A press on the model (left button or one finger) touches what is under the
// pointer (press.ts); elsewhere a drag moves the goal in the view plane. The wheel, Shift or a second finger during a
// drag, and W/S or PageUp/PageDown, move it in depth, arrow keys sideways. The orbit controls keep every other gesture.
// At most one goal is sent per drawn frame.

import * as THREE from "three";
import { isEditing } from "./elements";
import { depthOf, metresPerPixel, moveInDepth, moveInView, wheelPixels } from "./hand_mapping";
import type { Errand, Press, SurfaceHit } from "./press";
import type { Stage } from "./stage";
import { add, kZero, length, scale, sub, type Vec } from "./vec";

export interface HandHooks {
  /** Where the finger is now; undefined before the first state: no drag can start. */
  finger(): Vec | undefined;
  proxy(): Vec | undefined;
  /** A press at this pixel touches the model; undefined: it takes the hand where it is. */
  press(x_px: number, y_px: number): Press | undefined;
  /** Whether objects are elsewhere than they were in the last frame. */
  moving(): boolean;
  /** What the pixel shows of the model. */
  surface(x_px: number, y_px: number): SurfaceHit | undefined;
  goal(position: Vec): void;
  release(): void;
  /** True when the pixel shows the model or the hand's marks, so that a press there is meant for the hand. */
  isTarget(x_px: number, y_px: number): boolean;
}

/** Keys as directions: x right, y up, z away from the viewer. */
const kKeys: Readonly<Record<string, Vec>> = {
  KeyW: { x: 0, y: 0, z: 1 },
  PageUp: { x: 0, y: 0, z: 1 },
  KeyS: { x: 0, y: 0, z: -1 },
  PageDown: { x: 0, y: 0, z: -1 },
  ArrowLeft: { x: -1, y: 0, z: 0 },
  ArrowRight: { x: 1, y: 0, z: 0 },
  ArrowUp: { x: 0, y: 1, z: 0 },
  ArrowDown: { x: 0, y: -1, z: 0 },
};

/** A held key crosses this share of the window's height in a second. */
const kKeyHeights_s = 0.2;
/** A page that was hidden or busy must not jump: at most this much of a hold counts in one step. */
const kKeyStep_s = 0.05;
/** One wheel notch (about 100 pixels) moves the hand as far as a drag of 30 pixels. */
const kWheelShare = 0.3;
/** Two fingers that come within this time are a camera gesture, wherever they are. */
const kPinch_ms = 250;

export class HandInput {
  /** False when a person holds the device: then every left-drag orbits, and no key moves anything. */
  movable = true;
  /** When set, a left-drag that starts on empty space orbits instead. */
  orbitFromEmpty = false;
  private readonly stage_: Stage;
  private readonly hooks_: HandHooks;
  private readonly canvas_: HTMLCanvasElement;
  private readonly pressed_ = new Set<string>();
  private pushed_: Vec = kZero;
  private readonly touches_ = new Set<number>();
  private pointer_: number | undefined;
  /** A second finger that moves the hand in depth. */
  private depthPointer_: number | undefined;
  private depth_px_ = 0;
  private last_px_ = { x: 0, y: 0 };
  private press_: Press | undefined;
  /** The hand goes along this by itself. */
  private errand_: Errand | undefined;
  private began_ms_ = 0;
  private goal_: Vec | undefined;
  private unsent_ = false;
  private moved_ms_ = 0;

  constructor(stage: Stage, hooks: HandHooks) {
    this.stage_ = stage;
    this.hooks_ = hooks;
    this.canvas_ = stage.canvas;
    stage.controls.mouseButtons = { LEFT: null, MIDDLE: THREE.MOUSE.PAN, RIGHT: THREE.MOUSE.ROTATE };
    stage.controls.touches = { ONE: null, TWO: THREE.TOUCH.DOLLY_ROTATE };
    // Capture: this listener decides about the gesture before the orbit controls see it.
    this.canvas_.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
    this.canvas_.addEventListener("pointermove", (event) => this.move(event));
    for (const type of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
      this.canvas_.addEventListener(type, (event) => this.up(event));
    }
    this.canvas_.addEventListener("wheel", (event) => this.wheel(event), { capture: true, passive: false });
    window.addEventListener("keydown", (event) => this.keyDown(event));
    window.addEventListener("keyup", (event) => this.keyUp(event));
    window.addEventListener("blur", () => this.cancel());
  }

  /** What is pressed of the model. */
  get pressed(): SurfaceHit | undefined {
    return this.press_?.hit;
  }

  get holding(): boolean {
    return this.goal_ !== undefined;
  }

  /** Moves by the keys held and sends the goal when it changed. Once per drawn frame. */
  frame(): void {
    this.moveByKeys();
    this.followLeader();
    if (this.unsent_ && this.goal_ !== undefined) {
      this.hooks_.goal(this.goal_);
      this.unsent_ = false;
    }
  }

  /** A gamepad pushes in this direction, as keys do; zero lets go. */
  push(direction: Vec): void {
    const pushed = length(direction) > 0;
    if (pushed === length(this.pushed_) > 0 && !pushed) {
      return;
    }
    this.moveByKeys();
    this.pushed_ = pushed && (this.holding || this.grab()) ? direction : kZero;
    if (!pushed) {
      this.letGo();
    }
  }

  /** Leads the hand along a way, then leaves it there; a press or a key ends it. */
  send(errand: Errand): void {
    if (this.pointer_ === undefined && this.pressed_.size === 0 && length(this.pushed_) === 0 && this.grab()) {
      this.errand_ = errand;
    }
  }

  /** Lets go, whatever was held. */
  cancel(): void {
    this.pointer_ = this.depthPointer_ = undefined;
    this.pressed_.clear();
    this.errand_ = undefined;
    this.pushed_ = kZero;
    this.letGo();
  }

  private down(event: PointerEvent): void {
    if (event.pointerType === "touch") {
      this.touches_.add(event.pointerId);
      if (this.touches_.size > 1) {
        this.secondFinger(event);
        return;
      }
    }
    if (event.button !== 0 || this.pointer_ !== undefined) {
      return;
    }
    const at = this.local(event);
    const orbit = event.pointerType !== "touch" && this.wantsOrbit(event, at);
    // The controls turn a left-drag with Shift into the other of rotate and pan: ask for pan to get rotate.
    this.stage_.controls.mouseButtons.LEFT = orbit ? (event.shiftKey ? THREE.MOUSE.PAN : THREE.MOUSE.ROTATE) : null;
    if (!orbit && this.grab()) {
      this.press_ = this.hooks_.press(at.x, at.y);
      this.began_ms_ = performance.now();
      this.pointer_ = event.pointerId;
      this.last_px_ = at;
      this.canvas_.setPointerCapture(event.pointerId);
      this.canvas_.classList.add("dragging");
    }
  }

  /** Depth, when the first finger presses the model for a while already; else the camera's. */
  private secondFinger(event: PointerEvent): void {
    const pressing = this.press_ !== undefined && performance.now() - this.began_ms_ > kPinch_ms;
    if (!pressing || this.touches_.size > 2) {
      this.cancel();
      return;
    }
    event.stopImmediatePropagation();
    this.depthPointer_ = event.pointerId;
    this.depth_px_ = this.local(event).y;
  }

  private wantsOrbit(event: PointerEvent, at: { x: number; y: number }): boolean {
    return event.shiftKey || !this.movable || (this.orbitFromEmpty && !this.hooks_.isTarget(at.x, at.y));
  }

  private move(event: PointerEvent): void {
    const at = this.local(event);
    if (event.pointerId === this.depthPointer_) {
      this.moveDeeper(this.depth_px_ - at.y);
      this.depth_px_ = at.y;
    } else if (event.pointerId === this.pointer_ && this.goal_ !== undefined) {
      if (event.shiftKey) {
        this.moveDeeper(this.last_px_.y - at.y);
      } else {
        this.moveSideways(this.goal_, at);
      }
      this.last_px_ = at;
    }
  }

  private moveSideways(goal: Vec, at: { x: number; y: number }): void {
    const hit = this.press_ && this.hooks_.surface(at.x, at.y);
    if (hit !== undefined) {
      this.press_!.slide(hit);
      return;
    }
    const moved = moveInView(this.stage_.viewFrame(), goal, at.x - this.last_px_.x, at.y - this.last_px_.y);
    this.press_?.leave(moved);
    this.setGoal(moved);
  }

  /** Away from the viewer, or into what is pressed, as far as a drag of so many pixels. */
  private moveDeeper(pixels: number): void {
    const view = this.stage_.viewFrame();
    if (this.goal_ !== undefined) {
      this.deepen(this.goal_, pixels * metresPerPixel(view, depthOf(view, this.goal_)));
    }
  }

  private deepen(goal: Vec, distance_m: number): void {
    if (this.press_ !== undefined) {
      this.press_.deepen(distance_m);
    } else {
      this.setGoal(moveInDepth(this.stage_.viewFrame(), goal, distance_m, this.stage_.near_m));
    }
  }

  /** A press leads the hand to where it is to touch, and keeps it there; an errand leaves it. */
  private followLeader(): void {
    const proxy = this.hooks_.proxy();
    const leader = this.press_ ?? this.errand_;
    if (leader === undefined || this.goal_ === undefined || proxy === undefined) {
      return;
    }
    if (this.errand_?.ended === true) {
      this.errand_ = undefined;
      this.letGo();
      return;
    }
    // What moves under a pointer that rests is followed.
    const hit = this.press_ && this.hooks_.moving() ? this.hooks_.surface(this.last_px_.x, this.last_px_.y) : undefined;
    if (hit !== undefined) {
      this.press_!.slide(hit);
    }
    const goal = leader.goal(proxy, performance.now());
    if (length(sub(goal, this.goal_)) > 0) {
      this.setGoal(goal);
    }
  }

  private up(event: PointerEvent): void {
    this.touches_.delete(event.pointerId);
    if (event.pointerId === this.depthPointer_) {
      this.depthPointer_ = undefined;
    }
    if (event.pointerId === this.pointer_) {
      this.pointer_ = undefined;
      this.letGo();
    }
  }

  private wheel(event: WheelEvent): void {
    if (this.pointer_ === undefined || this.goal_ === undefined) {
      return;
    }
    event.preventDefault();
    event.stopImmediatePropagation();
    // Shift turns the wheel sideways in some browsers.
    const turned = event.deltaY || event.deltaX;
    this.moveDeeper(-wheelPixels(turned, event.deltaMode, this.stage_.size_px.height) * kWheelShare);
  }

  private keyDown(event: KeyboardEvent): void {
    if (!(event.code in kKeys) || event.ctrlKey || event.altKey || event.metaKey || isEditing(event.target)) {
      return;
    }
    event.preventDefault();
    this.moveByKeys();
    if (this.grab()) {
      this.pressed_.add(event.code);
    }
  }

  private keyUp(event: KeyboardEvent): void {
    this.moveByKeys();
    if (this.pressed_.delete(event.code)) {
      this.letGo();
    }
  }

  /** Moves by the keys held since the last call, so that a short tap counts even between two frames. */
  private moveByKeys(): void {
    const now_ms = performance.now();
    const elapsed_s = Math.min(kKeyStep_s, (now_ms - this.moved_ms_) / 1000);
    this.moved_ms_ = now_ms;
    const goal = this.goal_;
    if (goal === undefined || (this.pressed_.size === 0 && length(this.pushed_) === 0)) {
      return;
    }
    let direction = this.pushed_;
    for (const code of this.pressed_) {
      direction = add(direction, kKeys[code]!);
    }
    const view = this.stage_.viewFrame();
    const step = kKeyHeights_s * view.height_px * metresPerPixel(view, depthOf(view, goal)) * elapsed_s;
    const sideways = add(scale(view.right, direction.x * step), scale(view.up, direction.y * step));
    this.deepen(add(goal, sideways), direction.z * step);
  }

  /** Takes the hand where the finger is. */
  private grab(): boolean {
    if (this.errand_ !== undefined) {
      this.errand_ = undefined;
      this.goal_ = undefined;
    }
    if (this.movable) {
      this.goal_ ??= this.hooks_.finger();
    }
    if (this.goal_ === undefined) {
      return false;
    }
    this.unsent_ = true;
    return true;
  }

  private setGoal(goal: Vec): void {
    this.goal_ = goal;
    this.unsent_ = true;
  }

  /** Ends the hold when neither pointer nor key holds any more. */
  private letGo(): void {
    const held = this.pointer_ !== undefined || this.pressed_.size > 0 || length(this.pushed_) > 0;
    if (held || this.errand_ !== undefined || this.goal_ === undefined) {
      return;
    }
    if (this.unsent_) {
      this.hooks_.goal(this.goal_);
    }
    this.goal_ = this.press_ = undefined;
    this.unsent_ = false;
    this.canvas_.classList.remove("dragging");
    this.hooks_.release();
  }

  private local(event: PointerEvent): { x: number; y: number } {
    const box = this.canvas_.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }
}
