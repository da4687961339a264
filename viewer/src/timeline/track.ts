// What was recorded over time: columns of numbers that rise with it, of bounded size. A long recording is thinned: of
// two neighbours the one with the larger first value stays, so that no peak of a force is lost.

export interface Track {
  /** Seconds, rising. */
  readonly times: Float64Array;
  /** One column for each channel. */
  readonly columns: readonly Float32Array[];
}

const kFirstRoom = 4096;

export class TrackBuilder {
  private times_ = new Float64Array(kFirstRoom);
  private columns_: Float32Array[];
  private size_ = 0;
  /** Of so many samples that come one is kept. */
  private stride_ = 1;
  private skipped_ = 0;

  constructor(channels: number, private readonly most_: number) {
    this.columns_ = Array.from({ length: channels }, () => new Float32Array(kFirstRoom));
  }

  /** Times that do not rise are left out. */
  add(time_s: number, ...values: number[]): void {
    if (this.size_ > 0 && !(time_s > this.times_[this.size_ - 1]!)) {
      return;
    }
    if (this.skipped_ > 0 && this.skipped_ < this.stride_) {
      this.skipped_ += 1;
      if (values[0]! > this.columns_[0]![this.size_ - 1]!) {
        this.set(this.size_ - 1, time_s, values);
      }
      return;
    }
    this.makeRoom();
    this.set(this.size_, time_s, values);
    this.size_ += 1;
    this.skipped_ = 1;
  }

  track(): Track {
    const columns = this.columns_.map((column) => column.slice(0, this.size_));
    return { times: this.times_.slice(0, this.size_), columns };
  }

  private set(at: number, time_s: number, values: number[]): void {
    this.times_[at] = time_s;
    this.columns_.forEach((column, i) => (column[at] = values[i]!));
  }

  private makeRoom(): void {
    if (this.size_ >= this.most_) {
      this.halve();
    }
    if (this.size_ === this.times_.length) {
      const grown = <T extends Float64Array | Float32Array>(from: T, to: T): T => (to.set(from), to);
      this.times_ = grown(this.times_, new Float64Array(2 * this.size_));
      this.columns_ = this.columns_.map((column) => grown(column, new Float32Array(2 * this.size_)));
    }
  }

  private halve(): void {
    const half = Math.floor(this.size_ / 2);
    const lead = this.columns_[0]!;
    for (let i = 0; i < half; ++i) {
      const from = lead[2 * i]! >= lead[2 * i + 1]! ? 2 * i : 2 * i + 1;
      this.times_[i] = this.times_[from]!;
      this.columns_.forEach((column) => (column[i] = column[from]!));
    }
    this.size_ = half;
    this.stride_ *= 2;
  }
}

/** Number of the last sample at or before `time_s`; 0 before the first; -1: there is none. */
export function indexAt({ times }: Track, time_s: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time_s) low = middle + 1;
    else high = middle;
  }
  return times.length === 0 ? -1 : Math.max(0, low - 1);
}

/** Two points for each of `buckets`: the smallest and the largest value, in the order in which they came. */
export function envelope({ times, columns }: Track, channel: number, buckets: number): [Float64Array, Float64Array] {
  const values = columns[channel]!;
  const count = times.length;
  if (count <= 2 * buckets) {
    return [times.slice(), Float64Array.from(values)];
  }
  const [shownTimes, shown] = [new Float64Array(2 * buckets), new Float64Array(2 * buckets)];
  for (let bucket = 0; bucket < buckets; ++bucket) {
    const begin = Math.floor((bucket * count) / buckets);
    const end = Math.floor(((bucket + 1) * count) / buckets);
    let [low, high] = [begin, begin];
    for (let i = begin + 1; i < end; ++i) {
      if (values[i]! < values[low]!) low = i;
      if (values[i]! > values[high]!) high = i;
    }
    [Math.min(low, high), Math.max(low, high)].forEach((at, k) => {
      shownTimes[2 * bucket + k] = times[at]!;
      shown[2 * bucket + k] = values[at]!;
    });
  }
  return [shownTimes, shown];
}
