// Where an arrow stands that points to what is not in view: on the edge of the visible part, on the line from its
// middle.

/** A part of the canvas, CSS pixels. */
export interface Rect {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

export interface EdgeMark {
  readonly x: number;
  readonly y: number;
  /** Clockwise from the right. */
  readonly angle_rad: number;
}

/**
 * Undefined while the point is in view. Behind the eye a point's picture is upside down: the way to it is the other
 * way.
 */
export function edgeMark(
  point: { x: number; y: number; depth_m: number }, view: Rect, margin_px: { x: number; y: number },
): EdgeMark | undefined {
  const behind = !(point.depth_m > 0);
  const inside = point.x >= view.left && point.x <= view.right && point.y >= view.top && point.y <= view.bottom;
  if (inside && !behind) {
    return undefined;
  }
  const middle = { x: (view.left + view.right) / 2, y: (view.top + view.bottom) / 2 };
  const sign = behind ? -1 : 1;
  const away = { x: sign * (point.x - middle.x), y: sign * (point.y - middle.y) };
  const half = { x: (view.right - view.left) / 2 - margin_px.x, y: (view.bottom - view.top) / 2 - margin_px.y };
  // Straight behind there is no way that is shorter than others: down.
  const { x, y } = Math.hypot(away.x, away.y) > 0 ? away : { x: 0, y: 1 };
  const share = Math.min(half.x / Math.abs(x), half.y / Math.abs(y));
  return { x: middle.x + share * x, y: middle.y + share * y, angle_rad: Math.atan2(y, x) };
}
