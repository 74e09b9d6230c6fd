import { type LocalPlane, localPlane, PlacementError } from "@groma/georef";

/** Metres from the middle of the plane, where lengths to the side are 0.3 % too long: 1 + x² / 2R². */
const FARTHEST = 500_000;

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
 * @param file for errors
 * @throws PlacementError PLACE_LINE where a vertex lies so far from the middle that lengths in the plane mean little
 */
export function lineOnEllipsoid(line: readonly (readonly [number, number])[], file: string): LineOnEllipsoid {
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
    if (!(Math.hypot(place[0], place[1]) <= FARTHEST)) throw tooLong(file);
    return [place[0], place[1]] as const;
  });
  return { plane, middle, vertices };
}

function tooLong(file: string): PlacementError {
  const cause = `the line reaches farther than ${FARTHEST / 1000} km from its middle`;
  return new PlacementError({
    ...{ code: "PLACE_LINE", file, cause },
    fix: "give shorter lines, each with a plane of its own",
  });
}
