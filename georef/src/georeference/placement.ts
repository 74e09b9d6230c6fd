import type { Domain } from "../cartesian/domain.js";
import type { Frame } from "../ellipsoid/frame.js";
import type { PointTransform } from "../transformation/link.js";
import type { Creases } from "./creases.js";
import type { GridRemainder } from "./grid-remainder.js";
import type { Relief } from "./relief.js";

/**
 * How the six functions P and n are approximated over the node, cheapest first: total degrees of P and n
 * (affine 1, 0; affineLinearNormal 1, 1; quadratic 2, 1; cubic 3, 2; quartic 4, 3), degree 6 in x and y each
 * (tensor6), or not at all (exact).
 */
export type Scheme =
  | "affine"
  | "affineLinearNormal"
  | "quadratic"
  | "cubic"
  | "quartic"
  | "tensor6"
  | "exact";

/** The map source coordinates → node frame for one node, with its certificate. */
export interface Placement {
  readonly scheme: Scheme;
  /** Metres: no point of the domain, stored as float32 in the node frame, lies farther from the exact transform. */
  readonly bound: number;
  /** The part of `bound` that the approximation costs, metres; of a transformation with its patchwork. */
  readonly fitBound: number;
  /** The part of `bound` that rounding to float32 costs, metres. */
  readonly storageBound: number;
  readonly frame: Frame;
  /**
   * Power-basis coefficients in metres of the node frame; u, v, w run from −1 to 1 over the domain's x, y, z.
   * Component by component (east, north, up): all of P, then all of n · (half height). Total degrees are ordered
   * 1, u, v, u², uv, v², u³ …; tensor6 has u^k v^l at 7k + l. Empty for `exact`.
   */
  readonly coefficients: Float64Array;
  readonly domain: Domain;
  /** What grids add to the polynomials, axes of the node frame; empty unless the node crosses many lines of a grid. */
  readonly remainders: readonly GridRemainder[];
  /** The same in closed form, for a node that one or two lines cross. */
  readonly creases?: Creases;
  /** The same where it lies along up. */
  readonly relief?: Relief;
  /** The function itself, for the scheme `exact` only (so such a placement does not cross to a worker). */
  readonly exact?: PointTransform;
}
