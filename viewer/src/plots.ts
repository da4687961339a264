// The live plots, in uPlot: the last seconds up to now, colours from the style sheet, scales that start at zero.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Columns } from "./samples";
import { themeColour } from "./theme";
import { formatTicks } from "./units";

export const kWindow_s = 10;

export interface PlotSeries {
  /** Name of the colour variable in the style sheet. */
  readonly colour: string;
  readonly fill?: boolean;
}

export interface PlotOptions {
  readonly unit: string;
  readonly series: readonly PlotSeries[];
  /** The scale never shows less than this, in the unit: a resting hand must not look like an earthquake. */
  readonly smallestTop: number;
}

const kFont = "11px system-ui, sans-serif";
const kAxisWidth_px = 52;
const kXAxisHeight_px = 22;
const kXTicks_s = [-kWindow_s, -kWindow_s / 2, 0];

export class LivePlot {
  private readonly plot_: uPlot;
  private readonly host_: HTMLElement;

  constructor(host: HTMLElement, options: PlotOptions) {
    this.host_ = host;
    const empty: Columns = [new Float64Array(), ...options.series.map(() => new Float64Array())];
    this.plot_ = new uPlot(plotOptions(options, host), empty, host);
    new ResizeObserver(() => this.fit()).observe(host);
  }

  /** Points that two per pixel column can show. */
  get buckets(): number {
    return Math.max(50, this.host_.clientWidth - kAxisWidth_px);
  }

  show(columns: Columns): void {
    this.plot_.setData(columns);
  }

  applyTheme(): void {
    this.plot_.redraw(true, true);
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.host_;
    if (width > 0 && height > 0 && (width !== this.plot_.width || height !== this.plot_.height)) {
      this.plot_.setSize({ width, height });
    }
  }
}

function plotOptions(options: PlotOptions, host: HTMLElement): uPlot.Options {
  const axis: Partial<uPlot.Axis> = {
    stroke: () => themeColour("muted"),
    font: kFont,
    grid: { stroke: () => themeColour("plot-grid"), width: 1 },
    ticks: { show: false },
  };
  return {
    width: Math.max(50, host.clientWidth),
    height: Math.max(50, host.clientHeight),
    cursor: { show: false },
    legend: { show: false },
    padding: [6, 16, 0, 0],
    scales: {
      x: { time: false, range: () => [-kWindow_s, 0] },
      y: { range: (_plot, _low, high) => [0, Math.max(options.smallestTop, (high || 0) * 1.08)] },
    },
    series: [
      {},
      ...options.series.map((series): uPlot.Series => ({
        stroke: () => themeColour(series.colour),
        ...(series.fill === true ? { fill: () => `${themeColour(series.colour)}24` } : {}),
        width: 1.5,
        points: { show: false },
      })),
    ],
    axes: [
      { ...axis, size: kXAxisHeight_px, gap: 6, splits: () => kXTicks_s, values: (_plot, ticks) => ticks.map(timeLabel) },
      {
        ...axis,
        size: kAxisWidth_px,
        gap: 4,
        space: 20,
        values: (_plot, ticks) => formatTicks(ticks, options.unit),
      },
    ],
  };
}

function timeLabel(time_s: number): string {
  return time_s === 0 ? "now" : `${time_s}\u202fs`.replace("-", "\u2212");
}
