import type { Vector } from "@groma/georef";
import { axesAt, combined } from "../vertex/axes.js";
import { commonGrid, convergenceAt, type Grid, geodesicOfGrid, turn } from "../vertex/grid.js";
import type { Vertex } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity } from "../worth/quantity.js";
import { heightDifference } from "./distance.js";
import { azimuthSensitivity, ends, isOneFoot, type Line, lineOf, raised } from "./line.js";

/** A direction in the plane of a projection. */
export interface GridBearing {
  /** Name of the coordinate system. */
  readonly name: string;
  /** Clockwise from grid north, 0 … 2π. */
  readonly bearing: Quantity<"rad">;
  /** Meridian convergence at the first point: azimuth of grid north, radians. */
  readonly convergence: number;
  /**
   * What the chord of the grid lacks to the geodesic at the first point (arc-to-chord), radians: azimuth on the grid's own
   * datum = bearing + convergence + this.
   */
  readonly arcToChord: number;
}

/** Which way it is from one vertex to another. */
export interface Direction {
  /** Azimuth of the geodesic at the first point, clockwise from north, 0 … 2π; undefined where one is above the other. */
  readonly forward?: Quantity<"rad"> | undefined;
  /** Azimuth of the way back, at the second point. */
  readonly back?: Quantity<"rad"> | undefined;
  readonly grid?: GridBearing | undefined;
  /**
   * Angle between the line and the level, positive upwards: atan of rise over level length; undefined for points in one
   * place.
   */
  readonly slope?: Quantity<"rad"> | undefined;
}

/** The directions between two points. */
export function measureDirection(a: Vertex, b: Vertex, options: WorthOptions = {}): Direction {
  const line = lineOf(a, b);
  const slope = slopeOf(line, options);
  if (isOneFoot(line)) return { ...(slope && { slope }) };
  const grid = commonGrid([a, b]);
  const { azimuthFrom, azimuthTo } = line.geodesic;
  return {
    forward: quantity(positive(azimuthFrom), "rad", azimuthSensitivity(line, "a"), options),
    back: quantity(positive(azimuthTo + Math.PI), "rad", azimuthSensitivity(line, "b"), options),
    ...(grid && { grid: gridBearing(grid, line, options) }),
    ...(slope && { slope }),
  };
}

function gridBearing(grid: Grid, line: Line, options: WorthOptions): GridBearing | undefined {
  const [a, b] = [line.a.source!, line.b.source!];
  if (a[0] === b[0] && a[1] === b[1]) return undefined;
  const bearing = Math.atan2(b[0] - a[0], b[1] - a[1]);
  const convergence = convergenceAt(grid, a);
  const azimuth = geodesicOfGrid(grid, a, b).azimuthFrom;
  return {
    name: grid.name,
    bearing: quantity(positive(bearing), "rad", azimuthSensitivity(line, "a"), {
      ...options,
      ofRecords: true,
    }),
    convergence,
    arcToChord: turn(azimuth - bearing - convergence),
  };
}

function slopeOf(line: Line, options: WorthOptions): Quantity<"rad"> | undefined {
  const { a, b, space, geodesic } = line;
  if (space === 0) return undefined;
  const { vertical } = heightDifference(line, options);
  const level = isOneFoot(line) ? 0 : geodesic.distance * raised(line);
  const slope = Math.atan2(vertical.value, level);
  const [sin, cos] = [Math.sin(slope) / space, Math.cos(slope) / space];
  const gradient = (vertex: Vertex, azimuth: number, sign: number): Vector =>
    combined(axesAt(vertex), -sign * sin * Math.sin(azimuth), -sign * sin * Math.cos(azimuth), sign * cos);
  const sensitivities = ends(line, gradient(a, geodesic.azimuthFrom, -1), gradient(b, geodesic.azimuthTo, 1));
  return quantity(slope, "rad", [sensitivities], options);
}

/** An azimuth as 0 … 2π. */
function positive(angle: number): number {
  const turned = angle % (2 * Math.PI);
  return turned < 0 ? turned + 2 * Math.PI : turned;
}
