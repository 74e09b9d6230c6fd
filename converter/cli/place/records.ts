import {
  accuracyParts,
  type Crs,
  type Domain,
  domainAround,
  EGM96,
  EGM96_NOTE,
  ENGINE,
  ecefToGeodetic,
  egm96Undulation,
  encodeRecord,
  encodeTransformation,
  type GeoreferenceRecord,
  greatestBound,
  guessHeight,
  type OperationReport,
  ownLevel,
  ownLevelNote,
  type Place,
  pointTransform,
  similarityParts,
  type Truth,
  truthOf,
} from "@groma/georef";
import type { PointBounds } from "../core/core.js";
import { egm96 } from "../proj/egm96.js";
import { type EngineReport, UNKNOWN_HEIGHT_NOTE } from "../proj/report.js";
import { type EngineChoice, type EngineSurroundings, engineTransformation } from "./engine.js";
import { heightSystems } from "./epsg.js";
import { geoidsOf } from "./geoids.js";
import type { Georeferenced } from "./georeference.js";
import { withKnownShift } from "./known-shift.js";
import { centreOf, countriesOf, heightSystemAbroad } from "./whereabouts.js";

/** Bound on the drawn position that the page keeps by default, metres. */
export const TOLERANCE = 0.001;

/** What goes into a file to say where its points are. */
export interface GeoreferenceRecords {
  readonly georeference: GeoreferenceRecord;
  /** Payload of the VLR `groma`/1. */
  readonly record: Uint8Array;
  /** Payload of the VLR `groma`/3; absent where the coordinates are in space already. */
  readonly transformation?: Uint8Array;
  /** Bound of the projection's fit, metres. */
  readonly fitBound?: number;
  /** Where the engine puts the middle of the bounds, if it has a place. */
  readonly centre?: Place;
}

/** Longest payload of a plain VLR. */
const LONGEST_RECORD = 65535;

/**
 * Settles how a data set is placed: by its similarity, or by an engine over the bounds of its points.
 *
 * @param bounds of the points themselves: the transformation holds there and one step around, and nowhere else
 * @param scale LAS scale factors, source units
 * @throws CrsError, PlacementError, ProjError
 */
export async function makeRecords(
  { crs, local, notes }: Georeferenced,
  { min, max }: PointBounds,
  scale: ArrayLike<number>,
  choice: EngineChoice,
  surroundings: EngineSurroundings,
): Promise<GeoreferenceRecords> {
  if (local) {
    const accuracy = local.accuracy ?? similarityParts(crs, scale, TOLERANCE, local.fitted);
    const engine = { name: "similarity", version: "1" } as const;
    return encoded({ version: 1, crs, engine, similarity: local.similarity, accuracy });
  }
  if (isInSpace(crs)) {
    return encoded({ version: 1, crs, engine: ENGINE, accuracy: accuracyParts(crs, scale, TOLERANCE) });
  }
  const domain = domainAround({ min, max }, scale, crs.horizontalUnit);
  const { minZ, maxZ } = domain;
  const { transformation, report: own } = await engineTransformation(crs, domain, choice, surroundings);
  const bytes = encodeTransformation(transformation);
  const truth = truthOf({ crs, transformation: bytes }, (minZ + maxZ) / 2, surroundings.file);
  const report = withKnownShift(own, crs, truth, domain);
  const guess = await guessFor(crs, truth, domain);
  const outsideOf = heightSystemAbroad(crs, truth, { min, max });
  const operation = operationReport(report, guess, notes, outsideOf);
  const fit = Math.max(TOLERANCE + report.fitBound, greatestBound(truth, domain, TOLERANCE));
  const accuracy = accuracyParts(crs, scale, fit, {
    ...{ operation, geoids: geoidsOf(truth), guess, outsideOf },
  });
  const georeference = { version: 1, crs, engine: report.engine, operation, accuracy } as const;
  const centre = centreOf(truth, { min, max });
  return {
    ...encoded(georeference),
    ...{ transformation: bytes, fitBound: report.fitBound, ...(centre && { centre }) },
  };
}

/** Geocentric coordinates are ECEF but for their unit: there is nothing to fit. */
function isInSpace({ proj4 }: Crs): boolean {
  return /\+proj=geocent\b/.test(proj4);
}

function encoded(georeference: GeoreferenceRecord): GeoreferenceRecords {
  const record = encodeRecord(georeference);
  const { wkt, ...crs } = georeference.crs;
  // The WKT stands in a record of its own as well.
  if (record.length > LONGEST_RECORD && wkt !== undefined) return encoded({ ...georeference, crs });
  return { georeference, record };
}

/** What the record keeps of an engine's report. */
function operationReport(
  report: EngineReport,
  guess: string | undefined,
  found: Georeferenced["notes"],
  outsideOf: string | undefined,
): OperationReport {
  const passedOver = report.passedOver.map(
    ({ operation, why }) => `PROJ would have taken "${operation}", which is not followed: ${why}`,
  );
  const notes = report.notes.map((note) => {
    if (note === UNKNOWN_HEIGHT_NOTE && guess !== undefined) return `height reference unknown: ${guess}`;
    if (note !== EGM96_NOTE || outsideOf === undefined) return note;
    return `height by the geoid model ${EGM96}: ${outsideOf} is not in use at this place`;
  });
  const level = guess !== undefined && !report.notes.includes(UNKNOWN_HEIGHT_NOTE) ? [guess] : [];
  return {
    name: report.operation,
    accuracy: report.accuracy,
    ballpark: report.ballpark,
    grids: report.grids,
    lacking: report.lacking.map(({ operation, accuracy, grids }) => ({ name: operation, accuracy, grids })),
    worstDifference: report.checkedPoints > 0 ? report.worstDifference : null,
    notes: [...found.map(({ text }) => text), ...notes, ...level, ...passedOver],
  };
}

/**
 * What heights of unknown reference may be, or how far off those are that count from a level of their own, in words;
 * nothing for others, and where the middle of the data set has no place.
 */
async function guessFor(
  crs: Crs,
  truth: Truth,
  { minX, minY, minZ, maxX, maxY, maxZ }: Domain,
): Promise<string | undefined> {
  const level = geoidsOf(truth).length === 0 ? ownLevel(crs) : undefined;
  if (crs.height.kind !== "unknown" && !level) return undefined;
  const ecef = new Float64Array(3);
  pointTransform(truth)((minX + maxX) / 2, (minY + maxY) / 2, (minZ + maxZ) / 2, ecef, 0);
  if (!ecef.every(Number.isFinite)) return undefined;
  const geodetic = new Float64Array(3);
  ecefToGeodetic(ecef[0], ecef[1], ecef[2], geodetic);
  const code = /^EPSG:(\d+)/.exec(crs.code ?? "")?.[1];
  const countries = countriesOf(code === undefined ? undefined : Number(code));
  const [longitude, latitude] = [geodetic[0]!, geodetic[1]!];
  if (level) return ownLevelNote(crs, level, egm96Undulation(await egm96(), longitude, latitude));
  return guessHeight(await egm96(), heightSystems(), crs, longitude, latitude, countries).note;
}
