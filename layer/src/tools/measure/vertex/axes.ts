import type { Vector } from "@groma/georef";
import type { Vertex } from "./vertex.js";

/** The directions east, north and up of a place, as unit vectors of ECEF. */
export interface Axes {
  readonly east: Vector;
  readonly north: Vector;
  readonly up: Vector;
}

const known = new WeakMap<Vertex, Axes>();

/** Axes of a vertex on WGS 84; at the poles east is that of its longitude. Worked out once. */
export function axesAt(vertex: Vertex): Axes {
  const found = known.get(vertex);
  if (found) return found;
  const { longitude, latitude } = vertex;
  const [sinLon, cosLon] = [Math.sin(longitude), Math.cos(longitude)];
  const [sinLat, cosLat] = [Math.sin(latitude), Math.cos(latitude)];
  const axes: Axes = {
    east: [-sinLon, cosLon, 0],
    north: [-sinLat * cosLon, -sinLat * sinLon, cosLat],
    up: [cosLat * cosLon, cosLat * sinLon, sinLat],
  };
  known.set(vertex, axes);
  return axes;
}

/** east · e + north · n + up · u, in ECEF. */
export function combined({ east, north, up }: Axes, e: number, n: number, u: number): Vector {
  return [
    east[0] * e + north[0] * n + up[0] * u,
    east[1] * e + north[1] * n + up[1] * u,
    east[2] * e + north[2] * n + up[2] * u,
  ];
}
