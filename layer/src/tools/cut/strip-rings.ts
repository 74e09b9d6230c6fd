import type { Corridor } from "../profile/corridor.js";

type Place = readonly [number, number];

/** Turn of a line up to which the pieces of its strip meet on the bisector, radians; sharper corners get a disc. */
const MITRED = Math.PI / 3;

/** Turn between two corners of a fan at most, radians: its edges then lie 2 % within the round. */
const STEP = Math.PI / 8;

/**
 * The outline of a strip as rings whose union it is, for clips: one for each segment, and a fan at the outer side of sharp
 * corners. On the outer side of other corners it reaches to the mitre, at most 16 % farther than the strip, which is round there.
 */
export function stripRings({ vertices, reach }: Corridor): Place[][] {
  const line = vertices.filter(
    ([x, y], index) => index === 0 || x !== vertices[index - 1][0] || y !== vertices[index - 1][1],
  );
  const segments = line.slice(1).map((end, index): Segment => {
    const [ux, uy] = [end[0] - line[index][0], end[1] - line[index][1]];
    const length = Math.hypot(ux, uy);
    return { start: line[index], end, direction: [ux / length, uy / length], length };
  });
  const rings: Place[][] = [];
  for (const [index, here] of segments.entries()) {
    const { start, end, direction } = here;
    const upright: Place = [-direction[1] * reach, direction[0] * reach];
    const mitre = (other: Segment | undefined) => other && bisector(here, other, reach);
    const [before, after] = [segments[index - 1], segments[index + 1]];
    const [a, b] = [mitre(before) ?? upright, mitre(after) ?? upright];
    rings.push([
      [start[0] + a[0], start[1] + a[1]],
      [end[0] + b[0], end[1] + b[1]],
      [end[0] - b[0], end[1] - b[1]],
      [start[0] - a[0], start[1] - a[1]],
    ]);
    if (after && !mitre(after)) rings.push(fan(here, after, reach));
  }
  return rings;
}

interface Segment {
  readonly start: Place;
  readonly end: Place;
  readonly direction: Place;
  readonly length: number;
}

/**
 * From a corner of two segments to the left end of their bisector, as far as both edges of the strip meet; undefined where the corner
 * is too sharp, or a segment too short, for pieces to meet there.
 */
function bisector(one: Segment, other: Segment, reach: number): Place | undefined {
  const [ax, ay] = one.direction;
  const [bx, by] = other.direction;
  const half = Math.abs(Math.atan2(ax * by - ay * bx, ax * bx + ay * by)) / 2;
  if (half > MITRED / 2 || reach * Math.tan(half) > Math.min(one.length, other.length) / 2) return undefined;
  const [x, y] = [-(ay + by), ax + bx];
  const size = reach / Math.cos(half) / Math.hypot(x, y);
  return [x * size, y * size];
}

/** The round outer side of a corner, from the edge of one piece to that of the next. */
function fan(
  { direction: [ax, ay], end: [x, y] }: Segment,
  { direction: [bx, by] }: Segment,
  reach: number,
): Place[] {
  const turn = Math.atan2(ax * by - ay * bx, ax * bx + ay * by);
  // The outer side lies to the right where the line turns left.
  const from = Math.atan2(ay, ax) - (Math.sign(turn) * Math.PI) / 2;
  const steps = Math.max(1, Math.ceil(Math.abs(turn) / STEP));
  const rim = Array.from({ length: steps + 1 }, (_, step): Place => {
    const angle = from + (turn * step) / steps;
    return [x + reach * Math.cos(angle), y + reach * Math.sin(angle)];
  });
  return [[x, y], ...rim];
}
