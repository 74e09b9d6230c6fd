import { NODES } from "../approximation/chebyshev.js";
import type { Domain } from "../cartesian/domain.js";
import { eastNorthUp } from "../ellipsoid/frame.js";
import type { ExactTransform } from "../engines/exact.js";
import { PlacementError } from "../errors/errors.js";
import type { StepwiseTruth } from "../transformation/evaluate.js";
import { fitBound, storageBound, tailBound } from "./certificate.js";
import { QUADRATIC_TERMS, turnedCreases, turnedTerms } from "./creases.js";
import { type Expansion, expand, plusQuadratic } from "./expansion.js";
import { turned } from "./grid-remainder.js";
import { type NodeTransform, nodeTransform, ROUNDING } from "./node-transform.js";
import type { Placement } from "./placement.js";
import { reliefOf } from "./relief.js";
import {
  COSTS,
  CREASES_COST,
  FITTED_SCHEMES,
  type FittedScheme,
  keeps,
  RELIEF_COST,
  REMAINDER_COST,
  termCount,
  termIndex,
} from "./scheme.js";

/**
 * The cheapest way to place the points of a domain to a tolerance, with its certificate.
 *
 * The bound of the result is the sum of fit and float32 storage. Where storage alone reaches the tolerance (nodes
 * wider than about 20 km at 1 mm), no scheme could help: the fit is then held to the tolerance by itself and `bound`
 * says what the whole is worth.
 *
 * @param truth what the points are placed by: a function of proj4js, exactly linear in z, or a transformation with the
 *   grids of PROJ; the bound then holds against PROJ, the bound of the transformation's patchwork included
 * @param domain box of the points, source units
 * @param toleranceMetres greater than zero
 * @param file name for error messages
 * @param frameAt the frame that a node is placed in, at the place of its middle. Default: east-north-up, for ECEF;
 *   {@link levelFrame} for a map
 * @throws PlacementError PLACE_DOMAIN when the exact transform is not finite on the domain, PLACE_TOLERANCE
 */
export function fitPlacement(
  truth: ExactTransform | StepwiseTruth,
  domain: Domain,
  toleranceMetres: number,
  file = "points",
  frameAt = eastNorthUp,
): Placement {
  if (!(toleranceMetres > 0)) {
    throw new PlacementError({
      code: "PLACE_TOLERANCE",
      file,
      cause: `the tolerance ${toleranceMetres} is not a length`,
      fix: "give metres greater than zero, for example 0.001",
    });
  }
  const node = typeof truth === "function" ? withoutGrids(truth) : nodeTransform(truth, domain);
  const smooth = expand(node.smooth, domain, file, frameAt);
  const tail = tailBound(smooth);
  const { frame } = smooth;

  let cheapest: { placement: Placement; cost: number } | undefined;
  for (const { expansion, added, extra, reach, bound } of ways(node, smooth)) {
    const storage = storageBound(expansion, tail + reach);
    const allowed = storage < toleranceMetres ? toleranceMetres - storage : toleranceMetres;
    for (const scheme of FITTED_SCHEMES) {
      const cost = COSTS[scheme] + extra;
      if (cheapest && cost >= cheapest.cost) break;
      const fit = fitBound(expansion, scheme, tail) + bound;
      if (!(fit <= allowed)) continue;
      const bounds = { bound: fit + storage, fitBound: fit, storageBound: storage };
      const coefficients = powerBasis(expansion, scheme);
      cheapest = { cost, placement: { scheme, ...bounds, frame, coefficients, domain, ...added } };
      break;
    }
  }
  if (cheapest) return cheapest.placement;
  const storage = storageBound(smooth, tail);
  return {
    ...{
      scheme: "exact",
      bound: node.truthBound + storage,
      fitBound: node.truthBound,
      storageBound: storage,
    },
    ...{ frame, coefficients: new Float64Array(0), domain, remainders: [], exact: node.truth },
  };
}

