// The last seconds of measured values for the plots: a ring of fixed capacity, and its reduction to what a plot of a
// few hundred pixels can show. Minimum and maximum of each bucket survive, so a single tick's spike is never lost.

/** Columns for uPlot: times first, then one column per channel. */
export type Columns = [Float64Array, ...Float64Array[]];

export class SampleRing {
  readonly capacity: number;
  readonly channels: number;
  private readonly times_: Float64Array;
  private readonly values_: Float64Array[];
  private start_ = 0;
  private size_ = 0;

  constructor(capacity: number, channels: number) {
    this.capacity = capacity;
    this.channels = channels;
    this.times_ = new Float64Array(capacity);
    this.values_ = Array.from({ length: channels }, () => new Float64Array(capacity));
  }

  get size(): number {
    return this.size_;
  }

  /** Time of the newest sample, or undefined when there is none. */
  get latestTime(): number | undefined {
    return this.size_ === 0 ? undefined : this.times_[this.slot(this.size_ - 1)];
  }

  /**
   * Appends one sample; the oldest goes when the ring is full. A time before the newest one means that the server
   * started anew: the old samples go. Returns false, and keeps nothing, when the time is not finite or not newer.
   */
  push(time_s: number, ...values: number[]): boolean {
    const latest = this.latestTime;
    if (!Number.isFinite(time_s) || time_s === latest) {
      return false;
    }
    if (latest !== undefined && time_s < latest) {
      this.clear();
    }
    if (this.size_ === this.capacity) {
      this.start_ = (this.start_ + 1) % this.capacity;
      this.size_ -= 1;
    }
    const slot = this.slot(this.size_);
    this.times_[slot] = time_s;
    for (let channel = 0; channel < this.channels; ++channel) {
      this.values_[channel]![slot] = values[channel] ?? Number.NaN;
    }
    this.size_ += 1;
    return true;
  }

  clear(): void {
    this.start_ = 0;
    this.size_ = 0;
  }

  /** Times and values of `channel` in the last `window_s` seconds. */
  last(channel: number, window_s: number): { times: number[]; values: number[] } {
    const first = this.lowerBound((this.latestTime ?? 0) - window_s);
    const slots = Array.from({ length: this.size_ - first }, (_, i) => this.slot(first + i));
    const values = this.values_[channel]!;
    return { times: slots.map((slot) => this.times_[slot]!), values: slots.map((slot) => values[slot]!) };
  }

  /** Largest value of `channel` since `from_s`; 0 when there is none. */
  maximum(channel: number, from_s: number): number {
    let largest = 0;
    for (let i = this.lowerBound(from_s); i < this.size_; ++i) {
      largest = Math.max(largest, this.values_[channel]![this.slot(i)]! || 0);
    }
    return largest;
  }

  /**
   * The samples of the last `window_s` seconds, times relative to the newest one (so they end at 0), reduced to two
   * points per bucket. Buckets stand at multiples of their width in absolute time: a scrolling plot does not shimmer.
   */
  window(window_s: number, buckets: number): Columns {
    const latest = this.latestTime ?? 0;
    const first = this.lowerBound(latest - window_s);
    return this.size_ - first <= 2 * buckets
      ? this.copyFrom(first, latest)
      : this.reduceFrom(first, latest, window_s / buckets);
  }

  private copyFrom(first: number, latest: number): Columns {
    const count = this.size_ - first;
    const columns = this.makeColumns(count);
    for (let i = 0; i < count; ++i) {
      const slot = this.slot(first + i);
      columns[0][i] = this.times_[slot]! - latest;
      for (let channel = 0; channel < this.channels; ++channel) {
        columns[channel + 1]![i] = this.values_[channel]![slot]!;
      }
    }
    return columns;
  }

  private reduceFrom(first: number, latest: number, width_s: number): Columns {
    const rows: number[][] = Array.from({ length: this.channels + 1 }, () => []);
    let begin = first;
    while (begin < this.size_) {
      const bucket = Math.floor(this.times_[this.slot(begin)]! / width_s);
      let end = begin + 1;
      while (end < this.size_ && Math.floor(this.times_[this.slot(end)]! / width_s) === bucket) {
        ++end;
      }
      rows[0]!.push(this.times_[this.slot(begin)]! - latest, this.times_[this.slot(end - 1)]! - latest);
      for (let channel = 0; channel < this.channels; ++channel) {
        rows[channel + 1]!.push(...this.extremes(channel, begin, end));
      }
      begin = end;
    }
    return rows.map((row) => Float64Array.from(row)) as Columns;
  }

  /** Minimum and maximum of a bucket in the order in which they came. */
  private extremes(channel: number, begin: number, end: number): [number, number] {
    const values = this.values_[channel]!;
    let low = begin;
    let high = begin;
    for (let i = begin + 1; i < end; ++i) {
      const value = values[this.slot(i)]!;
      if (value < values[this.slot(low)]!) low = i;
      if (value > values[this.slot(high)]!) high = i;
    }
    return [values[this.slot(Math.min(low, high))]!, values[this.slot(Math.max(low, high))]!];
  }

  private makeColumns(count: number): Columns {
    return Array.from({ length: this.channels + 1 }, () => new Float64Array(count)) as unknown as Columns;
  }

  /** Index of the first sample at or after `time_s`. */
  private lowerBound(time_s: number): number {
    let low = 0;
    let high = this.size_;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times_[this.slot(middle)]! < time_s) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  private slot(index: number): number {
    return (this.start_ + index) % this.capacity;
  }
}
