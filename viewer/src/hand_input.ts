// Mouse, touch and keys to hand goals. Left-drag (or one finger) moves the goal in the view plane, the wheel during a
// drag and W/S or PageUp/PageDown move it in depth, arrow keys sideways. The orbit controls keep every other gesture.
// At most one goal is sent per drawn frame.

import * as THREE from "three";
import { depthOf, metresPerPixel, moveInDepth, moveInView, wheelPixels } from "./hand_mapping";
import type { Stage } from "./stage";
import { add, scale, type Vec } from "./vec";

export interface HandHooks {
  /** Where the finger is now; undefined before the first state: no drag can start. */
  finger(): Vec | undefined;
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
/** A page that was hidden or busy must not jump: at most this much of a hold counts at once. */
const kKeyStep_s = 0.25;
/** One wheel notch (about 100 pixels) moves the hand as far as a drag of 30 pixels. */
const kWheelShare = 0.3;

export class HandInput {
  /** False when a person holds the device: then every left-drag orbits, and no key moves anything. */
  movable = true;
  /** When set, a left-drag that starts on empty space orbits instead. */
  orbitFromEmpty = false;
  private readonly stage_: Stage;
  private readonly hooks_: HandHooks;
  private readonly canvas_: HTMLCanvasElement;
  private readonly pressed_ = new Set<string>();
  private readonly touches_ = new Set<number>();
  private pointer_: number | undefined;
  private last_px_ = { x: 0, y: 0 };
  private goal_: Vec | undefined;
  private unsent_ = false;
  private moved_ms_ = 0;

  constructor(stage: Stage, hooks: HandHooks) {
    this.stage_ = stage;
    this.hooks_ = hooks;
    this.canvas_ = stage.renderer.domElement;
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

  get holding(): boolean {
    return this.goal_ !== undefined;
  }

  /** Moves by the keys held and sends the goal when it changed. Once per drawn frame. */
  frame(): void {
    this.moveByKeys();
    if (this.unsent_ && this.goal_ !== undefined) {
      this.hooks_.goal(this.goal_);
      this.unsent_ = false;
    }
  }

  /** Lets go, whatever was held. */
  cancel(): void {
    this.pointer_ = undefined;
    this.pressed_.clear();
    this.letGo();
  }

  private down(event: PointerEvent): void {
    if (event.pointerType === "touch") {
      this.touches_.add(event.pointerId);
      // The second finger makes it a camera gesture.
      if (this.touches_.size > 1) {
        this.cancel();
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
      this.pointer_ = event.pointerId;
      this.last_px_ = at;
      this.canvas_.setPointerCapture(event.pointerId);
      this.canvas_.classList.add("dragging");
    }
  }

  private wantsOrbit(event: PointerEvent, at: { x: number; y: number }): boolean {
    return event.shiftKey || !this.movable || (this.orbitFromEmpty && !this.hooks_.isTarget(at.x, at.y));
  }

  private move(event: PointerEvent): void {
    if (event.pointerId !== this.pointer_ || this.goal_ === undefined) {
      return;
    }
    const at = this.local(event);
    const view = this.stage_.viewFrame();
    this.setGoal(moveInView(view, this.goal_, at.x - this.last_px_.x, at.y - this.last_px_.y));
    this.last_px_ = at;
  }

  private up(event: PointerEvent): void {
    this.touches_.delete(event.pointerId);
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
    const view = this.stage_.viewFrame();
    const pixels = -wheelPixels(event.deltaY, event.deltaMode, view.height_px) * kWheelShare;
    const distance = pixels * metresPerPixel(view, depthOf(view, this.goal_));
    this.setGoal(moveInDepth(view, this.goal_, distance, this.stage_.near_m));
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
    if (this.pressed_.size === 0 || goal === undefined) {
      return;
    }
    let direction: Vec = { x: 0, y: 0, z: 0 };
    for (const code of this.pressed_) {
      direction = add(direction, kKeys[code]!);
    }
    const view = this.stage_.viewFrame();
    const step = kKeyHeights_s * view.height_px * metresPerPixel(view, depthOf(view, goal)) * elapsed_s;
    const sideways = add(scale(view.right, direction.x * step), scale(view.up, direction.y * step));
    this.setGoal(moveInDepth(view, add(goal, sideways), direction.z * step, this.stage_.near_m));
  }

  /** Takes the hand where the finger is. */
  private grab(): boolean {
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
    if (this.pointer_ !== undefined || this.pressed_.size > 0 || this.goal_ === undefined) {
      return;
    }
    if (this.unsent_) {
      this.hooks_.goal(this.goal_);
    }
    this.goal_ = undefined;
    this.unsent_ = false;
    this.canvas_.classList.remove("dragging");
    this.hooks_.release();
  }

  private local(event: PointerEvent): { x: number; y: number } {
    const box = this.canvas_.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }
}

/** Keys belong to the slider, the radio buttons and the open dialog while those have the focus. */
function isEditing(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest("input[type=range], input[type=radio], dialog") !== null;
}
