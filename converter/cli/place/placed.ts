import {
  type AccuracyPart,
  accuracyParts,
  type CompiledTransformation,
  type Crs,
  domainAround,
  ENGINE,
  type ExactTransform,
  type GeoreferenceRecord,
  greatestBound,
  type OperationReport,
  truthOf,
  withWorthThere,
} from "@groma/georef";
import type { Scan } from "../core/core.js";
import { fitBoundOf, geoidsOf } from "./geoids.js";
import { type Georeferenced, georeference, georeferenceRecord, type Named } from "./georeference.js";
import { TOLERANCE } from "./records.js";

/** Where a file's points are, as the file itself says it: by the same code that a page uses, without PROJ. */
export interface Placed {
  readonly crs: Crs;
  readonly basis: Georeferenced["basis"];
  /** What has to be known of how the coordinate reference system was found. */
  readonly notes: Georeferenced["notes"];
  /** Source coordinates → ECEF. */
  readonly truth: ExactTransform | CompiledTransformation;
  readonly engine: GeoreferenceRecord["engine"];
  readonly operation: OperationReport | undefined;
  /** Grids that heights go through. */
  readonly geoids: readonly string[];
  /** Metres; undefined where no fit stands for the projection. */
  readonly fitBound: number | undefined;
  readonly accuracy: readonly AccuracyPart[];
}

/**
 * What a file says of its place: its records, else its WKT or GeoTIFF keys by proj4js.
 *
 * @throws RecordError RECORD_*
 * @throws CrsError CRS_MISSING, CRS_UNKNOWN, CRS_UNSUPPORTED
 */
export async function placed(scan: Named & Pick<Scan, "min" | "max" | "scale">): Promise<Placed> {
  const middle = (scan.min[2] + scan.max[2]) / 2;
  const record = georeferenceRecord(scan);
  if (!record) {
    const { crs, basis, notes } = await georeference(scan, { engine: "proj4js" });
    const truth = truthOf({ crs }, middle, scan.file);
    const accuracy = partsOf(crs, truth, scan);
    return { crs, basis, notes, truth, ...noReport, accuracy };
  }
  const { crs, similarity, engine, operation, accuracy } = record;
  const bytes = scan.groma?.["3"];
  const basis = "Groma's record";
  const transformation = bytes === undefined ? undefined : Buffer.from(bytes, "base64");
  const truth = truthOf({ crs, similarity, transformation }, middle, scan.file);
  if (operation && !transformation) {
    const accuracy = partsOf(crs, truth, scan);
    return { crs, basis, notes: [], truth, ...noReport, accuracy };
  }
  return {
    crs,
    basis,
    notes: [],
    truth,
    engine,
    operation,
    geoids: geoidsOf(truth),
    fitBound: fitBoundOf(truth),
    accuracy,
  };
}

function partsOf(
  crs: Crs,
  truth: Placed["truth"],
  scan: Pick<Scan, "min" | "max" | "scale">,
): AccuracyPart[] {
  const domain = domainAround(scan, scan.scale, crs.horizontalUnit);
  return accuracyParts(
    withWorthThere(crs, truth, domain),
    scan.scale,
    greatestBound(truth, domain, TOLERANCE),
  );
}

/** Of a place that no conversion has settled. */
const noReport = { engine: ENGINE, operation: undefined, geoids: [], fitBound: undefined } as const;
