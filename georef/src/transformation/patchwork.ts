import { WGS84 } from "../ellipsoid/ellipsoid.js";
import { requireKind } from "../errors/arguments.js";
import { boundsInWords } from "../errors/coordinates.js";
import { PlacementError } from "../errors/errors.js";
import { fitPatch, type Refusal, SAMPLES_PER_PATCH, samplePlaces } from "./patch.js";
import type { Rectangle } from "./rectangle.js";
import type { EllipsoidAxes, Patch, Patchwork } from "./step.js";
import { turnedPlaces } from "./turned-sphere.js";

/**
 * Takes source coordinates x, y of many points, one after the other, and gives longitude, latitude of each in radians,
 * not finite where there is no place. Called once per level of subdivision, because a call may start a process.
 */
export type ProjectionSampler = (points: Float64Array) => Promise<Float64Array>;

/** Metres; half a percent of the millimetre that a drawn point is allowed, and less than any scanner resolves. */
export const PATCHWORK_TOLERANCE = 2e-5;

/** Halvings of the domain in each direction. Smooth projections need none below a few hundred kilometres. */
const DEPTH_MAX = 8;
/** As many patches fill a megabyte: more means that this is no smooth function. */
const PATCHES_MAX = 1024;

/** The domain is widened by this share of its coordinates, so that rounding does not put its edge outside. */
const MARGIN = 1e-9;

/**
 * Fits the inverse projection over a domain, cutting it up until each piece is certified to the tolerance. Where a pole or
 * a jump of longitude lies inside, the pieces count from the middle of the domain, on a sphere turned there.
 *
 * @param domain source units; a domain without width is widened by 1e-9 of its coordinates, as every one is
 * @param toleranceMetres on the ground
 * @param ellipsoid of the projection's base CRS
 * @param file name for error messages
 * @throws PlacementError PLACE_POLE or PLACE_ANTIMERIDIAN when the domain reaches around the earth so far that a sphere turned
 *   to its middle has a pole or a jump inside as well, PLACE_DOMAIN where there is no place, PLACE_PATCHWORK when no fit is
 *   good enough
 * @throws ArgumentError ARGUMENT_INVALID
 */
export async function fitPatchwork(
  sample: ProjectionSampler,
  domain: Rectangle,
  toleranceMetres: number = PATCHWORK_TOLERANCE,
  ellipsoid: EllipsoidAxes = WGS84,
  file = "points",
): Promise<Patchwork> {
  requireKind(sample, "function", "fitPatchwork: sample");
  requireKind(domain, "object", "fitPatchwork: domain");
  const how = [toleranceMetres, ellipsoid, file] as const;
  try {
    return await fitFrom(sample, domain, ...how);
  } catch (refusal) {
    if (!(refusal instanceof PlacementError && TURNING_HELPS.has(refusal.code))) throw refusal;
    const { minX, minY, maxX, maxY } = domain;
    const [longitude, latitude] = await sample(Float64Array.of((minX + maxX) / 2, (minY + maxY) / 2));
    if (!(Number.isFinite(longitude) && Number.isFinite(latitude))) throw refusal;
    const centre = [longitude, latitude] as const;
    const turned: ProjectionSampler = async (points) => turnedPlaces(await sample(points), centre);
    for (const wider of WIDER) {
      try {
        return { ...(await fitFrom(turned, around(domain, wider), ...how)), centre };
      } catch (error) {
        // Where the projection ends there is nothing wider.
        if (!(error instanceof PlacementError) || error.code === "PLACE_DOMAIN") throw refusal;
      }
    }
    throw refusal;
  }
}

/**
 * How many times as wide a domain is tried around a pole. Projections that take an arc cosine there (Lambert's azimuthal
 * equal-area) lose half of their digits near it: what is sampled farther away tells the same function without that noise.
 */
const WIDER = [1, 10, 100, 1000, 10_000];

function around({ minX, minY, maxX, maxY }: Rectangle, times: number): Rectangle {
  const [x, y] = [maxX - minX, maxY - minY].map((width) => (width * (times - 1)) / 2);
  return { minX: minX - x, minY: minY - y, maxX: maxX + x, maxY: maxY + y };
}

