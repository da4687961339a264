// Which lines stay when another one is told, and for how long. A line is about a thing that the user does: what went well
// takes the place of all that was told of it before and goes by itself, what went wrong stays until it is closed or goes
// well. A line about nothing is of the server, and stays until it is closed.

export interface ToldLine {
  readonly text: string;
  readonly bad: boolean;
  readonly about?: string | undefined;
}

/** Of all lines together; the oldest ones go first. */
const kMax = 4;
/** Of a line that goes by itself: what it takes to notice it, and to read it. */
const kNotice_ms = 6000;
const kRead_ms = 100;

/** Those of `shown`, the oldest first, that stay when `next` comes. */
export function stayingWith<Line extends ToldLine>(shown: readonly Line[], next: ToldLine): Line[] {
  const stays = ({ text, bad, about }: ToldLine) => {
    const repeated = text === next.text && bad === next.bad;
    const settled = about !== undefined && about === next.about && !(bad && next.bad);
    return !repeated && !settled;
  };
  return shown.filter(stays).slice(1 - kMax);
}

/** After so long it goes by itself; undefined: it does not. */
export function lifeOf({ text, bad, about }: ToldLine): number | undefined {
  return bad || about === undefined ? undefined : kNotice_ms + kRead_ms * text.length;
}
