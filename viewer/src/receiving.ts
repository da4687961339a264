// What is shown while a scene is on its way: a large one takes the server and the network many seconds, in which a page
// without it looks as if it had none.

import { formatCount, kNoBreak, nounFor } from "./units";

/** A scene that comes sooner is not announced. */
const kShort_ms = 300;

export class Receiving {
  private since_ms_: number | undefined;

  /** `coming`: a scene is awaited; `triangles`: those of it that have come. The line to show; undefined: none. */
  line(coming: boolean, triangles: number, now_ms: number): string | undefined {
    this.since_ms_ = coming ? (this.since_ms_ ?? now_ms) : undefined;
    if (this.since_ms_ === undefined || now_ms - this.since_ms_ < kShort_ms) {
      return undefined;
    }
    const soFar = `${formatCount(triangles)}${kNoBreak}${nounFor(triangles, "triangle")} so far`;
    return triangles > 0 ? `Receiving the scene… ${soFar}` : "Receiving the scene…";
  }
}
