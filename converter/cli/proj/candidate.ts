import { basename } from "node:path";
import {
  type Bounds,
  boundsOfPlaces,
  type Domain,
  type GridWindow,
  GromaError,
  PlacementError,
  spread,
} from "@groma/georef";
import { runPipeline, runToRadians } from "./cct.js";
import { constantWindow } from "./constant-window.js";
import { faultOf } from "./faulty.js";
import { cutFrom } from "./grids/cut.js";
import { type GridImage, type GridKind, unreadable } from "./grids/grid-image.js";
import { locateGrid } from "./grids/locate.js";
import { openGrid } from "./grids/open.js";
import type { Operation } from "./operation.js";
import { parsePipeline } from "./pipeline.js";
import type { GridName, Plan } from "./plan.js";
import type { Proj } from "./program/find.js";
import { type Sampled, sampleSteps } from "./sample.js";

/** An operation that can be followed for a domain. */
export interface Candidate {
  readonly operation: Operation;
  readonly plan: Plan;
  /** What z is multiplied by before PROJ gets it: the CRS's vertical unit is not always the pipeline's. */
  readonly zScale: number;
  /** ECEF of points spread over the domain, NaN where PROJ has no place for them. */
  readonly places: Float64Array;
  /** Whether all of them have a place. */
  readonly covers: boolean;
}

/** Relative; what PROJ and the CRS write with fewer digits than they mean. */
const SAME_UNIT = 1e-9;

/**
 * Reads an operation and tries it on points spread over the domain.
 *
 * @param metresPerUnit of the source's z
 * @throws CrsError CRS_OPERATION_UNSUPPORTED
 * @throws ProjError PROJ_FAILED when PROJ does not take it
 * @throws PlacementError PLACE_DOMAIN when it has no place for any point
 */
export async function tryOperation(
  proj: Proj,
  operation: Operation,
  domain: Domain,
  metresPerUnit: number,
  signal?: AbortSignal,
): Promise<Candidate> {
  const plan = parsePipeline(operation.pipeline ?? "");
  const ratio = metresPerUnit / plan.metresPerUnit;
  const zScale = Math.abs(ratio - 1) < SAME_UNIT ? 1 : ratio;
  const points = spread(domain);
  for (let i = 2; i < points.length; i += 3) points[i] *= zScale;
  const places = await runPipeline(proj, plan.pipeline, points, signal);
  if (!places.some(Number.isFinite)) {
    throw new PlacementError({
      code: "PLACE_DOMAIN",
      file: operation.name,
      cause: "it has no place for any point of the data set",
      fix: "check that the coordinate reference system is the one the scan was made in",
    });
  }
  return { operation, plan, zScale, places, covers: places.every(Number.isFinite) };
}

function gridSteps(plan: Plan) {
  return plan.steps.filter((step) => step.kind === "horizontalShift" || step.kind === "verticalShift");
}

/**
 * Cuts the windows of a candidate's grids, in the order of its steps.
 *
 * @throws ProjError PROJ_GRID when a grid is missing, cannot be read, or does not reach the data
 */
async function cutWindows(
  proj: Proj,
  { plan, zScale }: Candidate,
  domain: Domain,
  signal?: AbortSignal,
): Promise<Pick<Choice, "windows" | "leftOut">> {
  const points = spread(domain);
  for (let i = 2; i < points.length; i += 3) points[i] *= zScale;
  const windows: GridWindow[] = [];
  const leftOut: LeftOut[] = [];
  for (const step of gridSteps(plan)) {
    const places = await runToRadians(proj, plan.pipeline.slice(0, step.before), points, signal);
    const bounds = boundsOfPlaces(places);
    const kind = step.kind === "verticalShift" ? "vertical" : "horizontal";
    const window = await windowOf(proj, step.grids, kind, bounds);
    if (!window && !step.grids.some(isNull))
      leftOut.push({ kind, grids: step.grids.map(({ name }) => name) });
    windows.push(window ?? constantWindow(kind === "vertical" ? [0] : [0, 0]));
  }
  return { windows, leftOut };
}

/** A shift that PROJ does without, since all of its grids are optional and none is there. */
export interface LeftOut {
  readonly kind: GridKind;
  readonly grids: readonly string[];
}

/** PROJ's grid that covers the earth and shifts nothing. */
function isNull({ name }: GridName): boolean {
  return name === "null";
}

