import proj4 from "proj4";
import type { Plane } from "./index.js";

const DEGREE = Math.PI / 180;

/** Planes that links are tested in, by proj4: conformal and not, round the world, round both poles, and local. */
export const PLANES: ReadonlyMap<string, Plane> = new Map(
  (
    [
      ["Mercator", "EPSG:3857", 2 * Math.PI * 6378137],
      ["degrees", "EPSG:4326", 360],
      ["UTM", "+proj=utm +zone=32 +datum=WGS84 +units=m", undefined],
      [
        "arctic",
        "+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m",
        undefined,
      ],
      [
        "antarctic",
        "+proj=stere +lat_0=-90 +lat_ts=-71 +lon_0=0 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m",
        undefined,
      ],
      ["equal area", "+proj=laea +lat_0=52 +lon_0=10 +x_0=0 +y_0=0 +ellps=WGS84 +units=us-ft", undefined],
    ] as const
  ).map(([name, definition, worldWidth]) => [name, planeOf(definition, worldWidth)]),
);

function planeOf(definition: string, worldWidth: number | undefined): Plane {
  const { forward, inverse } = proj4("EPSG:4326", definition);
  return {
    worldWidth,
    forward(longitude, latitude) {
      const [x, y] = forward([longitude / DEGREE, latitude / DEGREE]);
      return [x, y];
    },
    inverse(x, y) {
      const [longitude, latitude] = inverse([x, y]);
      return [longitude * DEGREE, latitude * DEGREE];
    },
  };
}
