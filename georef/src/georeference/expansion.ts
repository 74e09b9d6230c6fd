import { CHEBYSHEV_NODES, chebyshevCoefficients, NODES } from "../approximation/chebyshev.js";
import type { Domain } from "../cartesian/domain.js";
import { eastNorthUp, type Frame } from "../ellipsoid/frame.js";
import type { ExactTransform } from "../engines/exact.js";
import { boundsInWords } from "../errors/coordinates.js";
import { PlacementError } from "../errors/errors.js";

/** Centre and half extents of a domain, source units; extents are never zero. */
export interface Box {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  readonly halfX: number;
  readonly halfY: number;
  readonly halfZ: number;
}

/**
 * Chebyshev expansion of the six functions over a domain, in its node frame:
 * local(u, v, w) = Σ T_k(u) T_l(v) (P_kl + w n_kl) with u, v, w from −1 to 1 over the box.
 * `coefficients[(NODES·k + l)·6 + c]`: c = 0…2 east, north, up of P, c = 3…5 of n · halfZ; metres.
 */
export interface Expansion {
  readonly box: Box;
  readonly frame: Frame;
  readonly coefficients: Float64Array;
}

/**
 * Extents below this share of the coordinate (or below 1e-9 units) are widened to it: differences that small are
 * rounding, and a domain of one point or one line has no square to fit on.
 */
const SMALLEST_EXTENT = 1e-12;

/** The box of a domain by middle and half widths, source units; never without an extent. */
export function boxOf(domain: Domain): Box {
  const middle = (from: number, to: number) => from + (to - from) / 2;
  const half = (from: number, to: number) =>
    Math.max((to - from) / 2, SMALLEST_EXTENT * Math.max(Math.abs(from), Math.abs(to)), 1e-9);
  return {
    x: middle(domain.minX, domain.maxX),
    y: middle(domain.minY, domain.maxY),
    z: middle(domain.minZ, domain.maxZ),
    halfX: half(domain.minX, domain.maxX),
    halfY: half(domain.minY, domain.maxY),
    halfZ: half(domain.minZ, domain.maxZ),
  };
}

/**
 * Samples the exact transform on the 9 × 9 Chebyshev nodes of the domain and turns the samples into coefficients.
 *
 * @param frameAt the node frame at the place of the domain's middle. Default: east-north-up
 * @throws PlacementError PLACE_DOMAIN when the domain is no box, or the transform is not finite on it
 */
export function expand(
  exact: ExactTransform,
  domain: Domain,
  file: string,
  frameAt = eastNorthUp,
): Expansion {
  const box = boxOf(domain);
  if (!isBox(domain)) throw outside(file, "the bounds of the points are not a finite box", domain);

  const sample = new Float64Array(6);
  const evaluate = (u: number, v: number) => {
    exact(box.x + box.halfX * u, box.y + box.halfY * v, sample, 0);
    if (!sample.every(Number.isFinite)) {
      throw outside(file, "some points lie outside the domain of the CRS", domain);
    }
  };
  for (const [u, v] of [
    [-1, -1],
    [1, -1],
    [-1, 1],
    [1, 1],
    [0, 0],
  ] as const)
    evaluate(u, v);
  const origin = [0, 1, 2].map((axis) => sample[axis] + box.z * sample[axis + 3]);
  const frame = frameAt(origin);

  const values = new Float64Array(NODES * NODES * 6);
  for (let i = 0; i < NODES; i++) {
    for (let j = 0; j < NODES; j++) {
      evaluate(CHEBYSHEV_NODES[i], CHEBYSHEV_NODES[j]);
      for (let axis = 0; axis < 3; axis++) {
        const east = axis * 3;
        let p = 0;
        let n = 0;
        for (let c = 0; c < 3; c++) {
          p += frame.rotation[east + c] * (sample[c] + box.z * sample[c + 3] - origin[c]);
          n += frame.rotation[east + c] * sample[c + 3];
        }
        values[(i * NODES + j) * 6 + axis] = p;
        values[(i * NODES + j) * 6 + axis + 3] = n * box.halfZ;
      }
    }
  }
  const coefficients = chebyshevCoefficients(values, 6);
  // Squares, because bounds are made of lengths.
  const finite = Number.isFinite(coefficients.reduce((sum, value) => sum + value * value, 0));
  if (!finite) throw outside(file, "the points reach farther than can be computed with", domain);
  return { box, frame, coefficients };
}

/** The expansion with a quadratic polynomial added to P: axis by axis the terms 1, u, v, u², uv, v² in its frame, metres. */
export function plusQuadratic(expansion: Expansion, terms: Float64Array): Expansion {
  const coefficients = expansion.coefficients.slice();
  for (let axis = 0; axis < 3; axis++) {
    const [one, u, v, uu, uv, vv] = terms.subarray(6 * axis, 6 * axis + 6);
    const add = (k: number, l: number, value: number) => {
      coefficients[(k * NODES + l) * 6 + axis] += value;
    };
    // u² = (T_2(u) + 1) / 2.
    add(0, 0, one + (uu + vv) / 2);
    add(1, 0, u);
    add(0, 1, v);
    add(2, 0, uu / 2);
    add(1, 1, uv);
    add(0, 2, vv / 2);
  }
  return { ...expansion, coefficients };
}

function isBox({ minX, minY, minZ, maxX, maxY, maxZ }: Domain): boolean {
  const finite = [minX, minY, minZ, maxX, maxY, maxZ].every(Number.isFinite);
  return finite && minX <= maxX && minY <= maxY && minZ <= maxZ;
}

function outside(file: string, cause: string, domain: Domain): PlacementError {
  return new PlacementError({
    code: "PLACE_DOMAIN",
    file,
    cause: `${cause} (${boundsInWords(domain)})`,
    fix: "check that the coordinate reference system is the one the scan was made in, and that no point is an outlier",
  });
}
