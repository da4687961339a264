// A bar of a round length at the depth of what the view turns about.

import { element, setText } from "./elements";
import { formatSi } from "./units";

/** It is at most this long. */
const kLongest_px = 120;

/** The longest of 1, 2 or 5 times a power of ten that is not above `most`. */
export function roundLength(most: number): number {
  const decade = 10 ** Math.floor(Math.log10(most) + 1e-9);
  return [5, 2, 1].map((factor) => factor * decade).find((length) => length <= most * (1 + 1e-9)) ?? decade;
}

export class ScaleBar {
  private shown_m_ = 0;
  private shown_px_ = 0;

  show(metresPerPixel: number): void {
    const known = metresPerPixel > 0 && Number.isFinite(metresPerPixel);
    element("scale-bar").hidden = !known;
    if (!known) {
      return;
    }
    const length_m = roundLength(kLongest_px * metresPerPixel);
    const length_px = Math.round(length_m / metresPerPixel);
    if (length_m !== this.shown_m_ || length_px !== this.shown_px_) {
      [this.shown_m_, this.shown_px_] = [length_m, length_px];
      element("scale-line").style.width = `${length_px}px`;
      setText("scale-length", formatSi(length_m, "m", 1));
    }
  }
}
