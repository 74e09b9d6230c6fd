import {
  type Bounds,
  boundsInWords,
  boundsOfPlaces,
  type Crs,
  type Domain,
  EGM96,
  EGM96_NOTE,
  ecefToGeodetic,
  egm96Step,
  everyStep,
  GromaError,
  isAboveGeoid,
  PATCHWORK_TOLERANCE,
  PlacementError,
  type Rectangle,
  spread,
  type Transformation,
} from "@groma/georef";
import { degreeBox } from "./area.js";
import { type AssembledWay, assemble, isSameGround } from "./assemble.js";
import { type Beyond, beyondNote, goingOn } from "./beyond.js";
import { type Candidate, type Choice, choose, prepared } from "./candidate.js";
import { runToRadians } from "./cct.js";
import { checkTransformation } from "./check.js";
import { type Chosen, chooseFor } from "./chosen.js";
import { CONSTANT } from "./constant-window.js";
import { egm96 } from "./egm96.js";
import {
  around,
  elsewhereNote,
  type Farthest,
  type PointByPoint,
  pointByPoint,
  severalNote,
  type TakenWay,
} from "./elsewhere.js";
import { type DegreeBox, listOperations, type Operation } from "./operation.js";
import { parsePipeline } from "./pipeline.js";
import type { Proj } from "./program/find.js";
import { type EngineOptions, type EngineResult, type Lacking, UNKNOWN_HEIGHT_NOTE } from "./report.js";
import { type SourceTexts, sourceTexts } from "./source.js";

/** What PROJ is asked for a transformation with. */
export interface ProjTransformationOptions extends EngineOptions {
  /** The CRS in the user's own words, where they say more than what was read from them: a PROJ string above all. */
  readonly text?: string | undefined;
}

/** Better operations are many where one grid is missing; these are enough to say which. */
const LACKING_MAX = 5;

/**
 * The way from source coordinates to ECEF as PROJ goes it in the domain, in a form that needs no PROJ: projection
 * fitted, grids cut, checked against PROJ itself.
 *
 * Heights: of a CRS with heights above the ellipsoid, or of unknown heights, z is taken for the ellipsoidal height;
 * above a geoid whose grid PROJ lacks, the shift is that of EGM96. `report.notes` says so.
 *
 * @param domain source units
 * @throws CrsError CRS_UNKNOWN, CRS_UNSUPPORTED (no way leads to WGS 84), CRS_OPERATION_UNSUPPORTED (PROJ can, Groma
 *   cannot)
 * @throws PlacementError PLACE_DOMAIN, PLACE_POLE, PLACE_ANTIMERIDIAN, PLACE_PATCHWORK, PLACE_CHECK
 * @throws ProjError PROJ_FAILED, PROJ_OUTPUT, PROJ_GRID
 */
export async function projTransformation(
  proj: Proj,
  crs: Crs,
  domain: Domain,
  options: ProjTransformationOptions = {},
): Promise<EngineResult> {
  const { file = crs.name, signal } = options;
  const source = await sourceTexts(proj, crs, options.text, signal);
  const box = await boxOf(proj, source, domain, file, signal);
  const chosen = await chooseFor(proj, crs, source, domain, box, signal);
  const { operations, passedOver, substitute, from, outside } = chosen;
  const { tolerance = PATCHWORK_TOLERANCE } = options;
  const { size } = crs.verticalUnit;
  const taken = await pointByPoint(proj, from, chosen.choice.candidate, domain, size, signal);
  const sole = taken && (await soleWay(proj, taken, domain, signal));
  const choice = sole ?? chosen.choice;
  const byPoint = sole ? undefined : taken;
  const { candidate } = choice;
  const undated = [choice, ...(byPoint?.ways ?? [])].some((way) => way.candidate.plan.undated);
  const several = byPoint && (await waysOf(proj, choice, byPoint, domain, signal));
  const ways = several ?? ([{ ...choice, areas: [] }] as const);
  const { transformation, patchwork } = await assemble(proj, ways, { domain, tolerance, file, signal });
  const piped = ways.map(({ candidate: { plan }, areas }) => ({ pipeline: plan.pipeline, areas }));
  const { zScale } = candidate;
  const check = await checkTransformation(proj, piped, transformation, domain, zScale, file, signal);
  const beyond =
    substitute || candidate.covers || !isAboveGeoid(crs)
      ? undefined
      : await beyondGrids(proj, source, { crs, domain, box, file, tolerance, signal });
  const whole = beyond && goingOn(transformation, beyond, domain);
  const main = several && byPoint ? widest(byPoint) : undefined;
  const { operation, accuracy, elsewhere, told } = statedFor(candidate, byPoint, main);
  const notes = notesFor(
    crs,
    choice,
    { substitute, outside, undated },
    told,
    main !== undefined || whole !== undefined,
  );
  if (beyond && whole) notes.push(beyondNote(beyond, candidate.places));
  const grids = gridsIn(transformation);
  const worst = beyond && whole ? [accuracy, beyond.accuracy] : [accuracy];
  return {
    transformation: substitute
      ? await withEgm96(transformation, candidate.places)
      : (whole ?? transformation),
    report: {
      engine: { name: "PROJ", version: proj.version },
      operation: operation.name,
      accuracy:
        undated || worst.includes(null) ? null : Math.max(...(worst as number[]), elsewhere?.worth ?? 0),
      ballpark: operation.ballpark || choice.leftOut.length > 0,
      unstated: outside || undated,
      grids: substitute || whole ? [...grids, EGM96] : grids,
      lacking: lackingIn(operations, operation, substitute),
      passedOver,
      fitBound: patchwork.bound,
      ...check,
      notes,
    },
  };
}

