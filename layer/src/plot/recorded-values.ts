import { ecefToGeodetic } from "@groma/georef";
import type { ProfilePoints } from "../tools/cut/profile.js";
import { exactValue } from "../workers/index.js";
import type { PlottedCloud } from "./section-vertices.js";

/** Attributes that a filter may ask for without naming a range of them. */
const ALWAYS = ["classification", "returnNumber", "numberOfReturns"];

/**
 * Exact values of one point, by attribute: those that filters ask for.
 * @param names of further attributes; `elevation` and `ellipsoidalHeight` are those that layers add
 */
export function recordedValues(
  cloud: PlottedCloud,
  { batch: { records, inside } }: ProfilePoints,
  index: number,
  names: readonly string[],
): Readonly<Record<string, number>> {
  const asked = [...ALWAYS, ...names];
  const point = inside[index];
  const values = records.attributes
    .filter(({ name }) => asked.includes(name))
    .map((attribute) => [attribute.name, Number(exactValue(attribute, point, 0))] as const);
  const [x, y, z] = [0, 1, 2].map(
    (axis) => records.xyz[3 * point + axis] * cloud.scale[axis] + cloud.offset[axis],
  );
  const own: [string, number][] = [["elevation", z]];
  if (names.includes("ellipsoidalHeight")) {
    const geodetic = new Float64Array(3);
    const [px, py, pz] = cloud.place(x, y, z);
    ecefToGeodetic(px, py, pz, geodetic);
    own.push(["ellipsoidalHeight", geodetic[2]]);
  }
  return Object.fromEntries([...values, ...own]);
}
