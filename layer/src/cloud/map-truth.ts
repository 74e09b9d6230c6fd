import {
  type Crs,
  ecefToGeodetic,
  isOwnPlane,
  type MapPlane,
  pointTransform,
  type Truth,
  truthOnMap,
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

/**
 * The map of a data set to the plane of a projection, by proj4js.
 * @param file name for error messages
 * @throws CrsError CRS_UNSUPPORTED where proj4js does not know the projection
 */
export function truthInPlane(
  projection: PlaneOfMap,
  { truth, spec, crs }: PlaceableData,
  boundingBox: SourceBox,
  file: string,
): TruthInPlane {
  const { code, definition, metresPerUnit, wraps } = projection;
  const { min, max } = boundingBox;
  const [x, y, z] = [0, 1, 2].map((axis) => (min[axis] + max[axis]) / 2);
  const place = new Float64Array(3);
  pointTransform(truth)(x, y, z, place, 0);
  ecefToGeodetic(place[0], place[1], place[2], place);
  const middle = Number.isFinite(place[0]) ? place[0] : 0;
  const box = { minX: min[0], minY: min[1], maxX: max[0], maxY: max[1] };
  const body = spec.similarity !== undefined;
  const own = !body && isOwnPlane(crs, { code, definition }, box);
  const plane = { code, definition, metresPerUnit, wraps, middle, own };
  const [low, high] = spec.heights;
  return { plane, onMap: truthOnMap(truth, plane, (low + high) / 2, crs.verticalUnit.size, file) };
}
