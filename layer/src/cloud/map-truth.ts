import {
  type Crs,
  ecefToGeodetic,
  type MapPlane,
  pointTransform,
  type Truth,
  truthOnWebMercator,
} from "@groma/georef";
import type { SourceBox } from "../sources/contract/point-source.js";
import type { DataSetSpec } from "../workers/index.js";

/** The plane of a map, for any data set. */
export type PlaneOfMap = Pick<MapPlane, "code" | "definition" | "metresPerUnit" | "wraps">;

/** Where a data set is, as far as its place on a map follows from that. */
export interface PlaceableData {
  /** Source coordinates → ECEF. */
  readonly truth: Truth;
  /** How it is placed on the globe. */
  readonly spec: DataSetSpec;
  readonly crs: Crs;
}

/** Source coordinates → the plane of a projection, and what there is to know of that plane. */
export interface TruthInPlane {
  readonly plane: MapPlane;
  readonly onMap: Truth;
}

/** A projection that is not Mercator's: its plane is never that of Web Mercator. */
const ANOTHER = /\+proj=(?!merc\b|webmerc\b)\w/;

/**
 * The map of a data set to the plane of Web Mercator, without proj4js.
 * @param file name for error messages
 * @returns undefined for other planes, and where it may be the data set's own
 */
export function truthInWebMercator(
  projection: PlaneOfMap,
  { truth, spec, crs }: PlaceableData,
  boundingBox: SourceBox,
  file: string,
): TruthInPlane | undefined {
  if (spec.similarity === undefined && !ANOTHER.test(crs.proj4)) return undefined;
  const plane = { ...planeOf(projection), middle: middleLongitude(truth, boundingBox), own: false };
  const [low, high] = spec.heights;
  const onMap = truthOnWebMercator(truth, plane, (low + high) / 2, crs.verticalUnit.size, file);
  return onMap && { plane, onMap };
}

/** What of a projection is plain data of its plane. */
export function planeOf({ code, definition, metresPerUnit, wraps }: PlaneOfMap): PlaneOfMap {
  return { code, definition, metresPerUnit, wraps };
}

/** Longitude of the middle of a data set, radians; 0 where it has no place. */
export function middleLongitude(truth: Truth, { min, max }: SourceBox): number {
  const [x, y, z] = [0, 1, 2].map((axis) => (min[axis] + max[axis]) / 2);
  const place = new Float64Array(3);
  pointTransform(truth)(x, y, z, place, 0);
  ecefToGeodetic(place[0], place[1], place[2], place);
  return Number.isFinite(place[0]) ? place[0] : 0;
}
