import type { Crs } from "../crs/crs.js";
import { WGS84 } from "../ellipsoid/ellipsoid.js";

/**
 * What stands in the place of a CRS where a similarity does its work: a name, and units so that lengths can be told.
 * Its PROJ string means what the similarity leads to, ECEF, and not the source coordinates.
 *
 * @param name for people: by what the data set was placed
 * @param scale metres per source unit
 */
export function localCrs(name: string, scale: number): Crs {
  const unit = { name: scale === 1 ? "metre" : "source unit", kind: "linear", size: scale } as const;
  return {
    name,
    proj4: `+proj=geocent +a=${WGS84.a} +rf=298.257223563 +units=m +no_defs`,
    horizontalUnit: unit,
    verticalUnit: { ...unit, declared: true },
    height: { kind: "ellipsoidal" },
  };
}
