// Turning the stylus of a simulated hand: while Q is held, the pointer's motion, the wheel and the arrow keys turn it in
// place of moving the hand; G opens and closes its gripper. At most one message is sent per drawn frame.

import * as THREE from "three";
import { isEditing } from "./elements";
import type { DeviceInfo, Stylus } from "./gen/hl_pb";
import { kTurn_rad_px, turnedBy, turnOf, type Turn } from "./stylus_turn";

const kKey = "KeyQ";
const kGripperKey = "KeyG";
/** One press of an arrow key. */
const kKey_rad = (5 * Math.PI) / 180;
const kArrows: Readonly<Record<string, Turn>> = {
  ArrowLeft: { right_rad: -kKey_rad, down_rad: 0, roll_rad: 0 },
  ArrowRight: { right_rad: kKey_rad, down_rad: 0, roll_rad: 0 },
  ArrowUp: { right_rad: 0, down_rad: -kKey_rad, roll_rad: 0 },
  ArrowDown: { right_rad: 0, down_rad: kKey_rad, roll_rad: 0 },
  KeyW: { right_rad: 0, down_rad: 0, roll_rad: kKey_rad },
  KeyS: { right_rad: 0, down_rad: 0, roll_rad: -kKey_rad },
};

export class TurnInput {
  private held_ = false;
  private unsent_ = false;
  private opened_ = false;
  private goal_: THREE.Quaternion | undefined;
  private gripper_rad_: number | undefined;
  private device_: DeviceInfo | undefined;

  /** `send` gets what has changed; `enabled`: a simulated hand holds a device that is live. */
  constructor(
    private readonly send_: (turned: THREE.Quaternion | undefined, gripper_rad: number | undefined) => void,
    private readonly camera_: () => THREE.Quaternion,
    private readonly stylus_: () => Stylus | undefined,
    private readonly enabled_: () => boolean,
  ) {
    const early = { capture: true, passive: false };
    window.addEventListener("keydown", (event) => this.keyDown(event), early);
    window.addEventListener("keyup", (event) => this.keyUp(event), early);
    window.addEventListener("blur", () => this.letGo());
    window.addEventListener("pointermove", (event) => this.pointer(event), early);
    window.addEventListener("wheel", (event) => this.wheel(event), early);
  }

  /** Another device, with its gripper as it is now. */
  setDevice(device: DeviceInfo | undefined): void {
    this.device_ = device;
    this.opened_ = this.hasGripper && (this.stylus_()?.gripperRad ?? 0) > 0.5 * device!.gripperMaxRad;
    this.letGo();
  }

  get hasGripper(): boolean {
    return (this.device_?.gripperMaxRad ?? 0) > 0;
  }

  /** Once per drawn frame. */
  frame(): void {
    const [turned, gripper_rad] = [this.unsent_ ? this.goal_ : undefined, this.gripper_rad_];
    if (turned === undefined && gripper_rad === undefined) return;
    this.unsent_ = false;
    this.gripper_rad_ = undefined;
    this.send_(turned, gripper_rad);
  }

  private letGo(): void {
    this.held_ = false;
    this.goal_ = undefined;
  }

  private get turns(): boolean {
    return this.held_ && this.enabled_() && this.device_?.hasWrist === true;
  }

  private keyDown(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || isEditing(event.target)) return;
    if (event.code === kKey) this.held_ = true;
    if (event.code === kGripperKey && !event.repeat) this.toggleGripper();
    const turn = kArrows[event.code];
    if (turn !== undefined && this.turns) this.turn(turn, event);
  }

  private keyUp(event: KeyboardEvent): void {
    if (event.code === kKey) this.letGo();
  }

  private toggleGripper(): void {
    if (!this.hasGripper || !this.enabled_()) return;
    this.opened_ = !this.opened_;
    this.gripper_rad_ = this.opened_ ? this.device_!.gripperMaxRad : 0;
  }

  private pointer(event: PointerEvent): void {
    if (!this.turns) return;
    this.turn({ right_rad: kTurn_rad_px * event.movementX, down_rad: kTurn_rad_px * event.movementY, roll_rad: 0 }, event);
  }

  private wheel(event: WheelEvent): void {
    if (!this.turns) return;
    this.turn({ right_rad: 0, down_rad: 0, roll_rad: 0.2 * kTurn_rad_px * event.deltaY }, event);
  }

  private turn(turn: Turn, event: Event): void {
    this.goal_ ??= turnOf(this.stylus_()?.rotation);
    if (this.goal_ === undefined) return;
    this.goal_ = turnedBy(this.goal_, turn, this.camera_());
    this.unsent_ = true;
    event.preventDefault();
    event.stopImmediatePropagation();
  }
}
