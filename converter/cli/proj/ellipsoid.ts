import type { EllipsoidAxes } from "@groma/georef";
import { runPipeline } from "./cct.js";
import type { EllipsoidText } from "./plan.js";
import { ProjError } from "./program/errors.js";
import type { Proj } from "./program/find.js";

/** Longitude, latitude in degrees, height: where an axis of the ellipsoid comes out. */
const AXES = new Float64Array([0, 0, 0, 0, 90, 0]);

/**
 * Axes of an ellipsoid as PROJ has them, whichever of its many ways of giving one is used: the geocentric coordinates of
 * a point on the equator and of the pole.
 *
 * @throws ProjError PROJ_OUTPUT when PROJ gives no ellipsoid of revolution
 */
export async function ellipsoidAxes(
  proj: Proj,
  parameters: EllipsoidText,
  signal?: AbortSignal,
): Promise<EllipsoidAxes> {
  const step = { name: "cart", inverse: false, parameters };
  const [a, , , , , b] = await runPipeline(proj, [step], AXES, signal);
  if (a > 0 && b > 0 && b <= a) return { a, f: (a - b) / a };
  throw new ProjError({
    code: "PROJ_OUTPUT",
    file: proj.cct,
    cause: `it gives the ellipsoid ${[...parameters].map((pair) => pair.join("=")).join(" ")} no usable axes`,
    fix: "give the coordinate reference system as an EPSG code, or convert with --engine proj4js",
  });
}
