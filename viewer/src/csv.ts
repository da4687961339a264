// The plotted samples as a table that any program reads: RFC 4180, a head line with units, one row per sample.

/** One column per name; all are as long as the first. */
export function csvOf(columns: Readonly<Record<string, readonly number[]>>): string {
  const names = Object.keys(columns);
  const rows = (columns[names[0]!] ?? []).map((_, i) => names.map((name) => text(columns[name]![i]!)).join(","));
  return [names.join(","), ...rows, ""].join("\r\n");
}

/** What is not known is an empty cell. */
function text(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(9))) : "";
}
