// Numbers as people read them: SI prefixes, a fixed count of digits, the unit always there. A value that is not known
// is a dash, never "NaN".

const kPrefixes: readonly (readonly [factor: number, symbol: string])[] = [
  [1e9, "G"],
  [1e6, "M"],
  [1e3, "k"],
  [1, ""],
  [1e-3, "m"],
  [1e-6, "µ"],
  [1e-9, "n"],
];

export const kUnknown = "–";

const kMillion = 1_000_000n;

/** Narrow no-break space: between a number and its unit, and between groups of thousands. */
export const kThinSpace = "\u202f";

/** Between a count and what is counted. */
export const kNoBreak = "\u00a0";

/** `digits` significant digits without an exponent, for 0 <= |value| < 1000. */
function significant(value: number, digits: number): string {
  const magnitude = Math.abs(value);
  const whole = magnitude < 1 ? 1 : Math.floor(Math.log10(magnitude)) + 1;
  return value.toFixed(Math.max(0, digits - whole));
}

function prefixOf(magnitude: number): readonly [factor: number, symbol: string] {
  return kPrefixes.find(([f]) => magnitude >= f * (1 - 1e-12)) ?? kPrefixes[kPrefixes.length - 1]!;
}

/** `value` in SI base units, e.g. (0.00123, "m") -> "1.23 mm". Below a nano-unit it is shown as zero. */
export function formatSi(value: number | undefined, unit: string, digits = 3): string {
  if (value === undefined || !Number.isFinite(value)) {
    return kUnknown;
  }
  const magnitude = Math.abs(value);
  if (magnitude < 0.5e-9) {
    return `0${kThinSpace}${unit}`;
  }
  // Choose the prefix after rounding, so that 999.9996 becomes "1.00 k" and never "1000".
  const rounded = Number(magnitude.toPrecision(digits));
  const [factor, symbol] = prefixOf(rounded);
  const text = significant(Number((value / factor).toPrecision(digits)), digits);
  return `${text}${kThinSpace}${symbol}${unit}`;
}

/** The ticks of one axis, all with the prefix of the largest, so that they can be compared: "0", "0.5 N", "1 N". */
export function formatTicks(values: readonly number[], unit: string): string[] {
  const [factor, symbol] = prefixOf(Math.max(...values.map(Math.abs)));
  const text = (value: number) => String(Number((value / factor).toPrecision(6)));
  return values.map((value) => (value === 0 ? "0" : `${text(value)}${kThinSpace}${symbol}${unit}`));
}

/** `value` in the unit given, with a fixed count of decimals: readouts that must not jump between prefixes. */
export function formatFixed(value: number | undefined, unit: string, decimals: number): string {
  if (value === undefined || !Number.isFinite(value)) {
    return kUnknown;
  }
  return `${value.toFixed(decimals)}${kThinSpace}${unit}`;
}

/** A count with grouped thousands: 1234567 -> "1 234 567". */
export function formatCount(count: number | bigint | undefined): string {
  if (count === undefined || (typeof count === "number" && !Number.isFinite(count))) {
    return kUnknown;
  }
  const text = (typeof count === "number" ? Math.round(count) : count).toString();
  return text.replace(/\B(?=(\d{3})+(?!\d))/g, kThinSpace);
}

/** What is counted, in the singular or the plural. */
export function nounFor(count: number, noun: string): string {
  return count === 1 ? noun : `${noun}s`;
}

/** A count where there is little room: from a million on with three digits. */
export function formatShortCount(count: bigint | undefined): string {
  return count === undefined || count < kMillion ? formatCount(count) : formatSi(Number(count), "", 3);
}

/** How far the world moves for one millimetre of the hand. */
export function formatScale(worldPerDevice: number | undefined): string {
  if (worldPerDevice === undefined || !Number.isFinite(worldPerDevice) || worldPerDevice <= 0) {
    return kUnknown;
  }
  return `${formatSi(worldPerDevice * 1e-3, "m")} per mm`;
}

/** "3 objects, 1 200 triangles": what there is of something. */
export function countedParts(parts: readonly (readonly [count: number, noun: string])[]): string {
  const present = parts.filter(([count]) => count > 0);
  return present.map(([count, noun]) => `${formatCount(count)}${kNoBreak}${nounFor(count, noun)}`).join(", ");
}
