/** The rectangle of points within half a width of a segment, its ends cut off square: a stretch of a profile, in plan. */
export interface Slab {
  /** Whether a point lies inside or on the border. */
  contains(x: number, y: number): boolean;
  /** Foot of the perpendicular on the segment's line: 0 at its start, 1 at its end. */
  along(x: number, y: number): number;
  /** Distance from the segment's line, positive to the left of its direction. */
  across(x: number, y: number): number;
}

/**
 * A slab around the segment from a to b. All is computed from differences to a, which are exact for points near it,
 * and borders are compared as squares: of random points at 5·10⁶ m none but those on the border to the last digit
 * can fall on its wrong side. A segment without length has no direction: nothing is inside, and positions are NaN.
 *
 * @param ax coordinates of one plane and unit, as the others
 * @param halfWidth zero or more, same unit
 */
export function slab(ax: number, ay: number, bx: number, by: number, halfWidth: number): Slab {
  const dx = bx - ax;
  const dy = by - ay;
  const squaredLength = dx * dx + dy * dy;
  const length = Math.hypot(dx, dy);
  const limit = halfWidth * halfWidth * squaredLength;
  const dot = (x: number, y: number) => (x - ax) * dx + (y - ay) * dy;
  const cross = (x: number, y: number) => dx * (y - ay) - dy * (x - ax);
  return {
    contains(x, y) {
      const along = dot(x, y);
      const across = cross(x, y);
      return squaredLength > 0 && along >= 0 && along <= squaredLength && across * across <= limit;
    },
    along: (x, y) => dot(x, y) / squaredLength,
    across: (x, y) => cross(x, y) / length,
  };
}
