// The surfaces of volumes in a scene: each is where the values of a volume pass one value, its iso value, which a slider
// sets.

import type { SceneLayout } from "./gen/hl_pb";
import { formatFixed } from "./units";
import { ProtocolError } from "./wire_values";

export interface Volume {
  /** What the scene calls the surface; empty: nothing. */
  readonly name: string;
  /** As the server takes it back. */
  readonly surface: bigint;
  readonly iso: number;
  /** Whether the matter is where values are below it. */
  readonly below: boolean;
  /** Range of the values. */
  readonly low: number;
  readonly high: number;
}

export interface IsoSlider {
  readonly label: string;
  /** Of the box that says on which side the matter is. */
  readonly belowLabel: string;
  readonly min: number;
  readonly max: number;
  readonly step: number;
  text(value: number): string;
}

export function checkVolumes({ volumes, placed }: SceneLayout): readonly Volume[] {
  return volumes.map(({ placed: index, surface, iso, below, low, high }) => {
    if (placed[index] === undefined || ![iso, low, high].every(Number.isFinite) || low > high) {
      throw new ProtocolError("a volume of the scene has no surface, or no range of values");
    }
    return { name: placed[index].label, surface, iso, below, low, high };
  });
}

/** Air is -1000 HU, and what is not air reaches above water, 0 HU. Other scans have no such values. */
function isHounsfield({ low, high }: Volume): boolean {
  return low <= -900 && low >= -3100 && high >= 100 && high <= 33000;
}

/** Which of several it is: its name, and its number where the name does not distinguish it. */
function wordsFor(volumes: readonly Volume[], index: number): string {
  const { name } = volumes[index]!;
  const alone = volumes.filter((other) => other.name === name).length === 1;
  return name === "" ? String(index + 1) : alone ? `of ${name}` : `${index + 1} of ${name}`;
}

/** Of one of the volumes. Values without a range have a slider of one place. */
export function isoSliderOf(volumes: readonly Volume[], index: number): IsoSlider {
  const volume = volumes[index]!;
  const { low, high } = volume;
  const which = volumes.length > 1 ? wordsFor(volumes, index) : undefined;
  const step = high > low ? 10 ** Math.floor(Math.log10((high - low) / 100)) : 1;
  const decimals = Math.max(0, Math.round(-Math.log10(step)));
  const unit = isHounsfield(volume) ? "HU" : undefined;
  return {
    label: which === undefined ? "Iso value" : `Iso value ${which}`,
    belowLabel: which === undefined ? "Matter below it" : `Matter below value ${which}`,
    min: Number((Math.floor(low / step) * step).toFixed(decimals)),
    max: Number((Math.ceil(high / step) * step).toFixed(decimals)),
    step: Number(step.toFixed(decimals)),
    text: (value) => (unit === undefined ? value.toFixed(decimals) : formatFixed(value, unit, decimals)),
  };
}