const TURNING_HELPS = new Set(["PLACE_POLE", "PLACE_ANTIMERIDIAN"]);

/** A patchwork in the longitudes and latitudes that the sampler gives. */
async function fitFrom(
  sample: ProjectionSampler,
  domain: Rectangle,
  toleranceMetres: number,
  ellipsoid: EllipsoidAxes,
  file: string,
): Promise<Patchwork> {
  // The greatest radius of curvature of the ellipsoid, at its poles: no angle is longer on the ground.
  const metresPerRadian = ellipsoid.a / (1 - ellipsoid.f);
  const patches: Patch[] = [];
  let bound = 0;
  let open: Rectangle[] = [widened(domain, file)];
  for (let depth = 0; open.length > 0; depth++) {
    const places = await sample(samplePlaces(open));
    const next: Rectangle[] = [];
    let refusal: Refusal = "rough";
    for (const [i, rectangle] of open.entries()) {
      const own = places.subarray(2 * SAMPLES_PER_PATCH * i, 2 * SAMPLES_PER_PATCH * (i + 1));
      const fit = fitPatch(rectangle, own, metresPerRadian);
      if (fit.patch && fit.bound <= toleranceMetres) {
        patches.push(fit.patch);
        bound = Math.max(bound, fit.bound);
        continue;
      }
      if (fit.final || depth === DEPTH_MAX) throw refused(fit.refusal, rectangle, file, toleranceMetres);
      next.push(...halves(rectangle, fit.split));
      refusal = fit.refusal;
    }
    if (patches.length + next.length > PATCHES_MAX) throw refused(refusal, open[0], file, toleranceMetres);
    open = next;
  }
  return { patches, bound };
}

function widened({ minX, minY, maxX, maxY }: Rectangle, file: string): Rectangle {
  if (!([minX, minY, maxX, maxY].every(Number.isFinite) && minX <= maxX && minY <= maxY)) {
    throw refused("nowhere", { minX, minY, maxX, maxY }, file, 0);
  }
  const x = MARGIN * Math.max(1, Math.abs(minX), Math.abs(maxX));
  const y = MARGIN * Math.max(1, Math.abs(minY), Math.abs(maxY));
  return { minX: minX - x, minY: minY - y, maxX: maxX + x, maxY: maxY + y };
}

/** Cuts a rectangle in two or four. */
function halves({ minX, minY, maxX, maxY }: Rectangle, split: "x" | "y" | "both"): Rectangle[] {
  const x = minX + (maxX - minX) / 2;
  const y = minY + (maxY - minY) / 2;
  const columns =
    split === "y"
      ? [[minX, maxX]]
      : [
          [minX, x],
          [x, maxX],
        ];
  const rows =
    split === "x"
      ? [[minY, maxY]]
      : [
          [minY, y],
          [y, maxY],
        ];
  return columns.flatMap(([x0, x1]) => rows.map(([y0, y1]) => ({ minX: x0, minY: y0, maxX: x1, maxY: y1 })));
}

function refused(why: Refusal, rectangle: Rectangle, file: string, tolerance: number): PlacementError {
  const bounds = boundsInWords(rectangle);
  const check =
    "check that the coordinate reference system is the one the scan was made in, and that no point is an outlier";
  const smaller =
    "cut the data set into parts that do not contain it, or transform it to another projection first";
  const [code, cause, fix] = {
    nowhere: [
      "PLACE_DOMAIN",
      `part of the data set lies where its projection has no place (${bounds})`,
      check,
    ],
    pole: ["PLACE_POLE", `the data set reaches around a pole and far beyond it (${bounds})`, smaller],
    jump: ["PLACE_ANTIMERIDIAN", `longitude jumps inside the data set (${bounds})`, smaller],
    rough: ["PLACE_PATCHWORK", `no fit of the projection reaches ${tolerance} m (${bounds})`, check],
  }[why];
  return new PlacementError({ code, file, cause, fix });
}
