import {
  CHEBYSHEV_NODES,
  chebyshevCoefficients,
  discardedBeyond,
  geometricTail,
  NODES,
} from "../approximation/chebyshev.js";
import { projectionLink } from "./projection.js";
import type { Rectangle } from "./rectangle.js";
import type { Patch } from "./step.js";

/** Metres, added to every bound: below it coefficients are rounding noise of the projection. */
const FLOOR = 5e-6;
/** Metres: degrees that contribute less are left out of the record. */
const NEGLIGIBLE = 1e-6;
/** A direction whose highest degree is this much smaller than the other's needs no cut. */
const SMOOTHER = 1 / 8;

/** Where a rectangle is sampled in one direction: the edges, and between them the Chebyshev nodes, rising. */
const LINE: readonly number[] = [-1, ...Array.from(CHEBYSHEV_NODES).reverse(), 1];
/** Check points inside, beside the edges: none of them on a line of nodes. */
const CHECKS: ReadonlyArray<readonly [number, number]> = Array.from({ length: 24 }, (_, i) => [
  fraction(0.5 + i * 0.7548776662466927),
  fraction(0.5 + i * 0.5698402909980532),
]);

/** The additive recurrence of the plastic number spreads points evenly over the square; scaled to (−1, 1). */
function fraction(t: number): number {
  return 2 * (t - Math.floor(t)) - 1;
}

/** Places that a fit asks for in each rectangle: those it goes through, and those that check it. */
export const SAMPLES_PER_PATCH = LINE.length ** 2 + CHECKS.length;

/** x, y of the samples of all rectangles, in the order that {@link fitPatch} takes their places. */
export function samplePlaces(rectangles: readonly Rectangle[]): Float64Array {
  const out = new Float64Array(2 * SAMPLES_PER_PATCH * rectangles.length);
  let at = 0;
  for (const rectangle of rectangles) {
    const put = (u: number, v: number) => {
      [out[at], out[at + 1]] = placeOf(rectangle, u, v);
      at += 2;
    };
    for (const u of LINE) for (const v of LINE) put(u, v);
    for (const [u, v] of CHECKS) put(u, v);
  }
  return out;
}

function placeOf({ minX, minY, maxX, maxY }: Rectangle, u: number, v: number): [number, number] {
  // Weights instead of centre and half extent: the edges are met exactly.
  return [(minX * (1 - u) + maxX * (1 + u)) / 2, (minY * (1 - v) + maxY * (1 + v)) / 2];
}

/** Why a rectangle has no patch: its projection is not defined on it, turns round a pole, jumps, or is not smooth. */
export type Refusal = "nowhere" | "pole" | "jump" | "rough";

interface PatchFit {
  readonly patch?: Patch;
  /** Certified error on the ground, metres; infinite where there is no patch. */
  readonly bound: number;
  /** Which way to cut, if the bound is too large. */
  readonly split: "x" | "y" | "both";
  /** Why the rectangle is refused, if it cannot be cut any further. */
  readonly refusal: Refusal;
  /** Cutting would not help. */
  readonly final: boolean;
}

/**
 * Fits one rectangle: 9 × 9 Chebyshev nodes, certificate as for nodes of points (discarded norms, tail, floor), with
 * longitude counted by the cosine of the lowest latitude. The edges and the check points have to agree with it.
 *
 * @param places longitude, latitude of {@link samplePlaces}; longitudes are unwrapped in place
 */
export function fitPatch(rectangle: Rectangle, places: Float64Array, metresPerRadian: number): PatchFit {
  const failed = { bound: Number.POSITIVE_INFINITY, split: "both" } as const;
  if (places.length !== 2 * SAMPLES_PER_PATCH || !places.every(Number.isFinite)) {
    return { ...failed, refusal: "nowhere", final: true };
  }
  if (turnsOfEdge(places) !== 0) return { ...failed, refusal: "pole", final: true };
  const refusal = touchesPole(places) ? "pole" : "rough";
  if (!unwrap(places)) return { ...failed, refusal: refusal === "pole" ? "pole" : "jump", final: false };

  const values = new Float64Array(2 * NODES * NODES);
  for (let i = 0; i < NODES; i++) {
    for (let j = 0; j < NODES; j++) {
      // Nodes fall, samples rise, and the first of these is the edge.
      const from = 2 * (LINE.length * (NODES - i) + NODES - j);
      values.set(places.subarray(from, from + 2), 2 * (NODES * i + j));
    }
  }
  const coefficients = chebyshevCoefficients(values, 2);
  const cosLatitude = greatestCosine(places);
  const norm = (k: number, l: number) => {
    const at = 2 * (NODES * k + l);
    return metresPerRadian * Math.hypot(coefficients[at] * cosLatitude, coefficients[at + 1]);
  };
  let degree = 1;
  while (degree < NODES - 1 && discardedBeyond(degree, norm) > NEGLIGIBLE) degree++;
  const bound = discardedBeyond(degree, norm) + geometricTail(norm) + FLOOR;
  const patch = { ...rectangle, degree, coefficients: truncated(coefficients, degree) };
  const agrees = deviation(patch, places, cosLatitude) * metresPerRadian <= bound;
  return {
    patch,
    bound: agrees ? bound : Number.POSITIVE_INFINITY,
    split: rougherDirection(norm),
    refusal,
    final: false,
  };
}

