import { requireFields } from "../errors/arguments.js";
import { PlacementError } from "../errors/errors.js";
import { along, choiceOf } from "./choice.js";
import { linksOf } from "./compile.js";
import { invert, startingPoints } from "./inverse.js";
import type { Link, PointTransform } from "./link.js";
import { domainOf, type Rectangle } from "./rectangle.js";
import type { Transformation } from "./step.js";

/** A transformation as far as points are placed by it: to ECEF, or to what stands in its place. */
export interface StepwiseTruth {
  readonly transformation: Transformation;
  /** For many points: NaN where there is no place. */
  readonly evaluate: PointTransform;
  /** What is done in place of the step to ECEF; undefined: that step. */
  readonly end?: Link | undefined;
  /** Metres of the place per metre on the ground, at most. Default: 1. */
  readonly stretch?: number;
  /** Units of the place per source unit, where x and y stay those of the source whatever the steps say. */
  readonly own?: number;
  /** The place to source coordinates, where the steps themselves can be solved for them; see {@link CompiledTransformation}. */
  readonly inverse?: CompiledTransformation["inverse"];
}

/** A transformation ready for use. */
export interface CompiledTransformation extends StepwiseTruth {
  /**
   * One point to ECEF.
   * @throws PlacementError PLACE_DOMAIN outside the data set's domain or its grids
   */
  forward(x: number, y: number, z: number, out: Float64Array, offset?: number): void;
  /**
   * d ECEF / d (x, y, z) in closed form, 9 numbers row-major, metres per source unit. On the lines of a grid, where
   * it jumps, that of the cell to the north-east.
   * @throws PlacementError PLACE_DOMAIN
   */
  jacobian(x: number, y: number, z: number, out: Float64Array): void;
  /**
   * ECEF (metres) to source coordinates: {@link forward} of the result is within 1 µm of the point.
   * @throws PlacementError PLACE_DOMAIN when no place of the domain is there
   */
  inverse(x: number, y: number, z: number, out: Float64Array, offset?: number): void;
}

/**
 * @param file name for error messages
 * @param end takes the place of the step to ECEF; then what is said of ECEF below holds for what it leads to
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function compileTransformation(
  transformation: Transformation,
  file = "points",
  end?: Link,
): CompiledTransformation {
  requireFields(transformation, { steps: "list" }, "compileTransformation: transformation");
  const state = new Float64Array(3);
  const domain = domainOf(transformation);
  const { evaluate, differentiate } = chained(linksOf(transformation, end));

  const outside = (what: string, x: number, y: number, z: number) =>
    new PlacementError({
      code: "PLACE_DOMAIN",
      file,
      cause: `${what} (${x}, ${y}, ${z}) lies outside what the georeference record of this data set covers`,
      fix: "use coordinates within the bounds of the data set, or convert it again with the points that lie there",
    });

  // Newton's iteration is for functions without jumps: it goes the ways of a choice one by one.
  const ways = choiceOf(transformation)?.ways.map((way) => chained(linksOf(along(transformation, way), end)));
  const whole = ways ?? [{ evaluate, differentiate }];
  const inverses = whole.map((way) => inverseOf(way, domain));
  const leadsTo = (point: readonly [number, number, number], out: Float64Array, offset: number) => {
    evaluate(out[offset], out[offset + 1], out[offset + 2], state, 0);
    return point.every((value, axis) => Math.abs(value - state[axis]) <= PROMISED);
  };

  return {
    transformation,
    evaluate,
    end,
    forward(x, y, z, out, offset = 0) {
      evaluate(x, y, z, out, offset);
      if (
        !(
          Number.isFinite(out[offset]) &&
          Number.isFinite(out[offset + 1]) &&
          Number.isFinite(out[offset + 2])
        )
      ) {
        throw outside("the point", x, y, z);
      }
    },
    jacobian(x, y, z, out) {
      differentiate(x, y, z, state, out);
      if (!out.every(Number.isFinite)) throw outside("the point", x, y, z);
    },
    inverse(x, y, z, out, offset = 0) {
      const point = [x, y, z] as const;
      const found = inverses.some((inverse) => {
        return inverse(point, out, offset) && (inverses.length === 1 || leadsTo(point, out, offset));
      });
      if (!found) throw outside("the place", x, y, z);
    },
  };
}

/** Metres: the inverse leads back to within so far. */
const PROMISED = 1e-6;

/** A chain of links as a function, and with its derivatives. */
interface Chain {
  readonly evaluate: PointTransform;
  differentiate(x: number, y: number, z: number, ecef: Float64Array, jacobian: Float64Array): void;
}

function chained(links: readonly Link[]): Chain {
  const state = new Float64Array(3);
  const evaluate: PointTransform = (x, y, z, out, offset) => {
    state[0] = x;
    state[1] = y;
    state[2] = z;
    for (let i = 0; i < links.length; i++) links[i].apply(state);
    out[offset] = state[0];
    out[offset + 1] = state[1];
    out[offset + 2] = state[2];
  };
  return {
    evaluate,
    differentiate(x, y, z, ecef, jacobian) {
      ecef[0] = x;
      ecef[1] = y;
      ecef[2] = z;
      jacobian.fill(0);
      jacobian[0] = jacobian[4] = jacobian[8] = 1;
      for (let i = 0; i < links.length; i++) links[i].differentiate(ecef, jacobian);
      // Next to a pole derivatives are those of a place beside it.
      evaluate(x, y, z, ecef, 0);
    },
  };
}

/** Writes source coordinates that lead to a point, and says whether there are any. */
function inverseOf({ evaluate, differentiate }: Chain, domain: Rectangle) {
  let starts: Float64Array | undefined;
  return (point: readonly [number, number, number], out: Float64Array, offset: number): boolean => {
    starts ??= startingPoints(domain, evaluate);
    return starts.length > 0 && invert(differentiate, domain, starts, point, out, offset);
  };
}
