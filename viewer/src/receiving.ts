// What is shown while a scene is on its way: a large one takes the server and the network many seconds, in which a page
// without it looks as if it had none.

import type { Ahead } from "./scene_store";
import { countedParts } from "./units";

/** A scene that comes sooner is not announced. */
const kShort_ms = 300;

export class Receiving {
  private since_ms_: number | undefined;

  /** `ahead`: what has come of a scene that is awaited; undefined: none is. The line to show; undefined: none. */
  line(ahead: Ahead | undefined, now_ms: number): string | undefined {
    this.since_ms_ = ahead === undefined ? undefined : (this.since_ms_ ?? now_ms);
    if (ahead === undefined || this.since_ms_ === undefined || now_ms - this.since_ms_ < kShort_ms) {
      return undefined;
    }
    const come = countedParts([[ahead.triangles, "triangle"], [ahead.points, "point"]]);
    return come === "" ? "Receiving the scene…" : `Receiving the scene… ${come} so far`;
  }
}
