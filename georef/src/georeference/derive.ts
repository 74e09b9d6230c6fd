import type { Domain } from "../cartesian/domain.js";
import type { Crs } from "../crs/crs.js";
import { isAboveOwnEllipsoid } from "../crs/same.js";
import { WGS84 } from "../ellipsoid/ellipsoid.js";
import { inverseOf, open } from "../engines/projection.js";
import { requireFields } from "../errors/arguments.js";
import { CrsError } from "../errors/errors.js";
import type { Bounds, Grid } from "../grid/window.js";
import { fitPatchwork, PATCHWORK_TOLERANCE } from "../transformation/patchwork.js";
import type { DatumShiftStep, Step, Transformation } from "../transformation/step.js";
import { egm96Step } from "../vertical/egm96.js";
import { isAboveGeoid } from "../vertical/zero-level.js";
import { boundsOfPlaces, spread } from "./area.js";

/** How a transformation is derived. */
export interface DerivedOptions {
  /**
   * For heights above a geoid, whichever it is: EGM96. Without it such heights are taken as they are, and so are those
   * that count from a level of their own.
   */
  readonly egm96?: Grid | undefined;
  /** Metres that the fit of the projection may be off. Default: {@link PATCHWORK_TOLERANCE}. */
  readonly tolerance?: number | undefined;
  /** For error messages. */
  readonly file?: string | undefined;
}

const TOWGS84 = /\s\+towgs84=(\S+)/;
const ARC_SECOND = Math.PI / 648_000;

/**
 * The way from source coordinates to ECEF as far as `crs.proj4` knows it: proj4js's projection, the seven parameters of
 * the datum, EGM96 for heights above a geoid. As PROJ does, the datum shift leaves heights alone that are not above the
 * ellipsoid of the CRS's own datum.
 *
 * @param domain source units
 * @throws CrsError CRS_UNSUPPORTED
 * @throws PlacementError PLACE_DOMAIN, PLACE_POLE, PLACE_ANTIMERIDIAN, PLACE_PATCHWORK
 * @throws ArgumentError ARGUMENT_INVALID
 */
export async function deriveTransformation(
  crs: Crs,
  domain: Domain,
  options: DerivedOptions = {},
): Promise<Transformation> {
  requireFields(
    crs,
    { proj4: "text", horizontalUnit: "object", verticalUnit: "object", height: "object" },
    "deriveTransformation: crs",
  );
  const { egm96, tolerance = PATCHWORK_TOLERANCE, file = crs.name } = options;
  if (/\+proj=geocent\b/.test(crs.proj4)) throw inSpace(file);
  const sample = sampler(crs);
  const patchwork = await fitPatchwork(async (points) => sample(points), domain, tolerance, undefined, file);
  const steps: Step[] = [{ kind: "projection", patchwork }];
  if (crs.verticalUnit.size !== 1) steps.push({ kind: "height", metresPerUnit: crs.verticalUnit.size });
  const shift = datumShift(crs);
  if (shift) steps.push(shift);
  if (egm96 && isAboveGeoid(crs)) steps.push(egm96Step(egm96, boundsOf(sample, domain)));
  steps.push({ kind: "geocentric", ellipsoid: { a: WGS84.a, f: WGS84.f } });
  return { steps };
}

/** x, y pairs to longitude, latitude pairs (radians) of the CRS's own datum. */
function sampler(crs: Crs): (points: Float64Array) => Float64Array {
  const inverse = inverseOf(open(crs.proj4.replace(TOWGS84, "")), crs.horizontalUnit.size);
  return (points) => {
    const out = new Float64Array(points.length);
    for (let i = 0; i < points.length; i += 2) inverse(points[i], points[i + 1], out, i);
    return out;
  };
}

/** The shift of a CRS's PROJ string: position vector rotations in arc-seconds, taken for their sines, as PROJ's `+towgs84`. */
function datumShift(crs: Pick<Crs, "proj4" | "height">): DatumShiftStep | undefined {
  const text = crs.proj4;
  const given = (TOWGS84.exec(text)?.[1] ?? "").split(",").map(Number);
  if (given.every((value) => value === 0)) return undefined;
  const [x, y, z] = given;
  const [rx, ry, rz] = [3, 4, 5].map((i) => (given[i] ?? 0) * ARC_SECOND);
  const scale = 1 + (given[6] ?? 0) * 1e-6;
  const number = (key: string) => Number(new RegExp(`\\+${key}=(\\S+)`).exec(text)?.[1] ?? Number.NaN);
  const a = number("a");
  const rf = number("rf");
  const f = Number.isFinite(rf) && rf !== 0 ? 1 / rf : Number.isFinite(number("b")) ? 1 - number("b") / a : 0;
  return {
    kind: "datumShift",
    from: { a, f },
    to: { a: WGS84.a, f: WGS84.f },
    translation: [x, y, z],
    matrix: [1, -rz, ry, rz, 1, -rx, -ry, rx, 1].map((value) => scale * value),
    keepHeight: !isAboveOwnEllipsoid(crs),
  };
}

function boundsOf(sample: (points: Float64Array) => Float64Array, domain: Domain): Bounds {
  const points = spread(domain);
  const places = new Float64Array(points.length);
  for (let i = 0; i < points.length; i += 3) places.set(sample(points.slice(i, i + 2)), i);
  const bounds = boundsOfPlaces(places);
  // The fit has found a place for every point before.
  if (!bounds) throw new RangeError("no place to cut the geoid for");
  return bounds;
}

function inSpace(file: string): CrsError {
  return new CrsError({
    code: "CRS_UNSUPPORTED",
    file,
    cause: "its coordinates are geocentric, and have no height of their own",
    fix: "leave the height reference out",
  });
}
