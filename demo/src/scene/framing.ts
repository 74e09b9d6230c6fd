/** Part of a view: tangents of the angles between its edges and the axis of view; right and up are positive. */
export interface ViewWindow {
  readonly left: number;
  readonly right: number;
  readonly bottom: number;
  readonly top: number;
}

/** A rectangle of the screen, CSS pixels, y downwards. */
export interface ScreenRectangle {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** Where a camera stands, along its own axes and relative to the points' origin, metres. */
export interface Stand {
  readonly right: number;
  readonly up: number;
  /** Against the direction of view. */
  readonly back: number;
}

/** The part of a perspective view that a rectangle of its canvas shows. */
export function viewWindow(
  rectangle: ScreenRectangle,
  canvas: { readonly width: number; readonly height: number },
  verticalFieldOfView: number,
): ViewWindow {
  const top = Math.tan(verticalFieldOfView / 2);
  const right = (top * canvas.width) / canvas.height;
  const across = (x: number) => ((2 * x) / canvas.width - 1) * right;
  const along = (y: number) => (1 - (2 * y) / canvas.height) * top;
  return {
    left: across(rectangle.left),
    right: across(rectangle.right),
    bottom: along(rectangle.bottom),
    top: along(rectangle.top),
  };
}

/**
 * The nearest stand from which all points lie inside a part of the view, with as much of it left over to the left as to the right
 * of them, and above as below.
 *
 * A point (x, y, z) along (right, up, forward), seen from (a, b, −D), is inside when
 * left·(z + D) ≤ x − a ≤ right·(z + D), and the same for y and b. All points together leave a an interval whose
 * ends move with D; the least D for which neither interval is empty is the answer. Within an interval the stand is where both
 * sides of the picture have the same room: the middle of the interval is not, since what is near takes more of the picture than
 * what is far.
 *
 * @param points x, y, z per point along (right, up, forward), metres
 * @param nearest least distance between the camera's plane and any point, metres
 */
export function fitView(points: ArrayLike<number>, view: ViewWindow, nearest: number): Stand {
  const across = extremes(points, 0, view.left, view.right);
  const along = extremes(points, 1, view.bottom, view.top);
  let closest = Number.POSITIVE_INFINITY;
  for (let at = 2; at < points.length; at += 3) closest = Math.min(closest, points[at] ?? 0);
  const back = Math.max(
    (across.high - across.low) / (view.right - view.left),
    (along.high - along.low) / (view.top - view.bottom),
    nearest - closest,
  );
  return {
    right: middle(points, 0, back, { low: view.left, high: view.right, from: across }),
    up: middle(points, 1, back, { low: view.bottom, high: view.top, from: along }),
    back,
  };
}

/** Halvings of an interval of stands: to a millionth of a millionth of it. */
const HALVINGS = 40;

/** The stand along an axis from which the points leave as much room at one side of the picture as at the other. */
function middle(
  points: ArrayLike<number>,
  axis: 0 | 1,
  back: number,
  { low, high, from }: { low: number; high: number; from: { low: number; high: number } },
): number {
  let [least, most] = [from.high - high * back, from.low - low * back];
  for (let step = 0; step < HALVINGS; step++) {
    const stand = (least + most) / 2;
    const [first, last] = edges(points, axis, stand, back);
    if (high - last < first - low) least = stand;
    else most = stand;
  }
  return (least + most) / 2;
}

/** Least and greatest tangent at which points are seen from a stand. */
function edges(points: ArrayLike<number>, axis: 0 | 1, stand: number, back: number): [number, number] {
  let [least, greatest] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (let at = 0; at + 2 < points.length; at += 3) {
    const tangent = ((points[at + axis] ?? 0) - stand) / ((points[at + 2] ?? 0) + back);
    least = Math.min(least, tangent);
    greatest = Math.max(greatest, tangent);
  }
  return [least, greatest];
}

/** Least of x − least·z and greatest of x − greatest·z, x being the coordinate at `axis`. */
function extremes(
  points: ArrayLike<number>,
  axis: 0 | 1,
  least: number,
  greatest: number,
): { low: number; high: number } {
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  for (let at = 0; at + 2 < points.length; at += 3) {
    const x = points[at + axis] ?? 0;
    const z = points[at + 2] ?? 0;
    low = Math.min(low, x - least * z);
    high = Math.max(high, x - greatest * z);
  }
  return { low, high };
}
