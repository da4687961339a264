// An arrow at the edge of the view that points to the hand while that is not in view; a click brings the hand back.

import { edgeMark, type Rect } from "./edge_mark";
import { element, setText } from "./elements";
import { formatSi } from "./units";

/** Half of what it covers, and a gap. */
const kMargin_px = { x: 80, y: 26 };

export class HandFinder {
  private readonly mark_ = element("finder");

  constructor(bringBack: () => void) {
    this.mark_.addEventListener("click", bringBack);
  }

  /** `hand` as it is on the canvas, undefined: not known; `distance_m` from the middle of the view. */
  show(hand: { x: number; y: number; depth_m: number } | undefined, view: Rect, distance_m: number): void {
    const mark = hand && edgeMark(hand, view, kMargin_px);
    this.mark_.hidden = mark === undefined;
    if (mark !== undefined) {
      this.mark_.style.left = `${Math.round(mark.x)}px`;
      this.mark_.style.top = `${Math.round(mark.y)}px`;
      element("finder-arrow").style.transform = `rotate(${mark.angle_rad.toFixed(2)}rad)`;
      setText("finder-distance", formatSi(distance_m, "m", 2));
    }
  }
}
