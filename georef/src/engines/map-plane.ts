import proj4 from "proj4";
import type { Crs } from "../crs/crs.js";
import { requireFields } from "../errors/arguments.js";
import { CrsError } from "../errors/errors.js";
import type { Rectangle } from "../transformation/rectangle.js";
import { corners, type MapPlane, type PlaneTransform, truthToPlane } from "./on-map.js";
import { inverseOf, open, type Projection, SEVEN_PARAMETERS, THREE_PARAMETERS } from "./projection.js";
import type { Truth } from "./truth.js";

const TURN = 2 * Math.PI;
const DEGREE = Math.PI / 180;

/**
 * The way that OpenLayers itself takes to a projection registered with proj4js: from WGS 84, with the datum shift of the
 * definition at height 0, so that points lie where the map's other layers have the same longitude and latitude.
 *
 * @throws CrsError CRS_UNSUPPORTED where proj4js does not know the projection
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function planeTransform(map: MapPlane): PlaneTransform {
  requireFields(map, { code: "text", metresPerUnit: "number", middle: "number" }, "planeTransform: map");
  const { code, definition, metresPerUnit, wraps, middle } = map;
  const world = new proj4.Proj("WGS84");
  const plane = openPlane(code, definition);
  // Longitudes beyond 180° go on beyond the edge of the world.
  if (wraps) plane.over = true;
  const from = { x: 0, y: 0 };
  return (longitude, latitude, out, offset) => {
    out[offset] = Number.NaN;
    out[offset + 1] = Number.NaN;
    if (!Number.isFinite(longitude) || !Number.isFinite(latitude)) return;
    from.x = (longitude - TURN * Math.round((longitude - middle) / TURN)) / DEGREE;
    from.y = latitude / DEGREE;
    try {
      const there = proj4.transform(world, plane as unknown as typeof world, from, false);
      if (!there) return;
      out[offset] = there.x * metresPerUnit;
      out[offset + 1] = there.y * metresPerUnit;
    } catch {
      // proj4js throws where a projection has no such place.
    }
  };
}

function openPlane(code: string, definition: string | object): Projection {
  try {
    // proj4js writes into what it is given.
    const own = typeof definition === "string" ? definition : { ...definition };
    return new proj4.Proj(own as string) as unknown as Projection;
  } catch (thrown) {
    throw new CrsError({
      code: "CRS_UNSUPPORTED",
      file: code,
      cause: `proj4js cannot read the projection (${thrown instanceof Error ? thrown.message : thrown})`,
      fix: "register the projection with proj4.defs, or show the map in another one",
    });
  }
}

/** Metres within which two projections are one: false eastings in feet are written as rounded metres. */
const SAME_PLACE = 1e-5;
/** Relative difference of units and shifts, and difference of squared eccentricities: GRS 80 and WGS 84 differ by 3e-11. */
const SAME_NUMBER = 1e-9;
const SAME_SHAPE = 1e-12;

/**
 * Whether the plane of a map is the data set's own, however the two are written: both projections are of one ellipsoid
 * and lead to the same coordinates at the corners and the middle of a rectangle, in the same unit, and nothing says that
 * their datums differ. Two shifts to WGS 84 that differ do say so, unless the codes are equal; one text that names a
 * shift and one that names none do not.
 *
 * @param rectangle of the data set, source units
 */
export function isOwnPlane(
  crs: Pick<Crs, "proj4" | "horizontalUnit" | "code">,
  { code, definition }: Pick<MapPlane, "code" | "definition">,
  { minX, minY, maxX, maxY }: Rectangle,
): boolean {
  if (/\+proj=geocent\b/.test(crs.proj4)) return false;
  const source = open(crs.proj4);
  const plane: Projection & { readonly to_meter?: number } = openPlane(code, definition);
  const angular = plane.projName === "longlat";
  const unit = angular ? DEGREE : (plane.to_meter ?? 1);
  const { size } = crs.horizontalUnit;
  if (angular !== (source.projName === "longlat") || Math.abs(size / unit - 1) > SAME_NUMBER) return false;
  if (Math.abs(source.a - plane.a) > SAME_PLACE || Math.abs(source.es - plane.es) > SAME_SHAPE) return false;
  if (crs.code?.split("+")[0] !== code && haveOtherShifts(source, plane)) return false;
  const meridian = plane.from_greenwich ?? 0;
  if (angular) return meridian === (source.from_greenwich ?? 0);
  const inverse = inverseOf(source, size);
  const place = new Float64Array(2);
  return corners(minX, minY, maxX, maxY).every(([x, y]) => {
    inverse(x, y, place, 0);
    const back = plane.forward({ x: place[0] - meridian, y: place[1] });
    return back && Math.hypot(back.x - x * size, back.y - y * size) <= SAME_PLACE;
  });
}

/** Whether two projections both name a shift to WGS 84, and not the same one. */
function haveOtherShifts(one: Projection, other: Projection): boolean {
  const [a, b] = [one, other].map(({ datum: { datum_type: type, datum_params: numbers = [] } }) => {
    const named = type === THREE_PARAMETERS || type === SEVEN_PARAMETERS;
    // A shift of three numbers has no rotations and no scale.
    return NO_SHIFT.map((nothing, at) => Number((named ? numbers[at] : undefined) ?? nothing));
  });
  const differ = (x: readonly number[], y: readonly number[]) =>
    x.some((value, at) => Math.abs(value - y[at]) > SAME_NUMBER * Math.max(1, Math.abs(value)));
  return differ(a, NO_SHIFT) && differ(b, NO_SHIFT) && differ(a, b);
}

/** Translations, rotations and scale as proj4js has them. */
const NO_SHIFT = [0, 0, 0, 0, 0, 0, 1];

/**
 * The map of a data set to the plane of a map, from that to ECEF.
 *
 * @param middle middle height of the data set, source units
 * @param verticalUnit metres per source unit of z
 * @throws CrsError CRS_UNSUPPORTED where proj4js does not know the projection
 */
export function truthOnMap(
  truth: Truth,
  plane: MapPlane,
  middle: number,
  verticalUnit: number,
  file: string,
): Truth {
  return truthToPlane(truth, plane, planeTransform(plane), middle, verticalUnit, file);
}
