import type { Vector } from "@groma/georef";
import { axesAt, combined } from "../vertex/axes.js";
import { commonGrid, convergenceAt, type Grid, geodesicOfGrid, turn } from "../vertex/grid.js";
import type { Vertex } from "../vertex/vertex.js";
import { ANY_DIRECTION, acrossError, directionTerm } from "../worth/near-noise.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, type QuantityOptions, quantity, type Sensitivity } from "../worth/quantity.js";
import { heightDifference } from "./distance.js";
import {
  azimuthTerm,
  ends,
  isOneFoot,
  type Line,
  levelComponents,
  levelTerm,
  lineOf,
  raised,
  scaled,
  spaceComponents,
  verticalSensitivity,
} from "./line.js";

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
    forward: directionOf(positive(azimuthFrom), azimuthTerm(line, "a", options), options),
    back: directionOf(positive(azimuthTo + Math.PI), azimuthTerm(line, "b", options), options),
    ...(grid && { grid: gridBearing(grid, line, options) }),
    ...(slope && { slope }),
  };
}

function gridBearing(grid: Grid, line: Line, options: WorthOptions): GridBearing | undefined {
  const [a, b] = [line.a.source!, line.b.source!];
  if (a[0] === b[0] && a[1] === b[1]) return undefined;
  const bearing = Math.atan2(b[0] - a[0], b[1] - a[1]);
  const convergence = convergenceAt(grid, a);
  const ofRecords: QuantityOptions = { ...options, ofRecords: true };
  const azimuth = geodesicOfGrid(grid, a, b).azimuthFrom;
  return {
    name: grid.name,
    bearing: directionOf(positive(bearing), azimuthTerm(line, "a", ofRecords), ofRecords),
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
  const turning = ends(line, gradient(a, geodesic.azimuthFrom, -1), gradient(b, geodesic.azimuthTo, 1));
  const tilting = directionTerm(space, turning, () => spaceComponents(line), options);
  if (!tilting) return directionOf(slope, undefined, options);
  // Near the vertical the level part is a length that may be noise.
  const part = levelTerm(line, options);
  const alone = part.sensitivities.length === 1;
  const lists = alone
    ? [tilting]
    : [...levelComponents(line, sin), ...verticalSensitivity(line).map((list) => scaledList(list, cos))];
  const own = acrossError(Math.abs(sin) * part.across);
  return quantity(slope, "rad", lists, { ...options, own });
}

/** A direction with its worth: half a turn where it may be any. */
export function directionOf(
  value: number,
  turning: readonly Sensitivity[] | undefined,
  options: QuantityOptions,
): Quantity<"rad"> {
  return turning
    ? quantity(value, "rad", [turning], options)
    : quantity(value, "rad", [], { ...options, own: ANY_DIRECTION });
}

function scaledList(list: readonly Sensitivity[], factor: number): Sensitivity[] {
  return list.map(({ vertex, gradient }) => ({ vertex, gradient: scaled(gradient, factor) }));
}

/** An azimuth as 0 … 2π. */
function positive(angle: number): number {
  const turned = angle % (2 * Math.PI);
  return turned < 0 ? turned + 2 * Math.PI : turned;
}
