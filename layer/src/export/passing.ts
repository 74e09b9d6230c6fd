import { type PointFilter, recordTest } from "../effects/index.js";
import { FormatError } from "../errors/index.js";
import {
  type GeodeticPlace,
  ofClasses,
  type PointBatch,
  type PointOrigin,
  recordNumbers,
} from "../query/index.js";

/** Which of the points of a data set are wanted, by what is recorded of them. */
export interface WantedPoints {
  readonly origin: PointOrigin;
  /** Classes of the points that are wanted. Default: all. */
  readonly classes?: ReadonlySet<number> | undefined;
  /** What passes, such as `layer.filter`. Default: everything. */
  readonly filter?: PointFilter | undefined;
  /**
   * Where source coordinates are, for GeoJSON: longitude and latitude (degrees, WGS 84) and height above the ellipsoid
   * (metres), written to `out`.
   */
  readonly geodetic?: GeodeticPlace | undefined;
}

/**
 * Those of a batch's points that a selection's classes and filter let pass: indices of records, rising. The same records as a
 * layer with that filter shows, on their exact values.
 * @throws FormatError EXPORT_NO_PLACE where heights above the ellipsoid are asked for and not known
 */
export function passing(batch: PointBatch, selection: WantedPoints): Uint32Array {
  const { classes, filter } = selection;
  const wanted = classes ? ofClasses(batch, classes) : batch.inside;
  if (!filter) return wanted;
  const { origin, geodetic } = selection;
  if (filter.ranges && "ellipsoidalHeight" in filter.ranges && !geodetic)
    throw noPlace(origin.name, "heights above the ellipsoid");
  return wanted.filter(
    recordTest(filter, undefined, (name) => recordNumbers(name, batch.records, origin, geodetic)),
  );
}

/** The error for points whose place on the globe is asked for and not known. */
export function noPlace(file: string, what: string): FormatError {
  return new FormatError({
    code: "EXPORT_NO_PLACE",
    file,
    cause: `${what} are asked for, and where its points lie on the globe is not known`,
    fix: "Open it as a PointCloud, or give volumes in source coordinates",
  });
}
