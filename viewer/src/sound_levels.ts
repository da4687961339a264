// What the force sounds like, for those without a device: a tone that grows and rises with the force, and noise that
// grows with how fast the force ripples and the proxy slides.

export interface Felt {
  readonly force_N: number;
  /** The most that the device can do. */
  readonly limit_N: number;
  /** Standard deviation of the force over some hundredths of a second. */
  readonly ripple_N: number;
  /** Of the proxy, at the hand. */
  readonly speed_m_s: number;
  readonly slipping: boolean;
}

export interface Levels {
  /** Gains 0..1 of the tone and of the noise. */
  readonly tone: number;
  readonly noise: number;
  readonly pitch_Hz: number;
  /** Middle of the noise's band. */
  readonly band_Hz: number;
}

const kToneMost = 0.18;
const kNoiseMost = 0.22;
const kLowest_Hz = 110;
/** Two octaves from no force to the device's limit. */
const kOctaves = 2;
/** A hand that strokes fast. */
const kFast_m_s = 0.2;
/** This ripple is as loud as can be. */
const kRough_N = 0.5;
/** A slip without ripple is heard as this part of the roughest texture. */
const kSlip = 0.35;

export function levelsOf({ force_N, limit_N, ripple_N, speed_m_s, slipping }: Felt): Levels {
  const force = part(force_N / limit_N);
  const speed = part(speed_m_s / kFast_m_s);
  const rough = Math.max(part(ripple_N / kRough_N), slipping ? kSlip : 0);
  return {
    tone: force > 0 ? kToneMost * Math.sqrt(force) : 0,
    noise: kNoiseMost * rough * Math.sqrt(speed),
    pitch_Hz: kLowest_Hz * 2 ** (kOctaves * force),
    band_Hz: 300 + 2700 * speed,
  };
}

function part(value: number): number {
  return Number.isFinite(value) ? Math.min(1, Math.max(0, value)) : 0;
}

export function deviation(values: readonly number[]): number {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const squares = values.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  return values.length === 0 ? 0 : Math.sqrt(squares / values.length);
}
