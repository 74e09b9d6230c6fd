import { covariance, symmetricEigen, turnOut, type Vector } from "@groma/georef";
import type { Vertex } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity } from "../worth/quantity.js";
import { collinear, tooFew } from "./refusals.js";
import { frameOf, inFrame } from "./ring.js";

/** The plane nearest to vertices. */
export interface BestPlane {
  /** A place of it, ECEF, metres. */
  readonly centre: Vector;
  /** Unit vector of ECEF, upward. */
  readonly normal: Vector;
  /** Angle against the level, 0 … π/2 (dip). */
  readonly slope: Quantity<"rad">;
  /** Azimuth of its steepest descent (dip direction), radians 0 … 2π; undefined for a level plane. */
  readonly aspect?: number | undefined;
  /** Distance of each vertex from it, metres, positive above. */
  readonly residuals: readonly number[];
  /** Root mean square of the residuals, metres. */
  readonly deviation: number;
}

/** Spread across the line of greatest extent over that along it, below which points are one line. */
const ON_A_LINE = 1e-9;

/**
 * The plane of least squared distances (Pearson 1901).
 * @throws MeasureError MEASURE_VERTICES with fewer than three vertices, MEASURE_COLLINEAR where they lie on a line
 */
export function measurePlane(vertices: readonly Vertex[], options: WorthOptions = {}): BestPlane {
  const count = vertices.length;
  if (count < 3) throw tooFew("a plane", 3, count);
  const frame = frameOf(vertices);
  const points = inFrame(vertices, frame);
  const { mean, matrix } = covariance(points);
  const { values, vectors } = symmetricEigen(matrix);
  if (!(values[1] > ON_A_LINE ** 2 * values[2])) throw collinear("a plane");
  const side = vectors[2] < 0 ? -1 : 1;
  const normal: Vector = [side * vectors[0], side * vectors[1], side * vectors[2]];
  const residuals = vertices.map((_, i) =>
    [0, 1, 2].reduce((sum, axis) => sum + (points[3 * i + axis] - mean[axis]) * normal[axis], 0),
  );
  const level = Math.hypot(normal[0], normal[1]);
  // First-order change of the least eigenvector: towards the other two by their share in the point's place.
  const gradients = vertices.map((vertex, i) => {
    let tilt = 0;
    for (const k of [1, 2]) {
      const axis = vectors.subarray(3 * k, 3 * k + 3);
      const along = [0, 1, 2].reduce((sum, at) => sum + (points[3 * i + at] - mean[at]) * axis[at], 0);
      const downhill = level > 0 ? (normal[0] * axis[0] + normal[1] * axis[1]) / level : k - 1;
      tilt -= (along * downhill) / (count * Math.max(values[k] - values[0], Number.MIN_VALUE));
    }
    // Slope grows with the level part of the normal, which is cos(slope) of its tilt in that direction.
    const rate = tilt / Math.max(normal[2], 1e-6);
    return { vertex, gradient: turnOut(frame, normal[0] * rate, normal[1] * rate, normal[2] * rate) };
  });
  const [x, y, z] = turnOut(frame, mean[0], mean[1], mean[2]);
  const azimuth = Math.atan2(normal[0], normal[1]);
  return {
    centre: [frame.origin[0] + x, frame.origin[1] + y, frame.origin[2] + z],
    normal: turnOut(frame, ...normal),
    slope: quantity(Math.atan2(level, normal[2]), "rad", [gradients], options),
    ...(level > 1e-12 && { aspect: azimuth < 0 ? azimuth + 2 * Math.PI : azimuth }),
    residuals,
    deviation: Math.sqrt(Math.max(0, values[0])),
  };
}
