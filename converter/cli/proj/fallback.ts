import {
  type Bounds,
  type Crs,
  type Domain,
  EGM96,
  ecefToGeodetic,
  exactTransform,
  fitPatchwork,
  PATCHWORK_TOLERANCE,
  type Step,
  WGS84,
} from "@groma/georef";
import proj4 from "proj4";
import { boundsOfPlaces, spread } from "./area.js";
import { EGM96_NOTE, egm96Step } from "./egm96.js";
import { helmertMap, isIdentity } from "./helmert.js";
import { type EngineOptions, type EngineResult, UNKNOWN_HEIGHT_NOTE } from "./report.js";

/** Said of every place that was found without PROJ. */
export const WITHOUT_PROJ_NOTE =
  "computed by proj4js without PROJ and its grids: where a country's datum has a shift grid, expect errors of 0.2 to 3 m in plane";

const TOWGS84 = /\s\+towgs84=(\S+)/;

/**
 * The way from source coordinates to ECEF without PROJ: proj4js's projection, the seven parameters of `crs.proj4`, and
 * EGM96 for heights above a geoid. As PROJ does for a CRS without heights of its own, the datum shift leaves heights
 * alone.
 *
 * @param domain source units
 * @throws CrsError CRS_UNSUPPORTED
 * @throws PlacementError PLACE_DOMAIN, PLACE_POLE, PLACE_ANTIMERIDIAN, PLACE_PATCHWORK
 */
export async function proj4jsTransformation(
  crs: Crs,
  domain: Domain,
  { tolerance = PATCHWORK_TOLERANCE, file = crs.name }: EngineOptions = {},
): Promise<EngineResult> {
  const sample = sampler(crs);
  const patchwork = await fitPatchwork(async (points) => sample(points), domain, tolerance, undefined, file);
  const steps: Step[] = [{ kind: "projection", patchwork }];
  if (crs.verticalUnit.size !== 1) steps.push({ kind: "height", metresPerUnit: crs.verticalUnit.size });
  const shift = datumShift(crs.proj4);
  if (shift) steps.push(shift);
  const geoid = crs.height.kind === "geoid";
  if (geoid) steps.push(await egm96Step(boundsOf(sample, domain)));
  steps.push({ kind: "geocentric", ellipsoid: { a: WGS84.a, f: WGS84.f } });

  const notes = [WITHOUT_PROJ_NOTE];
  if (geoid) notes.push(EGM96_NOTE);
  if (crs.height.kind === "unknown") notes.push(UNKNOWN_HEIGHT_NOTE);
  return {
    transformation: { steps },
    report: {
      engine: { name: "proj4js", version: proj4.version },
      operation: crs.datum?.operation ?? "datum shift of the PROJ string",
      accuracy: crs.datum?.accuracy ?? null,
      ballpark: false,
      grids: geoid ? [EGM96] : [],
      lacking: [],
      passedOver: [],
      fitBound: patchwork.bound,
      checkedPoints: 0,
      worstDifference: 0,
      notes,
    },
  };
}

/** x, y pairs to longitude, latitude pairs (radians) of the CRS's own datum. */
function sampler(crs: Crs): (points: Float64Array) => Float64Array {
  // Without a shift the geodetic coordinates count as those of WGS 84, so that they come back unchanged.
  const exact = exactTransform({ ...crs, proj4: crs.proj4.replace(TOWGS84, "") });
  const parts = new Float64Array(6);
  const place = new Float64Array(3);
  return (points) => {
    const out = new Float64Array(points.length);
    for (let i = 0; i < points.length; i += 2) {
      exact(points[i], points[i + 1], parts, 0);
      ecefToGeodetic(parts[0], parts[1], parts[2], place, 0);
      out.set(place.subarray(0, 2), i);
    }
    return out;
  };
}

function datumShift(text: string): Step | undefined {
  const [x, y, z, rx, ry, rz, s] = (TOWGS84.exec(text)?.[1] ?? "").split(",");
  const given = Object.entries({ x, y, z, rx, ry, rz, s }).filter(([, value]) => value);
  const parameters = new Map([...given, ["convention", "position_vector"]] as [string, string][]);
  const map = helmertMap({ name: "helmert", inverse: false, parameters });
  if (isIdentity(map)) return undefined;
  const number = (key: string) => Number(new RegExp(`\\+${key}=(\\S+)`).exec(text)?.[1] ?? Number.NaN);
  const a = number("a");
  const rf = number("rf");
  const f = Number.isFinite(rf) && rf !== 0 ? 1 / rf : Number.isFinite(number("b")) ? 1 - number("b") / a : 0;
  return { kind: "datumShift", from: { a, f }, to: { a: WGS84.a, f: WGS84.f }, ...map, keepHeight: true };
}

function boundsOf(sample: (points: Float64Array) => Float64Array, domain: Domain): Bounds {
  const points = spread(domain);
  const places = new Float64Array(points.length);
  for (let i = 0; i < points.length; i += 3) places.set(sample(points.slice(i, i + 2)), i);
  const bounds = boundsOfPlaces(places);
  // The fit has found a place for every point before.
  if (!bounds) throw new RangeError("no place to cut the geoid for");
  return bounds;
}
