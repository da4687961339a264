// Which lines stay when another one is reported, and for how long. A line is about an action of the user: a success
// takes the place of all that was reported of it before and goes by itself, what went wrong stays until it is closed
// or goes well. A line about nothing is of the server, and stays until it is closed.

export interface ReportedLine {
  readonly text: string;
  readonly bad: boolean;
  readonly about?: string | undefined;
  /** Of a connection that broke: it is past when the server is heard again. */
  readonly broke?: boolean;
}

/** Those of `shown` that stay when the server is heard again. */
export function stayingConnected<Line extends ReportedLine>(shown: readonly Line[]): Line[] {
  return shown.filter(({ broke }) => broke !== true);
}

/** Of all lines together; the oldest ones go first. */
const kMax = 4;
/** Of a line that goes by itself: what it takes to notice it, and to read it. */
const kNotice_ms = 6000;
const kRead_ms = 100;

/** Those of `shown`, the oldest first, that stay when `next` comes. */
export function stayingWith<Line extends ReportedLine>(shown: readonly Line[], next: ReportedLine): Line[] {
  const stays = ({ text, bad, about }: ReportedLine) => {
    const repeated = text === next.text && bad === next.bad;
    const settled = about !== undefined && about === next.about && !(bad && next.bad);
    return !repeated && !settled;
  };
  return shown.filter(stays).slice(1 - kMax);
}

/** After so long it goes by itself; undefined: it does not. */
export function lifeOf({ text, bad, about }: ReportedLine): number | undefined {
  return bad || about === undefined ? undefined : kNotice_ms + kRead_ms * text.length;
}
