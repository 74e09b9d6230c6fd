import {
  type Crs,
  ecefToGeodetic,
  encodeTransformation,
  exactTransform,
  fitPatchwork,
  type Rectangle,
  WGS84,
} from "@groma/georef";

/**
 * The bytes of a transformation as a conversion writes it into record `groma` 3: the projection of a CRS of WGS 84, and
 * a geoid that stands so many metres above the ellipsoid everywhere.
 */
export async function transformationBytes(
  crs: Pick<Crs, "proj4" | "horizontalUnit" | "verticalUnit" | "height">,
  domain: Rectangle,
  undulation: number,
): Promise<Uint8Array> {
  const exact = exactTransform(crs);
  const patchwork = await fitPatchwork(async (points) => {
    const places = new Float64Array(points.length);
    const ecef = new Float64Array(6);
    const geodetic = new Float64Array(3);
    for (let i = 0; i < points.length; i += 2) {
      exact(points[i], points[i + 1], ecef, 0);
      ecefToGeodetic(ecef[0], ecef[1], ecef[2], geodetic, 0);
      places.set(geodetic.subarray(0, 2), i);
    }
    return places;
  }, domain);
  const whole = { west: -Math.PI, south: -Math.PI / 2, stepLongitude: 2 * Math.PI, stepLatitude: Math.PI };
  const values = new Float32Array(4).fill(undulation);
  const window = { grid: "flat.tif", ...whole, columns: 2, rows: 2, channels: 1, values, unit: 1 };
  return encodeTransformation({
    steps: [
      { kind: "projection", patchwork },
      { kind: "verticalShift", multiplier: 1, window },
      { kind: "geocentric", ellipsoid: { a: WGS84.a, f: WGS84.f } },
    ],
  });
}
