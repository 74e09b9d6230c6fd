import { AMPLIFICATION } from "../approximation/chebyshev.js";
import type { Domain } from "../cartesian/domain.js";
import type { ExactTransform } from "../engines/exact.js";
import { choiceOf } from "../transformation/choice.js";
import { linksOf } from "../transformation/compile.js";
import type { StepwiseTruth } from "../transformation/evaluate.js";
import type { Link, PointTransform } from "../transformation/link.js";
import { holds, projectionLink } from "../transformation/projection.js";
import { patchworkOf } from "../transformation/rectangle.js";
import type { Step, Transformation } from "../transformation/step.js";
import { type Unfolded, unfoldAll } from "./creases.js";
import { boxOf } from "./expansion.js";
import { type GridRemainder, heightsOf } from "./grid-remainder.js";
import { NodeSamples } from "./node-samples.js";
import { settledWay } from "./settled-way.js";
import { type FinishedPart, type GridPart, splitGrid } from "./split-grid.js";

/** A transformation over one node: what can be fitted, what may be added per point, and what neither holds. */
export interface NodeTransform {
  /** The smooth part, linear in z. */
  readonly smooth: ExactTransform;
  /** Ways to make up for what the smooth part leaves to the grids; empty where the grids cannot be taken apart. */
  readonly corrections: readonly Correction[];
  /** The whole, point by point, and how far it can be from the projection with its grids, metres. */
  readonly truth: PointTransform;
  readonly truthBound: number;
}

/** What grids leave to be added to the smooth placement of a node. */
export interface Correction {
  /** What is added to the smooth part, in axes of ECEF, as it is looked up in cells; small ones may be left out. */
  readonly remainders: readonly GridRemainder[];
  /** The same in closed form, where few lines cross the node; what that costs is not part of `bound`. */
  readonly unfolded?: Unfolded | undefined;
  /** Metres: the greatest length of all that is added. */
  readonly reach: number;
  /** Metres: how far the sum can be from the projection with its grids, before any fit. */
  readonly bound: number;
}

/** Metres: the smallest radius of curvature that a surface of constant height has, for terms of second order. */
const RADIUS = 6.3e6;
/** √3 · 2⁻²⁴: what storing a correction as three float32 costs before the polynomials are added to it. */
export const ROUNDING = Math.sqrt(3) * 2 ** -24;
/** Between the deviations at the samples and the greatest one. */
const BETWEEN_SAMPLES = 1.25;

/**
 * Takes the grids of a transformation apart over a node: in the smooth part each is replaced by one bilinear function,
 * and the rest of it becomes a correction per point. Within one cell of all grids nothing is left.
 *
 * @param domain box of the points, source units
 */
export function nodeTransform(
  { transformation, evaluate, end, stretch = 1, own }: StepwiseTruth,
  domain: Domain,
): NodeTransform {
  const box = boxOf(domain);
  const samples = new NodeSamples(box);
  const common = { truth: evaluate, truthBound: stretch * patchworkOf(transformation).bound };
  const inPlane = (smooth: ExactTransform) => (own === undefined ? smooth : keepingPlane(smooth, own));
  const smoothOf = (links: readonly Link[]) => inPlane(linearInHeight(links, box.z, samples.halfHeight));
  const undivided = (): NodeTransform => {
    const smooth = choiceOf(transformation)
      ? inPlane(byThreeHeights(evaluate, box.z, samples.halfHeight))
      : smoothOf(linksOf(transformation, end));
    return { ...common, smooth, corrections: [] };
  };
  if (hasGrid(transformation) && isTornByCut(transformation, domain)) return undivided();
  const settled = settledWay(transformation, box);
  if (!settled) return undivided();
  const links: Link[] = [];
  const parts: GridPart[] = [];
  for (const step of settled.steps) {
    if (step.kind === "horizontalShift" || step.kind === "verticalShift") {
      const part = splitGrid(step, samples, links.length);
      if (!part) return undivided();
      parts.push(part);
      links.push(part.link);
    } else {
      links.push(...linksOf({ steps: [step] }, end));
    }
    samples.apply(links[links.length - 1]);
    if (!samples.finite()) return undivided();
  }
  const patched = stretch * patchworkBound(transformation, domain);
  const before = patched + 0.5 * samples.curvature() * BETWEEN_SAMPLES;
  const corrections = correctionsOf(parts, links, before, own === undefined ? (part) => part : heightsOf);
  return { ...common, smooth: smoothOf(links), corrections };
}

function hasGrid({ steps }: Transformation): boolean {
  const onGrid = new Set<Step["kind"]>(["horizontalShift", "verticalShift", "choice"]);
  return steps.some(({ kind }) => onGrid.has(kind));
}

