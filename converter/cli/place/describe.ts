import {
  type AccuracyPart,
  type Crs,
  EGM96,
  ecefToGeodetic,
  type OperationReport,
  pointTransform,
  statedAccuracy,
  type Truth,
} from "@groma/georef";
import type { Scan } from "../core/core.js";
import { howToGet } from "../proj/grids/current-names.js";
import { atMost } from "../terminal/output.js";
import type { Placed } from "./placed.js";

const DEGREE = Math.PI / 180;

/** Bounds of a data set on the earth: degrees, metres above the ellipsoid as far as its heights are that. */
export interface GeodeticBounds {
  readonly west: number;
  readonly south: number;
  readonly east: number;
  readonly north: number;
  readonly lowest: number;
  readonly highest: number;
}

/**
 * Longitudes and latitudes that the header's box covers, from its corners and the middles of its edges as far as these
 * have a place; undefined where none has.
 */
export function geodeticBounds(scan: Scan, truth: Truth): GeodeticBounds | undefined {
  const evaluate = pointTransform(truth);
  const ecef = new Float64Array(3);
  const geodetic = new Float64Array(3);
  const bounds = { west: 180, south: 90, east: -180, north: -90, lowest: Infinity, highest: -Infinity };
  const steps = [0, 0.5, 1];
  const at = (axis: 0 | 1 | 2, share: number) =>
    share === 1 ? scan.max[axis] : scan.min[axis] + share * (scan.max[axis] - scan.min[axis]);
  for (const u of steps) {
    for (const v of steps) {
      for (const w of [0, 1]) {
        evaluate(at(0, u), at(1, v), at(2, w), ecef, 0);
        if (!ecef.every(Number.isFinite)) continue;
        ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, geodetic);
        const [longitude, latitude, height] = [geodetic[0]! / DEGREE, geodetic[1]! / DEGREE, geodetic[2]!];
        bounds.west = Math.min(bounds.west, longitude);
        bounds.east = Math.max(bounds.east, longitude);
        bounds.south = Math.min(bounds.south, latitude);
        bounds.north = Math.max(bounds.north, latitude);
        bounds.lowest = Math.min(bounds.lowest, height);
        bounds.highest = Math.max(bounds.highest, height);
      }
    }
  }
  return bounds.lowest <= bounds.highest ? bounds : undefined;
}

/**
 * What the heights of a data set are measured from, in words.
 *
 * @param geoids grids that they go through; undefined as long as nothing is settled
 */
export function heightInWords({ height, verticalUnit }: Crs, geoids?: readonly string[]): string {
  switch (height.kind) {
    case "ellipsoidal":
      return "ellipsoidal";
    case "geoid": {
      const above = `${verticalUnit.size < 0 ? "counted downwards from" : "above"} ${height.model}${height.epsg ? ` (EPSG:${height.epsg})` : ""}`;
      return geoids === undefined ? above : `${above}, ${geoidInWords(geoids)}`;
    }
    case "unknown":
      return "unknown (shown as ellipsoidal)";
  }
}

function geoidInWords(geoids: readonly string[]): string {
  if (geoids.length === 0) return "geoid not applied: shown as ellipsoidal";
  if (geoids.includes(EGM96)) return `geoid ${EGM96} applied instead of the national one`;
  return `geoid ${geoids.map(stem).join(", ")} applied`;
}

/** Name of a CRS with its code, if the name does not have it. */
export function crsInWords({ name, code }: Crs): string {
  return code && !name.includes(code) ? `${code} ${name}` : name;
}

/** What was computed and how well: `EPSG:7415 … → ECEF by PROJ 9.4.0 (grids), fit ≤ 0.02 mm, operation 1 mm`. */
export function placeInWords(
  place: Pick<Placed, "crs" | "engine" | "operation" | "fitBound" | "accuracy">,
): string {
  const { crs, engine, operation, fitBound, accuracy } = place;
  const whole = crsInWords(crs);
  if (engine.name === "similarity")
    return `${whole} → ECEF by a similarity transformation${residualsInWords(accuracy)}`;
  const grids = operation?.grids ?? [];
  const by = `${engine.name} ${engine.version}${grids.length > 0 ? ` (${grids.map(stem).join(", ")})` : ""}`;
  const fit = fitBound === undefined ? "" : `, fit ≤ ${atMost(fitBound)}`;
  return `${whole} → ECEF by ${by}${fit}${operation ? `, ${operationInWords(operation)}` : ""}`;
}

