// Why ticks ended, in words, for a tooltip. The readouts show only the three kinds that a user should know of: those
// in which the proxy did not get as far as it could.

import { TicksEndedSchema, type TicksEnded } from "./gen/hl_pb";
import { formatCount } from "./units";

/** By the names of the protocol, those that have occurred; empty when none has, or when the server sends none. */
export function describeEndings(ticks: TicksEnded | undefined): string {
  if (ticks === undefined) {
    return "";
  }
  const counts = TicksEndedSchema.fields.map(({ name, localName }) => ({
    name: name.replaceAll("_", " "),
    count: ticks[localName as keyof TicksEnded] as bigint,
  }));
  const occurred = counts.filter(({ count }) => count > 0n).map(({ name, count }) => `${name} ${formatCount(count)}`);
  return occurred.length === 0 ? "" : `Ticks by why they ended: ${occurred.join(", ")}`;
}
