// How the view is set, as text: kept in this browser, and in the fragment of a link that shows somebody else the same
// view. Neither holds anything but this: no token, no address of the server.

import { kSides, type Side } from "./section";
import { isFiniteVec, type Vec } from "./vec";

/** The check boxes of the View section, by their ids. */
export const kBoxes = ["planes", "cones", "drop", "stylus", "marks", "edges", "flat", "empty-orbit"] as const;
export type Box = (typeof kBoxes)[number];

export interface Camera {
  readonly position: Vec;
  readonly target: Vec;
}

export interface ViewSettings {
  readonly boxes: ReadonlySet<Box>;
  readonly section: Side;
  /** The share that the section takes away, 0..1. */
  readonly sectionAt: number;
}

export interface SharedView {
  readonly settings: ViewSettings;
  readonly camera: Camera | undefined;
}

const kDigits = 6;

/** A link's fragment without its "#". */
export function encodeView({ settings, camera }: SharedView): string {
  const parts = [`show=${[...settings.boxes].join(",")}`];
  if (settings.section !== "off") {
    parts.push(`section=${settings.section},${Number(settings.sectionAt.toPrecision(3))}`);
  }
  if (camera !== undefined) {
    const { position: p, target: t } = camera;
    parts.push(`camera=${[p.x, p.y, p.z, t.x, t.y, t.z].map((value) => Number(value.toPrecision(kDigits))).join(",")}`);
  }
  return parts.join("&");
}

/** Undefined when the text is of something else; what it holds that is not understood is left out. */
export function decodeView(text: string): SharedView | undefined {
  const values = new URLSearchParams(text.replace(/^#/, ""));
  const show = values.get("show");
  if (show === null) {
    return undefined;
  }
  const named = show.split(",");
  const [side, share] = (values.get("section") ?? "off").split(",");
  const sectionAt = Number(share);
  return {
    settings: {
      boxes: new Set(kBoxes.filter((box) => named.includes(box))),
      section: kSides.find((known) => known === side) ?? "off",
      sectionAt: share !== undefined && sectionAt >= 0 && sectionAt <= 1 ? sectionAt : 0.5,
    },
    camera: cameraOf(values.get("camera")),
  };
}

function cameraOf(text: string | null): Camera | undefined {
  const numbers = (text ?? "").split(",").map(Number);
  if (text === null || numbers.length !== 6) {
    return undefined;
  }
  const [px, py, pz, tx, ty, tz] = numbers as [number, number, number, number, number, number];
  const [position, target] = [{ x: px, y: py, z: pz }, { x: tx, y: ty, z: tz }];
  const apart = Math.hypot(px - tx, py - ty, pz - tz) > 0;
  return isFiniteVec(position) && isFiniteVec(target) && apart ? { position, target } : undefined;
}

/** The address of the page with this view, without the query, where a token would be. */
export function linkTo(page: { readonly origin: string; readonly pathname: string }, view: SharedView): string {
  return `${page.origin}${page.pathname}#${encodeView(view)}`;
}