function operationInWords({ accuracy, ballpark }: OperationReport): string {
  if (ballpark) return "no datum transformation available";
  return `operation ${accuracy === null ? "of unknown accuracy" : atMost(accuracy)}`;
}

function residualsInWords(accuracy: readonly AccuracyPart[]): string {
  const worst = accuracy.find(({ name }) => name === "control points")?.metres;
  return typeof worst === "number" ? `, residuals ≤ ${atMost(worst)}` : "";
}

/** The total of an accuracy, or why it is unknown. */
export function accuracyInWords(parts: readonly AccuracyPart[], crs: Pick<Crs, "height">): string {
  const { total } = statedAccuracy(parts);
  return total === null ? unknownTotal(parts, crs) : `${atMost(total)} in total`;
}

/** Why the accuracies of the parts do not add up: `total accuracy unknown: height reference not declared`. */
function unknownTotal(parts: readonly AccuracyPart[], { height }: Pick<Crs, "height">): string {
  const lacks: ReadonlyMap<string, string> = new Map([
    ["height", height.kind === "unknown" ? "height reference not declared" : unknownHeight(parts, height)],
    ["datum operation", "accuracy of the datum operation not published"],
    ["anchor", "accuracy of the anchor not stated"],
  ]);
  const unknown = parts.filter(({ metres }) => metres === null).map(({ name }) => lacks.get(name) ?? name);
  return `total accuracy unknown: ${unknown.join(", ")}`;
}

/** Why heights of a known reference are of unknown worth. */
function unknownHeight(
  parts: readonly AccuracyPart[],
  { doubt }: Exclude<Crs["height"], { kind: "unknown" }>,
): string {
  if (doubt !== undefined) return `heights ${doubt}`;
  const note = parts.find(({ name }) => name === "height")?.note ?? "";
  if (/not in use at this place/.test(note)) return "height system not in use at this place";
  return /level of its own/.test(note) ? "heights count from a level of their own" : "geoid not applied";
}

/** What a reader has to know of the way that was chosen, one sentence each. */
export function remarks(operation: OperationReport | undefined): string[] {
  if (!operation) return [];
  const geoid = operation.grids.includes(EGM96)
    ? "the country's own geoid"
    : "the operation that PROJ prefers";
  const lacking = operation.lacking.map(({ name, accuracy, grids }) => {
    const files = grids.join(", ");
    // What nobody has stated is not promised.
    if (accuracy === null) return `with ${files}, ${geoid} is used; its accuracy is not published: ${name}`;
    return `more accurate with ${files}: ${name} (${atMost(accuracy)})`;
  });
  const missing = [...new Set(operation.lacking.flatMap(({ grids }) => grids))];
  const way = missing.length === 0 ? [] : [`missing grids: ${howToGet(missing)}`];
  return [...operation.notes, ...lacking, ...way];
}

/** Name of a grid without what kind of file it is. */
function stem(file: string): string {
  return file.replace(/\.(tif|tiff|gtx|gsb|gtg)$/i, "");
}

/** Points per square metre over the header's rectangle; undefined for a rectangle without area. */
export function density(scan: Scan, crs: Crs): number | undefined {
  const middle = ((scan.min[1] + scan.max[1]) / 2) * crs.horizontalUnit.size;
  const [east, north] =
    crs.horizontalUnit.kind === "angular"
      ? [crs.horizontalUnit.size * 6_378_137 * Math.cos(middle), crs.horizontalUnit.size * 6_378_137]
      : [crs.horizontalUnit.size, crs.horizontalUnit.size];
  const area = (scan.max[0] - scan.min[0]) * east * ((scan.max[1] - scan.min[1]) * north);
  return area > 0 ? scan.points / area : undefined;
}
