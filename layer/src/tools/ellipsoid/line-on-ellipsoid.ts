import { type LocalPlane, localPlane } from "@groma/georef";

/** A line in a plane of the ellipsoid about its middle. */
export interface LineOnEllipsoid {
  readonly plane: LocalPlane;
  /** Longitude and latitude about which the plane lies, radians. */
  readonly middle: readonly [number, number];
  /** x and y of each vertex, metres. */
  readonly vertices: readonly (readonly [number, number])[];
}

/**
 * Lays a line into the transverse Mercator plane of WGS 84 about the mean of its vertices.
 * @param line longitude and latitude of each vertex, radians; it takes the shorter way across 180°
 */
export function lineOnEllipsoid(line: readonly (readonly [number, number])[]): LineOnEllipsoid {
  const first = line[0]?.[0] ?? 0;
  const turned = (longitude: number) =>
    longitude - 2 * Math.PI * Math.round((longitude - first) / (2 * Math.PI));
  const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const middle = [
    mean(line.map(([longitude]) => turned(longitude))),
    mean(line.map(([, latitude]) => latitude)),
  ] as const;
  const plane = localPlane(...middle);
  const place = new Float64Array(2);
  const vertices = line.map(([longitude, latitude]) => {
    plane.toPlane(longitude, latitude, place);
    return [place[0], place[1]] as const;
  });
  return { plane, middle, vertices };
}
