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
  /** Pixels; a wide line shows beneath a narrow one of the same values. */
  readonly width?: number;
}

export interface PlotOptions {
  readonly unit: string;
  readonly series: readonly PlotSeries[];
  /** The scale never shows less than this, in the unit: a resting hand must not look like an earthquake. */
  readonly smallestTop: number;
  /** What it shows in the place of the last seconds. */
  readonly whole?: { readonly begin_s: () => number; readonly end_s: () => number; readonly now_s: () => number };
}

const kFont = "11px system-ui, sans-serif";
const kAxisWidth_px = 52;
const kLine_px = 1.5;
/** From this part of the limit on, the plot shows the limit. */
const kNearLimit = 0.5;
const kXAxisHeight_px = 22;
const kXTicks_s = [-kWindow_s, -kWindow_s / 2, 0];

export class LivePlot {
  private readonly plot_: uPlot;
  private readonly host_: HTMLElement;
  private limit_ = 0;

  constructor(host: HTMLElement, options: PlotOptions) {
    this.host_ = host;
    const empty: Columns = [new Float64Array(), ...options.series.map(() => new Float64Array())];
    this.plot_ = new uPlot(plotOptions(options, host, () => this.limit_), empty, host);
    new ResizeObserver(() => this.fit()).observe(host);
  }

  /** Points that two per pixel column can show. */
  get buckets(): number {
    return Math.max(50, this.host_.clientWidth - kAxisWidth_px);
  }

  show(columns: Columns): void {
    this.plot_.setData(columns);
  }

  /** Values never go above this; 0: no limit is known. */
  setLimit(limit: number): void {
    this.limit_ = limit;
  }

  /** Draws the mark of the time anew. */
  redraw(): void {
    this.plot_.redraw(false, false);
  }

  /** The share 0..1 of its width that is at `x_px` of the host. */
  shareAt(x_px: number): number {
    const { left, width } = this.plot_.bbox;
    return Math.min(1, Math.max(0, (x_px * window.devicePixelRatio - left) / Math.max(1, width)));
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

function plotOptions(options: PlotOptions, host: HTMLElement, limit: () => number): uPlot.Options {
  const { whole } = options;
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
      x: { time: false, range: () => (whole === undefined ? [-kWindow_s, 0] : rangeOf(whole)) },
      y: { range: (_plot, _low, high) => [0, topOf(options.smallestTop, high || 0, limit())] },
    },
    hooks: {
      draw: [(plot) => drawLimit(plot, limit()), (plot) => whole !== undefined && drawNow(plot, whole.now_s())],
    },
    series: [
      {},
      ...options.series.map((series): uPlot.Series => ({
        stroke: () => themeColour(series.colour),
        ...(series.fill === true ? { fill: () => `${themeColour(series.colour)}24` } : {}),
        width: series.width ?? kLine_px,
        points: { show: false },
      })),
    ],
    axes: [
      {
        ...axis,
        size: kXAxisHeight_px,
        gap: 6,
        ...(whole === undefined ? { splits: () => kXTicks_s } : { space: 60 }),
        values: (_plot, ticks) => ticks.map(whole === undefined ? timeLabel : (tick) => `${tick}\u202fs`),
      },
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

function rangeOf({ begin_s, end_s }: NonNullable<PlotOptions["whole"]>): [number, number] {
  return [begin_s(), Math.max(end_s(), begin_s() + 1e-3)];
}

/** Where the scale ends: with the limit in view when the values come near it. */
function topOf(smallest: number, high: number, limit: number): number {
  return 1.08 * Math.max(smallest / 1.08, high, high > kNearLimit * limit ? limit : 0);
}

/** A dashed line, when it is in view. */
function drawLimit(plot: uPlot, limit: number): void {
  const top = plot.scales.y?.max ?? 0;
  if (!(limit > 0) || limit > top) {
    return;
  }
  const { ctx: context, bbox } = plot;
  const y = plot.valToPos(limit, "y", true);
  context.save();
  context.strokeStyle = themeColour("bad");
  context.setLineDash([6, 4]);
  context.lineWidth = window.devicePixelRatio;
  context.beginPath();
  context.moveTo(bbox.left, y);
  context.lineTo(bbox.left + bbox.width, y);
  context.stroke();
  context.restore();
}

/** An upright line at the time that is shown. */
function drawNow(plot: uPlot, now_s: number): void {
  const { ctx: context, bbox } = plot;
  const x = plot.valToPos(now_s, "x", true);
  context.save();
  context.strokeStyle = themeColour("text");
  context.lineWidth = window.devicePixelRatio;
  context.beginPath();
  context.moveTo(x, bbox.top);
  context.lineTo(x, bbox.top + bbox.height);
  context.stroke();
  context.restore();
}

function timeLabel(time_s: number): string {
  return time_s === 0 ? "now" : `${time_s}\u202fs`.replace("-", "\u2212");
}
