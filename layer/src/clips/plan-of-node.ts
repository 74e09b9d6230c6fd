import { ecefToGeodetic, pointOf, type Vector, WGS84 } from "@groma/georef";
import type { ClipNode } from "./volume.js";

/**
 * The plan of a node: its points moved along their verticals into one plane, by (x / (1 + z / N), y / (1 + z / M)), where N and M
 * are the radii of curvature at the frame's origin. That is a central projection: what lies on one vertical comes to one place,
 * to H d² e² / R² for a node of half-width d and height H (4 µm at 5 km and 1 km), and edges stay straight.
 */
export interface NodePlan {
  /** 1 / (N + h) and 1 / (M + h) at the origin of the frame, per metre. */
  readonly inverseRadii: readonly [number, number];
  /** Height of the origin over the ellipsoid, metres. */
  readonly height: number;
  /** Least and greatest x and y in the plan: west, south, east, north, metres; a little more than the node. */
  readonly rectangle: readonly [number, number, number, number];
  /** Middle of the box's heights, metres in the frame. */
  readonly middle: number;
  /** Least and greatest height of the box over the origin, along the vertical of each place, metres. */
  readonly heights: readonly [number, number];
  /** Sphere around the box, ECEF, metres. */
  readonly centre: Vector;
  readonly radius: number;
}

/** The plan of a node, from its frame and the box of its points. */
export function planOf({ frame, box }: ClipNode): NodePlan {
  const geodetic = new Float64Array(3);
  ecefToGeodetic(frame.origin[0], frame.origin[1], frame.origin[2], geodetic);
  const [, latitude, height] = geodetic;
  const { a, e2 } = WGS84;
  const w = 1 - e2 * Math.sin(latitude) ** 2;
  const inverseRadii = [1 / (a / Math.sqrt(w) + height), 1 / ((a * (1 - e2)) / w ** 1.5 + height)] as const;
  const [minX, minY, minZ, maxX, maxY, maxZ] = Array.from({ length: 6 }, (_, i) => box[i]);
  const atLeast = (value: number, inverse: number) =>
    Math.min(value / (1 + minZ * inverse), value / (1 + maxZ * inverse));
  const atMost = (value: number, inverse: number) =>
    Math.max(value / (1 + minZ * inverse), value / (1 + maxZ * inverse));
  // More than what rounding to float32 and tilts of the vertical move.
  const margin = 0.01 + 1e-4 * Math.max(maxX - minX, maxY - minY, maxZ - minZ);
  const farthest = Math.max(Math.abs(minX), Math.abs(maxX)) ** 2 * inverseRadii[0];
  const sag = (farthest + Math.max(Math.abs(minY), Math.abs(maxY)) ** 2 * inverseRadii[1]) / 2;
  return {
    inverseRadii,
    height,
    rectangle: [
      atLeast(minX, inverseRadii[0]) - margin,
      atLeast(minY, inverseRadii[1]) - margin,
      atMost(maxX, inverseRadii[0]) + margin,
      atMost(maxY, inverseRadii[1]) + margin,
    ],
    middle: (minZ + maxZ) / 2,
    heights: [minZ - margin, maxZ + sag + margin],
    centre: pointOf(frame, (minX + maxX) / 2, (minY + maxY) / 2, (minZ + maxZ) / 2),
    radius: Math.hypot(maxX - minX, maxY - minY, maxZ - minZ) / 2,
  };
}

/** Place of a point of the frame in the plan. */
export function toPlan({ inverseRadii }: NodePlan, x: number, y: number, z: number): [number, number] {
  return [x / (1 + z * inverseRadii[0]), y / (1 + z * inverseRadii[1])];
}

/** Point of the frame at a height z over a place of the plan. */
export function fromPlan({ inverseRadii }: NodePlan, x: number, y: number, z: number): Vector {
  return [x * (1 + z * inverseRadii[0]), y * (1 + z * inverseRadii[1]), z];
}

/** Height of a point of the frame over its origin, along its own vertical, as the shader has it. */
export function heightIn({ inverseRadii }: NodePlan, [x, y, z]: Vector): number {
  const curvature = (inverseRadii[0] + inverseRadii[1]) / 2;
  const across = x * x * inverseRadii[0] + y * y * inverseRadii[1];
  const along = 1 + z * curvature;
  return z + across / (along + Math.sqrt(along * along + across * curvature));
}
