import { CrsError, type GromaError, WEB_MERCATOR_PLANE } from "@groma/georef";
import type Projection from "ol/proj/Projection.js";
import type { MapProjection } from "../cloud/index.js";
import { packagedModule } from "../cloud/packaged-file.js";

/** Least tolerance of placing, nominal metres: no map is looked at so closely. */
const FINEST = 1e-4;
/** Share of a pixel at the finest resolution of the map that a point may be off. */
const PIXEL_SHARE = 0.1;

/**
 * What a data set must know of a map's projection to be placed in it. proj4 is loaded for any other than Web Mercator.
 * @param finest least resolution of the view, units of the projection per pixel
 * @param file the data set's name, for errors
 * @throws CrsError CRS_PROJECTION where it is not registered with proj4; SourceError SOURCE_MODULE
 */
export async function projectionOfMap(
  projection: Projection,
  finest: number,
  file: string,
): Promise<MapProjection> {
  const code = projection.getCode();
  const toleranceOf = (metresPerUnit: number) => Math.max(FINEST, PIXEL_SHARE * finest * metresPerUnit);
  if (code === WEB_MERCATOR_PLANE.code && projection.canWrapX())
    return { ...WEB_MERCATOR_PLANE, tolerance: toleranceOf(WEB_MERCATOR_PLANE.metresPerUnit) };
  const { default: proj4 } = await packagedModule(() => import("proj4"));
  const definition: { readonly to_meter?: number } | undefined = proj4.defs(code);
  if (!definition) throw notRegistered(code, file);
  // OpenLayers knows of no unit where the definition names none: metres, then.
  const metresPerUnit = projection.getMetersPerUnit() ?? definition.to_meter ?? 1;
  const tolerance = toleranceOf(metresPerUnit);
  return { code, definition, metresPerUnit, wraps: projection.canWrapX(), tolerance };
}

/** A projection that neither OpenLayers nor proj4js knows. */
export function notRegistered(code: string, file: string): GromaError {
  return new CrsError({
    code: "CRS_PROJECTION",
    file,
    cause: `the projection of the map, ${code}, is not known to proj4`,
    fix: `define it with proj4.defs("${code}", …) or ask for its definition with fromEPSGCode, and call register(proj4)`,
  });
}