/** The part of a step's grids that the bounds need; nothing where nothing is shifted. */
async function windowOf(
  proj: Proj,
  names: readonly GridName[],
  kind: GridKind,
  bounds: Bounds | undefined,
): Promise<GridWindow | undefined> {
  const roots: GridImage[] = [];
  const named = names.findIndex(isNull);
  for (const { name, optional } of named < 0 ? names : names.slice(0, named)) {
    const path = await locateGrid(proj, name);
    if (path) roots.push(...(await openGrid(path, basename(path), kind)));
    else if (!optional) throw unreadable(name, "it is in none of PROJ's data folders");
  }
  if (roots.length === 0) return undefined;
  const window = bounds && (await cutFrom(roots, bounds));
  if (!window && named >= 0) return undefined;
  if (!window) throw unreadable(names.map(({ name }) => name).join(", "), "it does not reach the data set");
  return window;
}

/** An operation that was left out, and why. */
export interface PassedOver {
  readonly operation: string;
  readonly accuracy: number | null;
  readonly why: string;
}

/** The operation that is taken, with what of its grids the data set needs. */
export interface Choice {
  readonly candidate: Candidate;
  readonly windows: readonly GridWindow[];
  readonly leftOut: readonly LeftOut[];
  /** Of the steps that are taken as PROJ gives them, in their order. */
  readonly sampled: readonly Sampled[];
}

/** What became of a list of operations. */
export interface Selection {
  /** Absent when none of them can be used. */
  readonly choice?: Choice;
  readonly passedOver: readonly PassedOver[];
  /** Why the best one that PROJ would have used could not be; only ballparks are left, and none was taken for it. */
  readonly blocked?: GromaError;
}

/**
 * An operation with all that its steps need of grids over the domain.
 *
 * @throws ProjError PROJ_GRID when a grid is missing, cannot be read, or does not reach the data
 * @throws CrsError CRS_OPERATION_UNSUPPORTED when steps cannot be followed closely enough
 */
export async function prepared(
  proj: Proj,
  candidate: Candidate,
  domain: Domain,
  signal?: AbortSignal,
): Promise<Choice> {
  const { windows, leftOut } = await cutWindows(proj, candidate, domain, signal);
  const sampled: Sampled[] = [];
  for (const step of candidate.plan.steps) {
    if (step.kind === "sampled") sampled.push(await sampleSteps(proj, candidate, step, domain, signal));
  }
  return { candidate, windows, leftOut, sampled };
}

/** Faults of one operation that leave the others as they are; the last means that it is not for this place. */
const GIVES_WAY = new Set(["CRS_OPERATION_UNSUPPORTED", "PROJ_GRID", "PROJ_FAILED", "PLACE_DOMAIN"]);

/**
 * Takes the first operation that PROJ would use, can be followed and has a place for all points of the domain;
 * failing that the first with a place for some, and only then one that passes over a difference of datums. One whose
 * steps are not supported, or whose grid cannot be read, gives way to the next, which is reported; but never to a
 * ballpark.
 */
export async function choose(
  proj: Proj,
  operations: readonly Operation[],
  domain: Domain,
  metresPerUnit: number,
  signal?: AbortSignal,
): Promise<Selection> {
  const passedOver: PassedOver[] = [];
  const withoutShift = new Set(operations.filter((operation) => operation.ballpark));
  for (const ballpark of [false, true]) {
    let partial: Choice | undefined;
    let blocked: GromaError | undefined;
    for (const operation of operations) {
      if (withoutShift.has(operation) !== ballpark || operation.missingGrids.length > 0) continue;
      const { name, accuracy } = operation;
      const fault = faultOf(name);
      if (fault !== undefined) {
        passedOver.push({ operation: name, accuracy, why: fault });
        continue;
      }
      if (operation.pipeline === undefined) {
        passedOver.push({ operation: name, accuracy, why: "PROJ cannot write it as a pipeline" });
        continue;
      }
      try {
        const candidate = await tryOperation(proj, operation, domain, metresPerUnit, signal);
        if (!candidate.covers && partial) continue;
        const choice = await prepared(proj, candidate, domain, signal);
        if (choice.leftOut.length > 0 && !ballpark) {
          withoutShift.add(operation);
          continue;
        }
        if (candidate.covers) return { choice, passedOver };
        partial = choice;
      } catch (error) {
        if (!(error instanceof GromaError) || !GIVES_WAY.has(error.code)) throw error;
        passedOver.push({ operation: name, accuracy, why: `${error.file}: ${error.cause}` });
        if (error.code !== "PLACE_DOMAIN") blocked ??= error;
      }
    }
    if (partial) return { choice: partial, passedOver };
    if (blocked) return { passedOver, blocked };
  }
  return { passedOver };
}