/** A way to make up for what the smooth part leaves to the grids, in the node's frame. */
interface Way {
  readonly expansion: Expansion;
  readonly added: Pick<Placement, "remainders" | "creases" | "relief">;
  /** What it takes per point beside the scheme. */
  readonly extra: number;
  /** Greatest length of what is added, and how far the sum may be off before any fit, metres. */
  readonly reach: number;
  readonly bound: number;
}

/** The corrections of a node, each as it is looked up in cells and in the cheaper forms that it has. */
function ways({ corrections }: NodeTransform, smooth: Expansion): Way[] {
  const { rotation } = smooth.frame;
  return corrections.flatMap(({ remainders, unfolded, reach, bound }) => {
    const cells = remainders.map((part) => turned(part, rotation));
    const found: Way[] = [
      { expansion: smooth, added: { remainders: cells }, extra: cells.length * REMAINDER_COST, reach, bound },
    ];
    if (cells.length === 1) {
      const { relief, error } = reliefOf(cells[0]);
      const added = { remainders: [], relief };
      found.push({ expansion: smooth, added, extra: RELIEF_COST, reach, bound: bound + error });
    }
    if (unfolded) {
      const { polynomial, creases } = unfolded;
      found.push({
        expansion: plusQuadratic(smooth, turnedTerms(polynomial, QUADRATIC_TERMS, rotation)),
        added: { remainders: [], creases: turnedCreases(creases, rotation) },
        extra: CREASES_COST,
        reach: unfolded.reach,
        bound: bound + unfolded.error + unfolded.reach * ROUNDING,
      });
    }
    return found;
  });
}

function withoutGrids(exact: ExactTransform): NodeTransform {
  const parts = new Float64Array(6);
  const truth: NodeTransform["truth"] = (x, y, z, out, offset) => {
    exact(x, y, parts, 0);
    for (let axis = 0; axis < 3; axis++) out[offset + axis] = parts[axis] + z * parts[axis + 3];
  };
  return { smooth: exact, corrections: [{ remainders: [], reach: 0, bound: 0 }], truth, truthBound: 0 };
}

/** CHEBYSHEV_POWERS[k][i]: coefficient of u^i in T_k(u). */
const CHEBYSHEV_POWERS: readonly Float64Array[] = chebyshevPowers();

function chebyshevPowers(): Float64Array[] {
  const rows = Array.from({ length: NODES }, () => new Float64Array(NODES));
  rows[0][0] = 1;
  rows[1][1] = 1;
  for (let k = 2; k < NODES; k++) {
    for (let i = 0; i < NODES; i++) {
      rows[k][i] = (i > 0 ? 2 * rows[k - 1][i - 1] : 0) - rows[k - 2][i];
    }
  }
  return rows;
}

/**
 * The kept coefficients in powers of u and v, laid out as `Placement.coefficients` says. On [−1, 1] and up to degree 6
 * the change of basis loses less than two digits, which leaves nanometres.
 */
function powerBasis(expansion: Expansion, scheme: FittedScheme): Float64Array {
  const termsP = termCount(scheme, "P");
  const termsN = termCount(scheme, "n");
  const out = new Float64Array(3 * (termsP + termsN));
  for (const [part, first, shift] of [
    ["P", 0, 0],
    ["n", termsP, 3],
  ] as const) {
    for (let k = 0; k < NODES; k++) {
      for (let l = 0; l < NODES; l++) {
        if (!keeps(scheme, part, k, l)) continue;
        for (let i = k & 1; i <= k; i += 2) {
          for (let j = l & 1; j <= l; j += 2) {
            const factor = CHEBYSHEV_POWERS[k][i] * CHEBYSHEV_POWERS[l][j];
            const term = first + termIndex(scheme, part, i, j);
            for (let axis = 0; axis < 3; axis++) {
              const value = expansion.coefficients[(k * NODES + l) * 6 + shift + axis];
              out[axis * (termsP + termsN) + term] += factor * value;
            }
          }
        }
      }
    }
  }
  return out;
}
