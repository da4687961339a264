// From mouse pixels to the goal of the simulated hand. A drag moves the goal in the plane through it that is parallel
// to the screen, so the point stays under the cursor; wheel and keys move it along the line of sight.
//
//   metres per pixel = 2 depth tan(fov / 2) / height      (perspective; depth along the view direction)

import { add, dot, scale, sub, type Vec } from "./vec";

/** The camera as the mapping needs it: unit axes in the world frame, `forward` into the screen. */
export interface ViewFrame {
  readonly eye: Vec;
  readonly right: Vec;
  readonly up: Vec;
  readonly forward: Vec;
  readonly fovY_rad: number;
  readonly height_px: number;
}

/** Distance from the eye's plane to `point` along the view direction, m; negative behind the eye. */
export function depthOf(view: ViewFrame, point: Vec): number {
  return dot(sub(point, view.eye), view.forward);
}

/** World metres that one pixel spans at `depth_m`. Zero behind the eye or for an empty viewport: nothing moves. */
export function metresPerPixel(view: ViewFrame, depth_m: number): number {
  if (!(view.height_px > 0) || !(depth_m > 0)) {
    return 0;
  }
  return (2 * depth_m * Math.tan(view.fovY_rad / 2)) / view.height_px;
}

/** `goal` moved by a mouse motion of (dx, dy) pixels, y downward as the browser counts. */
export function moveInView(view: ViewFrame, goal: Vec, dx_px: number, dy_px: number): Vec {
  const size = metresPerPixel(view, depthOf(view, goal));
  return add(goal, add(scale(view.right, dx_px * size), scale(view.up, -dy_px * size)));
}

/** `goal` moved by `distance_m` away from the viewer, but never closer to the eye than `near_m`. */
export function moveInDepth(view: ViewFrame, goal: Vec, distance_m: number, near_m: number): Vec {
  const depth = depthOf(view, goal);
  const moved = Math.max(distance_m, near_m - depth);
  return add(goal, scale(view.forward, moved));
}

/** Pixels of a wheel event, whatever unit the browser reports (0 pixels, 1 lines, 2 pages). */
export function wheelPixels(delta: number, mode: number, pageHeight_px: number): number {
  const kLine_px = 16;
  return delta * (mode === 1 ? kLine_px : mode === 2 ? pageHeight_px : 1);
}
