import proj4 from "proj4";

/** A plane in metres that touches the ellipsoid along a meridian. */
export interface LocalPlane {
  /**
   * @param longitude WGS 84, radians
   * @param latitude radians
   * @param out receives x (east) and y (north), metres; NaN where the plane has no such place
   */
  toPlane(longitude: number, latitude: number, out: Float64Array): void;
  /** The way back, radians. */
  toGeodetic(x: number, y: number, out: Float64Array): void;
}

/**
 * The transverse Mercator plane of WGS 84 about a place, with the scale 1 on its meridian: lengths in it are those on the
 * ellipsoid to 1 + x² / 2R², which is 3 · 10⁻⁵ at 50 km to the side (Karney, "Transverse Mercator with an accuracy of a few nanometers",
 * J. Geodesy 85 (2011) 475–485, for its accuracy).
 *
 * @param longitude of the middle, radians
 * @param latitude radians
 */
export function localPlane(longitude: number, latitude: number): LocalPlane {
  const degrees = (angle: number) => (angle * 180) / Math.PI;
  const text = `+proj=tmerc +lat_0=${degrees(latitude)} +lon_0=${degrees(longitude)} +k=1 +x_0=0 +y_0=0 +a=6378137 +rf=298.257223563 +units=m +no_defs`;
  const plane = proj4(text);
  const place = { x: 0, y: 0 };
  return {
    toPlane(long, lat, out) {
      if (!Number.isFinite(long + lat)) {
        out[0] = Number.NaN;
        out[1] = Number.NaN;
        return;
      }
      place.x = degrees(long);
      place.y = degrees(lat);
      const { x, y } = plane.forward(place);
      out[0] = x;
      out[1] = y;
    },
    toGeodetic(x, y, out) {
      place.x = x;
      place.y = y;
      const found = plane.inverse(place);
      out[0] = (found.x * Math.PI) / 180;
      out[1] = (found.y * Math.PI) / 180;
    },
  };
}