/** A difference of longitudes on the turn nearest to zero. */
function nearestTurn(difference: number): number {
  return difference - 2 * Math.PI * Math.round(difference / (2 * Math.PI));
}

/** Index in the places of the longitude at a crossing of the sample lines. */
function crossing(i: number, j: number): number {
  return 2 * (LINE.length * i + j);
}

/** How many times longitude goes round along the edge of the rectangle: not at all, unless a pole lies inside. */
function turnsOfEdge(places: Float64Array): number {
  const last = LINE.length - 1;
  const ring: number[] = [];
  for (let t = 0; t < last; t++) ring.push(crossing(t, 0));
  for (let t = 0; t < last; t++) ring.push(crossing(last, t));
  for (let t = last; t > 0; t--) ring.push(crossing(t, last));
  for (let t = last; t > 0; t--) ring.push(crossing(0, t));
  let sum = 0;
  for (const [i, at] of ring.entries()) sum += nearestTurn(places[ring[(i + 1) % ring.length]] - places[at]);
  return Math.round(sum / (2 * Math.PI));
}

/**
 * Makes longitude continuous over the crossings, the middle one between −π and π.
 * @returns whether neighbours then lie less than 2 radians apart, so that nothing was guessed
 */
function unwrap(places: Float64Array): boolean {
  const lines = LINE.length;
  const middle = crossing((lines - 1) / 2, (lines - 1) / 2);
  const follow = (at: number, previous: number) => {
    places[at] = places[previous] + nearestTurn(places[at] - places[previous]);
  };
  for (let i = 1; i < lines; i++) follow(crossing(i, 0), crossing(i - 1, 0));
  for (let i = 0; i < lines; i++) for (let j = 1; j < lines; j++) follow(crossing(i, j), crossing(i, j - 1));
  const shift = nearestTurn(places[middle]) - places[middle];
  for (let i = 0; i < 2 * lines * lines; i += 2) places[i] += shift;

  const apart = (a: number, b: number) => !(Math.abs(places[a] - places[b]) < 2);
  for (let i = 0; i < lines; i++) {
    for (let j = 0; j < lines; j++) {
      if (i > 0 && apart(crossing(i, j), crossing(i - 1, j))) return false;
      if (j > 0 && apart(crossing(i, j), crossing(i, j - 1))) return false;
    }
  }
  return true;
}

/** Whether a pole could lie as near to the samples as they do to each other. */
function touchesPole(places: Float64Array): boolean {
  let south = Number.POSITIVE_INFINITY;
  let north = Number.NEGATIVE_INFINITY;
  for (let i = 1; i < places.length; i += 2) {
    south = Math.min(south, places[i]);
    north = Math.max(north, places[i]);
  }
  return Math.PI / 2 - Math.max(north, -south) <= north - south;
}

function greatestCosine(places: Float64Array): number {
  let greatest = 0;
  for (let i = 1; i < places.length; i += 2) greatest = Math.max(greatest, Math.cos(places[i]));
  return greatest;
}

/** From 9 × 9 with both functions side by side to the layout of {@link Patch.coefficients}. */
function truncated(coefficients: Float64Array, degree: number): Float64Array {
  const side = degree + 1;
  const out = new Float64Array(2 * side * side);
  for (let k = 0; k < side; k++) {
    for (let l = 0; l < side; l++) {
      for (let c = 0; c < 2; c++) out[(c * side + k) * side + l] = coefficients[2 * (NODES * k + l) + c];
    }
  }
  return out;
}

/** Greatest deviation of a patch from all of its samples, radians. */
function deviation(patch: Patch, places: Float64Array, cosLatitude: number): number {
  const link = projectionLink({ patches: [patch] });
  const points = samplePlaces([patch]);
  const state = new Float64Array(3);
  let greatest = 0;
  for (let i = 0; i < points.length; i += 2) {
    state[0] = points[i];
    state[1] = points[i + 1];
    link.apply(state);
    const east = nearestTurn(state[0] - places[i]) * cosLatitude;
    greatest = Math.max(greatest, Math.hypot(east, state[1] - places[i + 1]));
  }
  return greatest;
}

function rougherDirection(norm: (k: number, l: number) => number): "x" | "y" | "both" {
  let x = 0;
  let y = 0;
  for (let i = 0; i < NODES; i++) {
    for (let degree = NODES - 2; degree < NODES; degree++) {
      x += norm(degree, i);
      y += norm(i, degree);
    }
  }
  if (y < SMOOTHER * x) return "x";
  return x < SMOOTHER * y ? "y" : "both";
}
