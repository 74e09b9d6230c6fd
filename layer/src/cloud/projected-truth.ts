import { isOwnPlane, truthOnMap } from "@groma/georef";
import type { SourceBox } from "../sources/contract/point-source.js";
import {
  middleLongitude,
  type PlaceableData,
  type PlaneOfMap,
  planeOf,
  type TruthInPlane,
} from "./map-truth.js";

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
  const [minX, minY] = boundingBox.min;
  const [maxX, maxY] = boundingBox.max;
  const body = spec.similarity !== undefined;
  const own = !body && isOwnPlane(crs, projection, { minX, minY, maxX, maxY });
  const plane = { ...planeOf(projection), middle: middleLongitude(truth, boundingBox), own };
  const [low, high] = spec.heights;
  return { plane, onMap: truthOnMap(truth, plane, (low + high) / 2, crs.verticalUnit.size, file) };
}
