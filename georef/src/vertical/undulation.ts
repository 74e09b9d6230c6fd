import { bilinear } from "../grid/surface.js";
import type { GridWindow } from "../grid/window.js";

/**
 * Height of the geoid above the ellipsoid, metres: ellipsoidal height = height above the geoid + undulation. NaN where the
 * window has no data. Longitude and latitude in radians, any turn.
 */
export type Undulation = (longitude: number, latitude: number) => number;

/** The geoid of a window, interpolated bilinearly as PROJ's vgridshift does. */
export function undulationOf(window: GridWindow): Undulation {
  const surface = bilinear(window, "renormalised");
  const out = new Float64Array(3 * window.channels);
  return (longitude, latitude) => {
    surface(longitude, latitude, out);
    return out[0];
  };
}
