// Sliders fire with every pixel of a drag; the server closes a page that sends hundreds of messages a second. Here the
// first call acts immediately, later ones at most once per period, and the last one is never lost.

/** A slider sends at most so often. */
export const kSendPeriod_ms = 30;

/** The function that may be called as often as the user likes. */
export function paced(act: () => void, period_ms: number): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let waiting = false;
  const run = () => {
    waiting = false;
    timer = setTimeout(() => {
      timer = undefined;
      if (waiting) run();
    }, period_ms);
    act();
  };
  return () => {
    waiting = true;
    if (timer === undefined) run();
  };
}
