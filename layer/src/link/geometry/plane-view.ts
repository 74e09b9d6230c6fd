import { eastNorthUp, ecefToGeodetic, geodeticToEcef, pointOf, type Vector } from "@groma/georef";

/** The plane of a map, in units of its projection. */
export interface Plane {
  /** x and y of a place in radians on WGS 84. */
  forward(longitude: number, latitude: number): readonly [number, number];
  /** Longitude and latitude, radians. */
  inverse(x: number, y: number): readonly [number, number];
  /** Width of the world where it repeats. */
  readonly worldWidth: number | undefined;
  /** Least and greatest y of such a world. */
  readonly limits?: readonly [number, number] | undefined;
}

/** A view of a map, as OpenLayers has it. */
export interface MapView {
  readonly center: readonly [number, number];
  /** Units of the projection per CSS pixel. */
  readonly resolution: number;
  /** Radians clockwise by which the map is turned. */
  readonly rotation: number;
}

/** What map and globe have in common of their views. */
export interface GroundView {
  /** The place in the middle, ECEF, metres. */
  readonly place: Vector;
  /** Azimuth of the upper edge there, radians clockwise from north. */
  readonly heading: number;
  /** Metres of ground per CSS pixel in the middle, across the line of sight. */
  readonly metresPerPixel: number;
}

/**
 * Units of the map per metre above which a place is none to show, as the pole in Mercator's projection, or the far one in a
 * polar projection: a degree from that there are 1e4.
 */
const GREATEST_SCALE = 1e4;

/** Metres to either side over which the plane's scale and turn are taken. */
const REACH = 10;

/** Units of the map that a metre to the east and one to the north are, at a place: the columns of the derivative. */
interface Derivative {
  readonly east: readonly [number, number];
  readonly north: readonly [number, number];
}

/**
 * The derivative of the plane at a place, by central differences in ECEF: meridians that meet at a pole, and longitudes
 * that jump at 180°, make no difference to it.
 */
function derivativeAt(plane: Plane, place: Vector): Derivative {
  const frame = eastNorthUp(place);
  const at = (east: number, north: number) => {
    const [longitude, latitude] = geodeticOf(pointOf(frame, east, north, 0));
    return plane.forward(longitude, latitude);
  };
  const between = (
    [x1, y1]: readonly [number, number],
    [x2, y2]: readonly [number, number],
  ): [number, number] => [unwrapped(x2 - x1, plane.worldWidth) / (2 * REACH), (y2 - y1) / (2 * REACH)];
  return { east: between(at(-REACH, 0), at(REACH, 0)), north: between(at(0, -REACH), at(0, REACH)) };
}

/**
 * The map's view for what the globe shows. The plane need not be conformal: a pixel of the map covers as much ground as
 * one in the middle of the globe's picture, and the upper edge is where the globe's is.
 * @param near x of a place in the world to show, where the world repeats
 * @returns undefined where the place has none on the map
 */
export function toMapView(plane: Plane, ground: GroundView, near = 0): MapView | undefined {
  const { place, heading, metresPerPixel } = ground;
  const { east, north } = derivativeAt(plane, place);
  const [longitude, latitude] = geodeticOf(place);
  const [x, y] = plane.forward(longitude, latitude);
  const [sine, cosine] = [Math.sin(heading), Math.cos(heading)];
  const [upX, upY] = [sine * east[0] + cosine * north[0], sine * east[1] + cosine * north[1]];
  const scale = scaleOf({ east, north });
  const resolution = metresPerPixel * scale;
  const rotation = Math.atan2(-upX, upY);
  if (![x, y, resolution, rotation].every(Number.isFinite) || resolution <= 0) return undefined;
  if (scale > GREATEST_SCALE || (plane.limits && !(plane.limits[0] <= y && y <= plane.limits[1])))
    return undefined;
  return { center: [near + unwrapped(x - near, plane.worldWidth), y], resolution, rotation };
}

/**
 * What the globe is to show for a map's view.
 * @param height of the place in the middle above WGS 84, metres
 * @returns undefined where the middle of the map is no place of the earth
 */
export function toGroundView(plane: Plane, view: MapView, height: number): GroundView | undefined {
  const place = placeOn(plane, view.center, height);
  if (!place) return undefined;
  const derivative = derivativeAt(plane, place);
  const { east, north } = derivative;
  const [upX, upY] = [-Math.sin(view.rotation), Math.cos(view.rotation)];
  // Its inverse times the map's upward direction; the determinant's sign alone matters to the azimuth.
  const sign = Math.sign(east[0] * north[1] - east[1] * north[0]);
  const heading = Math.atan2(
    sign * (north[1] * upX - north[0] * upY),
    sign * (east[0] * upY - east[1] * upX),
  );
  const metresPerPixel = view.resolution / scaleOf(derivative);
  if (![heading, metresPerPixel].every(Number.isFinite) || metresPerPixel <= 0) return undefined;
  return { place, heading, metresPerPixel };
}

/** A place of the map in ECEF; undefined where it is none. @param height metres above WGS 84 */
export function placeOn(plane: Plane, [x, y]: readonly number[], height: number): Vector | undefined {
  const [longitude, latitude] = plane.inverse(x, y);
  if (!Number.isFinite(longitude) || !(Math.abs(latitude) <= Math.PI / 2)) return undefined;
  const place = new Float64Array(3);
  geodeticToEcef(longitude, latitude, height, place);
  return [place[0], place[1], place[2]];
}

/** Longitude, latitude (radians) and height (metres) of a place of ECEF. */
export function geodeticOf([x, y, z]: Vector): Vector {
  const out = new Float64Array(3);
  ecefToGeodetic(x, y, z, out);
  return [out[0], out[1], out[2]];
}

/** A difference of two x, the short way round the world. */
export function unwrapped(difference: number, worldWidth: number | undefined): number {
  return worldWidth ? difference - worldWidth * Math.round(difference / worldWidth) : difference;
}

/** Units of the map per metre: the root of the area that a square metre has there. */
function scaleOf({ east, north }: Derivative): number {
  return Math.sqrt(Math.abs(east[0] * north[1] - east[1] * north[0]));
}
