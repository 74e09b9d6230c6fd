import { covariance, symmetricEigen, turnOut, type Vector } from "@groma/georef";
import type { Vertex } from "../vertex/vertex.js";
import { acrossError, directionTerm, lengthTerm } from "../worth/near-noise.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity, type Sensitivity } from "../worth/quantity.js";
import { directionOf } from "./direction.js";
import { scaled } from "./line.js";
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
  readonly aspect?: Quantity<"rad"> | undefined;
  /** Distance of each vertex from it, metres, positive above. */
  readonly residuals: readonly number[];
  /** Root mean square of the residuals; noise of the points alone has one too. */
  readonly deviation: Quantity<"m">;
}

/** Spread across the line of greatest extent over that along it, below which points are one line. */
const ON_A_LINE = 1e-9;

/**
 * The plane of least squared distances (Pearson 1901).
 * @throws MeasureError MEASURE_VERTICES with fewer than three vertices, MEASURE_COLLINEAR where they lie on a line
 */
export function measurePlane(vertices: readonly Vertex[], options: WorthOptions = {}): BestPlane {
  if (vertices.length < 3) throw tooFew("a plane", 3, vertices.length);
  const plane = bestPlane(vertices, options);
  if (!plane) throw collinear("a plane");
  return plane;
}

/** The same; undefined where the vertices lie on a line. */
export function bestPlane(vertices: readonly Vertex[], options: WorthOptions): BestPlane | undefined {
  const count = vertices.length;
  const frame = frameOf(vertices);
  const points = inFrame(vertices, frame);
  const { mean, matrix } = covariance(points);
  const { values, vectors } = symmetricEigen(matrix);
  if (!(values[1] > ON_A_LINE ** 2 * values[2])) return undefined;
  const side = vectors[2] < 0 ? -1 : 1;
  const normal: Vector = [side * vectors[0], side * vectors[1], side * vectors[2]];
  const residuals = vertices.map((_, i) =>
    [0, 1, 2].reduce((sum, axis) => sum + (points[3 * i + axis] - mean[axis]) * normal[axis], 0),
  );
  const level = Math.hypot(normal[0], normal[1]);
  /**
   * Derivatives of what grows with the normal's motion in a direction: first-order change of the least eigenvector,
   * towards the other two by their share in the point's place.
   */
  const gradients = (towards: Vector): Sensitivity[] =>
    vertices.map((vertex, i) => {
      let rate = 0;
      for (const k of [1, 2]) {
        const axis = vectors.subarray(3 * k, 3 * k + 3);
        const along = [0, 1, 2].reduce((sum, at) => sum + (points[3 * i + at] - mean[at]) * axis[at], 0);
        const share = towards[0] * axis[0] + towards[1] * axis[1] + towards[2] * axis[2];
        rate -= (along * share) / (count * Math.max(values[k] - values[0], Number.MIN_VALUE));
      }
      return { vertex, gradient: turnOut(frame, normal[0] * rate, normal[1] * rate, normal[2] * rate) };
    });
  // Slope grows with the level part of the normal, which is cos(slope) of its tilt in that direction.
  const steeper = 1 / Math.max(normal[2], 1e-6);
  const flat = level > 0 ? [normal[0] / level, normal[1] / level] : [1, 0];
  const downhill: Vector = [flat[0] * steeper, flat[1] * steeper, 0];
  // Across the descent: where the tilt may be noise, so may its direction.
  const sideways: Vector = [flat[1], -flat[0], 0];
  const tilts = () => [gradients(downhill), gradients(sideways)];
  const tilt = Math.atan2(level, normal[2]);
  const { sensitivities, across } = lengthTerm(tilt, gradients(downhill), tilts, options);
  const turn = (): Quantity<"rad"> => {
    const around = gradients([sideways[0] / level, sideways[1] / level, 0]);
    const turned = azimuth < 0 ? azimuth + 2 * Math.PI : azimuth;
    return directionOf(turned, directionTerm(level, around, tilts, options), options);
  };
  const normalOut = turnOut(frame, ...normal);
  const [x, y, z] = turnOut(frame, mean[0], mean[1], mean[2]);
  const azimuth = Math.atan2(normal[0], normal[1]);
  return {
    centre: [frame.origin[0] + x, frame.origin[1] + y, frame.origin[2] + z],
    normal: normalOut,
    slope: quantity(tilt, "rad", sensitivities, { ...options, own: acrossError(across) }),
    ...(level > 1e-12 && { aspect: turn() }),
    residuals,
    // Of the residuals: the least eigenvalue is a difference of great numbers.
    deviation: quantity(
      Math.hypot(...residuals) / Math.sqrt(count),
      "m",
      [acrossIt(vertices, normalOut)],
      options,
    ),
  };
}

/**
 * Derivatives that bound those of a root mean square of residuals: it never changes by more than the root mean square of
 * what the points do across the plane, for which the two points farthest apart stand.
 */
function acrossIt(vertices: readonly Vertex[], normal: Vector): Sensitivity[] {
  const [first] = vertices;
  const farthest = vertices.reduce((far, one) => (apart(one, first) > apart(far, first) ? one : far));
  return [
    { vertex: first, gradient: scaled(normal, Math.SQRT1_2) },
    { vertex: farthest, gradient: scaled(normal, -Math.SQRT1_2) },
  ];
}

function apart({ ecef: a }: Vertex, { ecef: b }: Vertex): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
