import type { Domain } from "../cartesian/domain.js";
import type { AreaOfUse } from "../crs/area-of-use.js";
import type { Crs, Unit } from "../crs/crs.js";
import { accuracyIn } from "../crs/shift-worth.js";
import { ecefToGeodetic } from "../ellipsoid/ecef-to-geodetic.js";
import { pointTransform, type Truth } from "../engines/truth.js";
import type { Bounds } from "../grid/window.js";

/** Points along each side; between two of them a side bends by less than the margin for anything that is a scan. */
const SIDE = 17;
/** Radians; about 12 m. */
const MARGIN = 2e-6;
/** Share of the extent. */
const RELATIVE_MARGIN = 0.01;

const TURN = 2 * Math.PI;

/**
 * The bounds of the points of a data set and one step of their integers around, in source units: whoever asks for a surveyed
 * point of a scan asks with the digits that rounding to the steps has taken. No latitude goes beyond a pole by that.
 *
 * @param scale LAS scale factors, source units
 * @param unit of x and y
 */
export function domainAround(
  { min, max }: { readonly min: ArrayLike<number>; readonly max: ArrayLike<number> },
  scale: ArrayLike<number>,
  unit: Unit,
): Domain {
  const pole = unit.kind === "angular" ? Math.PI / 2 / unit.size : Number.POSITIVE_INFINITY;
  return {
    minX: min[0] - scale[0],
    minY: Math.max(min[1] - scale[1], Math.min(min[1], -pole)),
    minZ: min[2] - scale[2],
    maxX: max[0] + scale[0],
    maxY: Math.min(max[1] + scale[1], Math.max(max[1], pole)),
    maxZ: max[2] + scale[2],
  };
}

/** x, y, z on a raster over a domain, edges included, at its lowest and highest z. */
export function spread({ minX, minY, minZ, maxX, maxY, maxZ }: Domain): Float64Array {
  const points = new Float64Array(3 * 2 * SIDE * SIDE);
  let at = 0;
  for (const z of [minZ, maxZ]) {
    for (let i = 0; i < SIDE; i++) {
      for (let j = 0; j < SIDE; j++) {
        points[at++] = between(minX, maxX, i / (SIDE - 1));
        points[at++] = between(minY, maxY, j / (SIDE - 1));
        points[at++] = z;
      }
    }
  }
  return points;
}

function between(from: number, to: number, share: number): number {
  return from * (1 - share) + to * share;
}

/**
 * Bounds of longitude, latitude, height triples (radians) of the points of {@link spread}, those that are not finite left out;
 * widened by a margin. Longitudes are taken on the turn nearest to the middle point's; around a pole they are all there are.
 *
 * @returns nothing when no point is finite
 */
export function boundsOfPlaces(places: Float64Array): Bounds | undefined {
  const middle = middleLongitude(places);
  if (middle === undefined) return undefined;
  let [west, south, east, north] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < places.length; i += 3) {
    if (!Number.isFinite(places[i]) || !Number.isFinite(places[i + 1])) continue;
    const longitude = places[i] - TURN * Math.round((places[i] - middle) / TURN);
    west = Math.min(west, longitude);
    east = Math.max(east, longitude);
    south = Math.min(south, places[i + 1]);
    north = Math.max(north, places[i + 1]);
  }
  if (turnsAround(places) !== 0) {
    const [pole, other] = Math.abs(north) > Math.abs(south) ? [Math.PI / 2, south] : [north, -Math.PI / 2];
    const y = MARGIN + RELATIVE_MARGIN * (north - south);
    return {
      ...{ west: middle - Math.PI - MARGIN, east: middle + Math.PI + MARGIN },
      south: Math.max(-Math.PI / 2, Math.min(pole, other) - y),
      north: Math.min(Math.PI / 2, Math.max(pole, other) + y),
    };
  }
  // What lies between two points of the raster may be missing from a whole turn.
  if (east - west > TURN * (1 - 2 / SIDE)) {
    west = middle - Math.PI - MARGIN;
    east = middle + Math.PI + MARGIN;
  }
  const x = MARGIN / Math.max(0.01, Math.cos((south + north) / 2)) + RELATIVE_MARGIN * (east - west);
  const y = MARGIN + RELATIVE_MARGIN * (north - south);
  return {
    west: west - x,
    south: Math.max(-Math.PI / 2, south - y),
    east: east + x,
    north: Math.min(Math.PI / 2, north + y),
  };
}

/** The area that a domain covers on the earth, degrees; undefined where none of it has a place. */
export function areaOfDomain(truth: Truth, domain: Domain): AreaOfUse | undefined {
  const evaluate = pointTransform(truth);
  const points = spread(domain);
  const ecef = new Float64Array(3);
  for (let i = 0; i < points.length; i += 3) {
    evaluate(points[i], points[i + 1], points[i + 2], ecef, 0);
    ecefToGeodetic(ecef[0], ecef[1], ecef[2], points, i);
  }
  const bounds = boundsOfPlaces(points);
  if (!bounds) return undefined;
  const { west, south, east, north } = bounds;
  const degrees = (radians: number) => (radians * 180) / Math.PI;
  const turned = (radians: number) => degrees(radians - TURN * Math.round(radians / TURN));
  const around = east - west >= TURN;
  return [around ? -180 : turned(west), degrees(south), around ? 180 : turned(east), degrees(north)];
}

/** A CRS whose way to WGS 84 is said to be worth what it is in the area of a data set, and not in all of its datum's. */
export function withWorthThere<T extends Pick<Crs, "datum">>(crs: T, truth: Truth, domain: Domain): T {
  const { datum } = crs;
  if (datum?.datum === undefined) return crs;
  return { ...crs, datum: { ...datum, accuracy: accuracyIn(datum, areaOfDomain(truth, domain)) } };
}

/** How many times longitude goes round along the edge of the raster: not at all, unless it lies around a pole. */
function turnsAround(places: Float64Array): number {
  const last = SIDE - 1;
  const at = (i: number, j: number) => places[3 * (i * SIDE + j)];
  const ring: number[] = [];
  for (let t = 0; t < last; t++) ring.push(at(t, 0));
  for (let t = 0; t < last; t++) ring.push(at(last, t));
  for (let t = last; t > 0; t--) ring.push(at(t, last));
  for (let t = last; t > 0; t--) ring.push(at(0, t));
  let sum = 0;
  for (const [i, longitude] of ring.entries()) {
    const step = ring[(i + 1) % ring.length] - longitude;
    sum += step - TURN * Math.round(step / TURN);
  }
  return Math.round(sum / TURN) || 0;
}

function middleLongitude(places: Float64Array): number | undefined {
  const count = places.length / 3;
  for (let i = 0; i < count; i++) {
    const longitude = places[3 * ((i + Math.floor(count / 4)) % count)];
    if (Number.isFinite(longitude)) return longitude;
  }
  return undefined;
}
