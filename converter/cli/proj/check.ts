import {
  compileTransformation,
  type Domain,
  PlacementError,
  type Rectangle,
  type Transformation,
} from "@groma/georef";
import { runPipeline } from "./cct.js";

import type { Proj } from "./program/find.js";
import type { StepText } from "./step-text.js";
import { holds } from "./taken-areas.js";

/** A pipeline of PROJ, and where it is taken; source units. */
export interface CheckedWay {
  readonly pipeline: readonly StepText[];
  readonly areas: readonly Rectangle[];
}

/** Points inside of the domain that are compared, besides its eight corners. */
const CHECKED_POINTS = 500;
/** Metres. */
const DIFFERENCE_MAX = 1e-4;

/** How far a transformation is from PROJ. */
export interface CheckResult {
  /** Points that have a place, all of them compared. */
  readonly checkedPoints: number;
  /** Metres. */
  readonly worstDifference: number;
}

/**
 * Compares a transformation with PROJ itself at points spread over the domain by chance (the same ones every time).
 *
 * @param ways in the order in which PROJ takes them for a point; the areas of a single one do not count
 * @param zScale what z is multiplied by before PROJ gets it
 * @throws PlacementError PLACE_CHECK when they lie further apart than a tenth of a millimetre, or one has a place where
 *   the other has none, or none has any
 */
export async function checkTransformation(
  proj: Proj,
  ways: readonly CheckedWay[],
  transformation: Transformation,
  domain: Domain,
  zScale: number,
  file: string,
  signal?: AbortSignal,
): Promise<CheckResult> {
  const points = chancePoints(domain);
  const scaled = points.map((value, i) => (i % 3 === 2 ? value * zScale : value));
  const truth = await byFirst(proj, ways, scaled, signal);
  const { evaluate } = compileTransformation(transformation, file);
  const own = new Float64Array(3);
  let checkedPoints = 0;
  let worstDifference = 0;
  for (let i = 0; i < points.length; i += 3) {
    evaluate(points[i], points[i + 1], points[i + 2], own, 0);
    const there = Number.isFinite(truth[i]);
    if (there !== Number.isFinite(own[0])) {
      const who = there ? "PROJ" : "the transformation fitted to it";
      throw refused(file, `only ${who} has a place for ${[...points.subarray(i, i + 3)].join(", ")}`);
    }
    if (!there) continue;
    checkedPoints++;
    const difference = Math.hypot(own[0] - truth[i], own[1] - truth[i + 1], own[2] - truth[i + 2]);
    worstDifference = Math.max(worstDifference, difference);
  }
  if (checkedPoints === 0) throw refused(file, "PROJ has no place for any point of the data set");
  if (!(worstDifference <= DIFFERENCE_MAX)) {
    throw refused(file, `a point lies ${worstDifference.toPrecision(3)} m from where PROJ puts it`);
  }
  return { checkedPoints, worstDifference };
}

/** Where PROJ puts each point, by the first way that is for its place and has a place for it. */
async function byFirst(
  proj: Proj,
  ways: readonly CheckedWay[],
  points: Float64Array,
  signal?: AbortSignal,
): Promise<Float64Array> {
  const [first, ...others] = ways;
  if (others.length === 0) return runPipeline(proj, first!.pipeline, points, signal);
  const found = new Float64Array(points.length).fill(Number.NaN);
  for (const { pipeline, areas } of ways) {
    const places = await runPipeline(proj, pipeline, points, signal);
    for (let i = 0; i < points.length; i += 3) {
      if (Number.isFinite(found[i]!)) continue;
      if (areas.some((area) => holds(area, points[i]!, points[i + 1]!))) {
        found.set(places.subarray(i, i + 3), i);
      }
    }
  }
  return found;
}

function chancePoints(domain: Domain): Float64Array {
  const low = [domain.minX, domain.minY, domain.minZ];
  const high = [domain.maxX, domain.maxY, domain.maxZ];
  const points = new Float64Array(3 * (CHECKED_POINTS + 8));
  const next = generator(0x9e3779b9);
  for (let i = 0; i < points.length; i++) {
    const corner = Math.floor(i / 3) - CHECKED_POINTS;
    const axis = i % 3;
    const share = corner < 0 ? next() : (corner >> axis) & 1;
    points[i] = low[axis] * (1 - share) + high[axis] * share;
  }
  return points;
}

/** Mulberry32 (Ettinger, public domain): even enough for points, the same on every machine. */
function generator(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

function refused(file: string, cause: string): PlacementError {
  return new PlacementError({
    code: "PLACE_CHECK",
    file,
    cause,
    fix: "report this with the coordinate reference system and the version of PROJ; until then convert with --engine proj4js",
  });
}