/** What is said of the operations that a data set is placed by. */
interface Stated {
  /** The one that it is named by. */
  readonly operation: Operation;
  /** Metres; null where it is not known. */
  readonly accuracy: number | null;
  /** Another one that PROJ takes for some points and that is not followed, where that makes the accuracy worse. */
  readonly elsewhere: Farthest | undefined;
  readonly told: string | undefined;
}

/** @param main the way that most points go, where each goes PROJ's own */
function statedFor(
  candidate: Candidate,
  byPoint: PointByPoint | undefined,
  main: TakenWay | undefined,
): Stated {
  if (main && byPoint) {
    return {
      operation: main.candidate.operation,
      accuracy: leastAccurate([candidate, ...byPoint.ways.map((way) => way.candidate)]),
      elsewhere: undefined,
      told: severalNote(byPoint.ways, main),
    };
  }
  const { operation } = candidate;
  const { accuracy } = operation;
  const far = byPoint?.farthest;
  const elsewhere = far && (accuracy === null || far.worth > accuracy) ? far : undefined;
  return { operation, accuracy, elsewhere, told: elsewhere && elsewhereNote(elsewhere) };
}

/** The one operation that PROJ takes for every point of a data set, where it is not the first that it proposes. */
async function soleWay(
  proj: Proj,
  { ways }: PointByPoint,
  domain: Domain,
  signal?: AbortSignal,
): Promise<Choice | undefined> {
  const [way] = ways;
  if (ways.length !== 1 || way?.share !== 1) return undefined;
  return preparedOrNone(proj, way.candidate, domain, signal);
}

/** An operation with its grids; nothing where one cannot be read, or its steps cannot be followed. */
async function preparedOrNone(
  proj: Proj,
  candidate: Candidate,
  domain: Domain,
  signal?: AbortSignal,
): Promise<Choice | undefined> {
  try {
    return await prepared(proj, candidate, domain, signal);
  } catch (error) {
    if (error instanceof GromaError && ["PROJ_GRID", "CRS_OPERATION_UNSUPPORTED"].includes(error.code))
      return undefined;
    throw error;
  }
}

/**
 * The operations that PROJ takes for the points of a data set, as a choice that a file can carry; the one that was chosen
 * for all of it goes last, for what lies between their areas.
 *
 * @returns nothing where PROJ takes one operation alone, or they do not differ in datum shifts alone
 */
async function waysOf(
  proj: Proj,
  choice: Choice,
  { ways }: PointByPoint,
  domain: Domain,
  signal?: AbortSignal,
): Promise<readonly [AssembledWay, ...AssembledWay[]] | undefined> {
  const { candidate } = choice;
  if (ways.length < 2 || !ways.every((way) => isSameGround(way.candidate, candidate))) return undefined;
  const found: AssembledWay[] = [];
  for (const { candidate: its, areas } of ways) {
    const own = its === candidate ? choice : await preparedOrNone(proj, its, domain, signal);
    // What lies there is told, and counted.
    if (!own) return undefined;
    found.push({ ...own, areas: areas.filter((area) => meets(area, domain)) });
  }
  found.push({ ...choice, areas: [around(domain)] });
  return found as [AssembledWay, ...AssembledWay[]];
}

function meets(area: Rectangle, { minX, minY, maxX, maxY }: Domain): boolean {
  return area.minX <= maxX && area.maxX >= minX && area.minY <= maxY && area.maxY >= minY;
}

interface Place {
  readonly crs: Crs;
  readonly domain: Domain;
  readonly box: DegreeBox | undefined;
  readonly file: string;
  readonly tolerance: number;
  readonly signal?: AbortSignal | undefined;
}

/** The way in plane for points beyond the grids of a height system, and EGM96; nothing where there is none for all of them. */
async function beyondGrids(
  proj: Proj,
  source: SourceTexts,
  { crs, domain, box, file, tolerance, signal }: Place,
): Promise<Beyond | undefined> {
  const operations = await listOperations(proj, source.horizontal, { box, signal });
  const { choice } = await choose(proj, operations, domain, crs.verticalUnit.size, signal);
  if (!choice?.candidate.covers || choice.candidate.operation.ballpark || choice.leftOut.length > 0)
    return undefined;
  const { operation, plan, zScale, places } = choice.candidate;
  const ways = [{ ...choice, areas: [] }] as const;
  const { transformation } = await assemble(proj, ways, { domain, tolerance, file, signal });
  const checked = [{ pipeline: plan.pipeline, areas: [] }];
  await checkTransformation(proj, checked, transformation, domain, zScale, file, signal);
  const geoid = egm96Step(await egm96(), geodeticBounds(places));
  return { operation: operation.name, accuracy: operation.accuracy, transformation, geoid };
}