/**
 * Whether longitude jumps inside of a node, which it does in a patchwork that counts from a centre of its own, at 180° and at
 * the poles: grids cannot be taken apart there.
 */
function isTornByCut(transformation: Transformation, { minX, minY, maxX, maxY }: Domain): boolean {
  const patchwork = patchworkOf(transformation);
  if (!patchwork.centre) return false;
  const link = projectionLink(patchwork);
  const state = new Float64Array(3);
  const shares = [0, 0.5, 1];
  const longitudes = shares.flatMap((u) =>
    shares.map((v) => {
      state[0] = minX * (1 - u) + maxX * u;
      state[1] = minY * (1 - v) + maxY * v;
      link.apply(state);
      return state[0];
    }),
  );
  return Math.max(...longitudes) - Math.min(...longitudes) > Math.PI / 2;
}

/** The same with x and y as they are in the source, times what a unit of the source is. */
function keepingPlane(smooth: ExactTransform, own: number): ExactTransform {
  return (x, y, out, offset) => {
    smooth(x, y, out, offset);
    out[offset] = x * own;
    out[offset + 1] = y * own;
    out[offset + 3] = 0;
    out[offset + 4] = 0;
  };
}

/**
 * All remainders, all but the smallest, and so on down to none.
 * @param keep what of a remainder is added
 */
function correctionsOf(
  parts: readonly GridPart[],
  links: readonly Link[],
  before: number,
  keep: (remainder: GridRemainder) => GridRemainder,
): Correction[] {
  let shift = 0;
  const finished: FinishedPart[] = [];
  for (const part of parts) {
    finished.push(part.finish(links, shift));
    shift += finished[finished.length - 1].length;
  }
  const secondOrder = shift ** 2 / RADIUS;
  finished.sort((a, b) => b.length - a.length);
  const sum = (of: readonly FinishedPart[], what: "length" | "error") =>
    of.reduce((total, part) => total + part[what], 0);
  return Array.from({ length: finished.length + 1 }, (_, count) => {
    const [kept, leftOut] = [finished.slice(0, count), finished.slice(count)];
    const reach = sum(kept, "length");
    const remainders = kept.map(({ remainder }) => keep(remainder));
    return {
      remainders,
      ...(count > 0 && { unfolded: unfoldAll(remainders) }),
      reach,
      bound: before + secondOrder + sum(leftOut, "length") + sum(kept, "error") + count * reach * ROUNDING,
    };
  });
}

/**
 * P and n from three heights: the chord through the outer ones, moved half way to the middle, which halves what the
 * curvature along z costs.
 */
function linearInHeight(links: readonly Link[], middle: number, half: number): ExactTransform {
  const [projection, ...others] = links;
  const [low, centre, high] = [0, 0, 0].map(() => new Float64Array(3));
  const write = chordOf(low, centre, high, middle, half);
  const place = (state: Float64Array, z: number) => {
    state[2] = z;
    for (let i = 0; i < others.length; i++) others[i].apply(state);
  };
  return (x, y, out, offset) => {
    centre[0] = x;
    centre[1] = y;
    projection.apply(centre);
    low.set(centre);
    high.set(centre);
    place(low, middle - half);
    place(centre, middle);
    place(high, middle + half);
    write(out, offset);
  };
}

/** The same from the whole, point by point. */
function byThreeHeights(evaluate: PointTransform, middle: number, half: number): ExactTransform {
  const [low, centre, high] = [0, 0, 0].map(() => new Float64Array(3));
  const write = chordOf(low, centre, high, middle, half);
  return (x, y, out, offset) => {
    evaluate(x, y, middle - half, low, 0);
    evaluate(x, y, middle, centre, 0);
    evaluate(x, y, middle + half, high, 0);
    write(out, offset);
  };
}

function chordOf(
  low: Float64Array,
  centre: Float64Array,
  high: Float64Array,
  middle: number,
  half: number,
): (out: Float64Array, offset: number) => void {
  return (out, offset) => {
    for (let axis = 0; axis < 3; axis++) {
      const slope = (high[axis] - low[axis]) / (2 * half);
      out[offset + axis + 3] = slope;
      out[offset + axis] = (centre[axis] + (low[axis] + high[axis]) / 2) / 2 - middle * slope;
    }
  };
}

/**
 * How far the patchwork may be from the projection, seen through a fit: where a node lies on several patches the fit
 * also meets the steps between them, and amplifies them.
 */
function patchworkBound(transformation: Transformation, { minX, minY, maxX, maxY }: Domain): number {
  const { patches, bound } = patchworkOf(transformation);
  const alone = patches.some((patch) => holds(patch, minX, minY) && holds(patch, maxX, maxY));
  return alone ? bound : (1 + AMPLIFICATION) * bound;
}
