import { type RecordedNode, valueReader } from "../workers/index.js";
import type { PointOrigin } from "./recorded-points.js";

/** Where source coordinates are; of the three numbers written to `out` the last is the height above the ellipsoid, metres. */
export type GeodeticPlace = (x: number, y: number, z: number, out: Float64Array) => void;

/** What is known of the numbers of a node's records. */
export interface RecordNumbers {
  /** By the index of a record, in the attribute's unit; NaN where it has none. */
  readonly value: (record: number) => number;
  /** What stored integers are multiplied by; 0 of numbers that are stored as they are. */
  readonly step: number;
}

/**
 * Reads an attribute of a node's records, or one of the heights that layers add to them: `elevation`, the z of the source, and
 * `ellipsoidalHeight`, metres.
 * @param geodetic undefined where places are not known: there are no heights above the ellipsoid then
 * @returns undefined where there is none of that name
 */
export function recordNumbers(
  name: string,
  { xyz, attributes }: RecordedNode,
  { scale, offset }: Pick<PointOrigin, "scale" | "offset">,
  geodetic: GeodeticPlace | undefined,
): RecordNumbers | undefined {
  const axis = (record: number, which: number) => xyz[3 * record + which] * scale[which] + offset[which];
  if (name === "elevation") return { value: (record) => axis(record, 2), step: scale[2] };
  if (name === "ellipsoidalHeight") {
    if (!geodetic) return undefined;
    const place = new Float64Array(3);
    const value = (record: number) => {
      geodetic(axis(record, 0), axis(record, 1), axis(record, 2), place);
      return place[2];
    };
    return { value, step: 0 };
  }
  const found = attributes.find((attribute) => attribute.name === name);
  if (!found) return undefined;
  return { value: valueReader(found), step: found.type.startsWith("float") ? 0 : (found.scale[0] ?? 1) };
}
