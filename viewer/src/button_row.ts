// The device's buttons, each with a lamp that is on while it is down. A device does not say how many it has: the row is as
// long as the highest one that was ever pressed, and not there before.

import { element } from "./elements";

/** How many lamps to show when `before` were shown and the bits of `down` are down. */
export function lampsFor(before: number, down: number): number {
  return Math.max(before, 32 - Math.clz32(down));
}

export class ButtonRow {
  private readonly host_ = element("buttons");
  private lamps_ = 0;

  /** Another device. */
  forget(): void {
    this.lamps_ = 0;
    this.show(0);
  }

  /** Bit i of `down`: button i is down. */
  show(down: number): void {
    this.lamps_ = lampsFor(this.lamps_, down);
    this.host_.hidden = this.lamps_ === 0;
    while (this.host_.childElementCount > this.lamps_) {
      this.host_.lastElementChild!.remove();
    }
    while (this.host_.childElementCount < this.lamps_) {
      this.host_.append(this.makeLamp(this.host_.childElementCount + 1));
    }
    [...this.host_.children].forEach((lamp, i) => lamp.classList.toggle("down", ((down >>> i) & 1) === 1));
  }

  private makeLamp(number: number): HTMLElement {
    const lamp = document.createElement("span");
    lamp.className = "lamp";
    lamp.textContent = String(number);
    return lamp;
  }
}