/** The operation that PROJ takes for most of the bounds. */
function widest({ ways }: PointByPoint): TakenWay {
  return ways.reduce((most, way) => (way.share > most.share ? way : most));
}

/** What is published for the operation that is worth least, metres; `null` where that is not known of all. */
function leastAccurate(candidates: readonly Candidate[]): number | null {
  return candidates.reduce<number | null>((least, { operation }) => {
    return least === null || operation.accuracy === null ? null : Math.max(least, operation.accuracy);
  }, 0);
}

/** File names of the grids that a transformation has parts of. */
function gridsIn(transformation: Transformation): string[] {
  const names = everyStep(transformation).flatMap((step) =>
    step.kind === "horizontalShift" || step.kind === "verticalShift" ? [step.window.grid] : [],
  );
  return [...new Set(names)].filter((name) => name !== CONSTANT);
}

/** Where the data are, by the projection alone, which is the same in all operations. */
async function boxOf(
  proj: Proj,
  source: SourceTexts,
  domain: Domain,
  file: string,
  signal?: AbortSignal,
): Promise<DegreeBox | undefined> {
  const operations = await listOperations(proj, source.horizontal, { direct: true, signal });
  const text = operations.find(({ pipeline }) => pipeline !== undefined)?.pipeline;
  if (text === undefined) return undefined;
  const { pipeline, projection } = parsePipeline(text);
  const places = await runToRadians(proj, pipeline.slice(0, projection), spread(domain), signal);
  const bounds = boundsOfPlaces(places);
  if (bounds) return degreeBox(bounds);
  throw new PlacementError({
    code: "PLACE_DOMAIN",
    file,
    cause: `the data set lies where its projection has no place (${boundsInWords(domain)})`,
    fix: "check that the coordinate reference system is the one the scan was made in, and that no point is an outlier",
  });
}

function lackingIn(operations: readonly Operation[], chosen: Operation, substitute: boolean): Lacking[] {
  const place = operations.findIndex(({ pipeline }) => pipeline === chosen.pipeline);
  const better = operations.filter(({ ballpark, missingGrids, accuracy }, i) => {
    if (ballpark || missingGrids.length === 0) return false;
    if (substitute || place < 0 || i < place || chosen.ballpark) return true;
    return accuracy !== null && (chosen.accuracy === null || accuracy < chosen.accuracy);
  });
  const lacking = better.map(({ name, accuracy, missingGrids }) => ({
    operation: name,
    accuracy,
    grids: missingGrids,
  }));
  return lacking.slice(0, LACKING_MAX);
}

function notesFor(
  crs: Crs,
  { candidate, leftOut }: Choice,
  { substitute, outside, undated }: Pick<Chosen, "substitute" | "outside"> & { readonly undated: boolean },
  elsewhere: string | undefined,
  several: boolean,
): string[] {
  const notes: string[] = [];
  if (crs.height.kind === "unknown") notes.push(UNKNOWN_HEIGHT_NOTE);
  if (substitute) notes.push(EGM96_NOTE);
  if (undated) {
    notes.push(
      "the operation changes with time, and the epoch of the coordinates is not known: it is taken as it was at its own, as PROJ does; give the epoch with the code, for example --crs EPSG:9309@2023.25",
    );
  }
  if (outside) {
    notes.push(
      `no operation of PROJ is meant for this place: it goes by the one for ${candidate.operation.area.replace(/\.$/, "")}, as PROJ does, and nobody states what that is worth here`,
    );
  }
  if (candidate.operation.ballpark) {
    notes.push(
      "PROJ knows no shift of this datum for this place: expect errors of up to some hundred metres",
    );
  }
  if (leftOut.length > 0) {
    const names = leftOut.flatMap((part) => part.grids).join(", ");
    notes.push(
      `the coordinate system takes ${names} for optional, and PROJ does not have it: nothing is shifted in its place`,
    );
  }
  if (elsewhere) notes.push(elsewhere);
  if (!candidate.covers && !several)
    notes.push("parts of the data set's bounds lie outside of the operation's grids");
  return notes;
}

async function withEgm96(transformation: Transformation, ecef: Float64Array): Promise<Transformation> {
  const bounds = geodeticBounds(ecef);
  const last = transformation.steps[transformation.steps.length - 1];
  return { steps: [...transformation.steps.slice(0, -1), egm96Step(await egm96(), bounds), last] };
}

function geodeticBounds(ecef: Float64Array): Bounds {
  const places = new Float64Array(ecef.length);
  for (let i = 0; i < ecef.length; i += 3) ecefToGeodetic(ecef[i], ecef[i + 1], ecef[i + 2], places, i);
  const bounds = boundsOfPlaces(places);
  if (!bounds) throw new RangeError("no place to cut the geoid for");
  return bounds;
}
