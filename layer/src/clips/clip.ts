import type { Corner } from "./source-space.js";
import type { ClipMode } from "./volume.js";

/** A place to put a volume: geodetic, radians and metres over the ellipsoid, or source coordinates of the data set. */
export type ClipPlace =
  | { readonly longitude: number; readonly latitude: number; readonly height: number }
  | { readonly source: readonly [number, number, number] };

/** An upright or turned box. */
export interface BoxClip {
  readonly kind: "box";
  readonly mode: ClipMode;
  readonly center: ClipPlace;
  /** Width, depth and height, metres: to the east, north and up where it is not turned. */
  readonly size: readonly [number, number, number];
  /** Turn of the box about the vertical, radians clockwise from north. */
  readonly heading: number;
  /** Then about its own width axis, radians: positive lifts its northern side. */
  readonly pitch: number;
  /** Then about its own depth axis, radians: positive lowers its eastern side. */
  readonly roll: number;
}

/** All on one side of a plane. */
export interface PlaneClip {
  readonly kind: "plane";
  readonly mode: ClipMode;
  /** A place on the plane. */
  readonly through: ClipPlace;
  /** Direction to its inner side, radians clockwise from north. */
  readonly heading: number;
  /** Rise of that direction over the horizon, radians: π/2 is up. */
  readonly pitch: number;
}

/** What stands on a ring: a polygon between two heights, or without end. */
export interface PolygonClip {
  readonly kind: "polygon";
  readonly mode: ClipMode;
  /**
   * `geodetic`: corners are longitude and latitude, radians, joined by geodesics; heights are over the ellipsoid, metres.
   * `source`: corners are x and y of the data set, joined by straight lines there; heights are its z.
   */
  readonly coordinates: "geodetic" | "source";
  /** Corners in turn, the first not repeated. Where edges cross, the even-odd rule holds. */
  readonly ring: readonly Corner[];
  readonly bottom: number | undefined;
  readonly top: number | undefined;
}

/** A volume that cuts a scene or stands out in it. */
export type Clip = BoxClip | PlaneClip | PolygonClip;

/** Default mode: `inside`, only what is inside stays. */
const MODE: ClipMode = "inside";

const DEGREE = Math.PI / 180;

/** Volumes. Angles are radians, lengths metres. */
export const Clip = {
  box: (
    options: Pick<BoxClip, "center" | "size"> & Partial<Pick<BoxClip, "mode" | "heading" | "pitch" | "roll">>,
  ): BoxClip => ({ mode: MODE, heading: 0, pitch: 0, roll: 0, ...options, kind: "box" }),

  plane: (
    options: Pick<PlaneClip, "through"> & Partial<Pick<PlaneClip, "mode" | "heading" | "pitch">>,
  ): PlaneClip => ({ mode: MODE, heading: 0, pitch: 0, ...options, kind: "plane" }),

  polygon: (
    ring: readonly Corner[],
    options: Partial<Pick<PolygonClip, "mode" | "coordinates" | "bottom" | "top">> = {},
  ): PolygonClip => ({
    mode: MODE,
    coordinates: "geodetic",
    bottom: undefined,
    top: undefined,
    ...options,
    ring: unrepeated(ring),
    kind: "polygon",
  }),

  /** The same from longitudes and latitudes in degrees, as GeoJSON has them. */
  polygonFromDegrees: (
    ring: readonly Corner[],
    options: Partial<Pick<PolygonClip, "mode" | "bottom" | "top">> = {},
  ): PolygonClip =>
    Clip.polygon(
      ring.map(([longitude, latitude]) => [longitude * DEGREE, latitude * DEGREE] as const),
      options,
    ),
};

/** GeoJSON repeats the first corner at the end. */
function unrepeated(ring: readonly Corner[]): readonly Corner[] {
  const [first, last] = [ring[0], ring[ring.length - 1]];
  const closed = ring.length > 1 && first[0] === last[0] && first[1] === last[1];
  return closed ? ring.slice(0, -1) : ring;
}
