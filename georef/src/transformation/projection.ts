import type { Link } from "./link.js";
import { premultiply } from "./link.js";
import type { Patch, Patchwork } from "./step.js";
import { turnBackLink } from "./turned-sphere.js";

/** Highest degree that a patch may have: what the scratch space here and the reader of records allow. */
export const DEGREE_MAX = 16;

/** Share of a patch's half extent that counts as its edge: rounding of the division into patches. */
const EDGE = 1e-12;

/** Compiles a patchwork: (x, y, z) → (longitude, latitude, z). */
export function projectionLink({ patches, centre }: Pick<Patchwork, "patches" | "centre">): Link {
  const patched = patchesLink(patches);
  if (!centre) return patched;
  const back = turnBackLink(centre);
  return {
    apply(state) {
      patched.apply(state);
      back.apply(state);
    },
    differentiate(state, jacobian) {
      patched.differentiate(state, jacobian);
      back.differentiate(state, jacobian);
    },
  };
}

/** The polynomials alone. */
function patchesLink(patches: readonly Patch[]): Link {
  const byU = new Float64Array(2 * (DEGREE_MAX + 1));
  const byV = new Float64Array(2 * (DEGREE_MAX + 1));
  const own = new Float64Array(9);
  let last = patches[0];

  const find = (x: number, y: number): boolean => {
    if (holds(last, x, y)) return true;
    for (let i = 0; i < patches.length; i++) {
      if (!holds(patches[i], x, y)) continue;
      last = patches[i];
      return true;
    }
    return false;
  };

  return {
    apply(state) {
      if (!find(state[0], state[1])) {
        state.fill(Number.NaN);
        return;
      }
      const { degree, coefficients, minX, minY, maxX, maxY } = last;
      const u = (2 * state[0] - minX - maxX) / (maxX - minX);
      const v = (2 * state[1] - minY - maxY) / (maxY - minY);
      polynomials(u, degree, byU);
      polynomials(v, degree, byV);
      const plane = (degree + 1) * (degree + 1);
      let longitude = 0;
      let latitude = 0;
      for (let k = degree, at = plane - 1; k >= 0; k--) {
        let innerLongitude = 0;
        let innerLatitude = 0;
        for (let l = degree; l >= 0; l--, at--) {
          innerLongitude += coefficients[at] * byV[l];
          innerLatitude += coefficients[plane + at] * byV[l];
        }
        longitude += innerLongitude * byU[k];
        latitude += innerLatitude * byU[k];
      }
      state[0] = longitude;
      state[1] = latitude;
    },

    differentiate(state, jacobian) {
      if (!find(state[0], state[1])) {
        state.fill(Number.NaN);
        return;
      }
      const { degree, coefficients, minX, minY, maxX, maxY } = last;
      const u = (2 * state[0] - minX - maxX) / (maxX - minX);
      const v = (2 * state[1] - minY - maxY) / (maxY - minY);
      derivatives(u, degree, byU);
      derivatives(v, degree, byV);
      const plane = (degree + 1) * (degree + 1);
      for (let row = 0; row < 2; row++) {
        let byX = 0;
        let byY = 0;
        for (let k = 0, at = row * plane; k <= degree; k++) {
          for (let l = 0; l <= degree; l++, at++) {
            byX += coefficients[at] * byU[DEGREE_MAX + 1 + k] * byV[l];
            byY += coefficients[at] * byU[k] * byV[DEGREE_MAX + 1 + l];
          }
        }
        own[3 * row] = (2 * byX) / (maxX - minX);
        own[3 * row + 1] = (2 * byY) / (maxY - minY);
      }
      own[8] = 1;
      premultiply(own, jacobian);
      this.apply(state);
    },
  };
}

/** Whether a point lies in the rectangle of a patch, its edges included. */
export function holds(
  { minX, minY, maxX, maxY }: Omit<Patch, "degree" | "coefficients">,
  x: number,
  y: number,
): boolean {
  const edgeX = EDGE * (Math.abs(minX) + Math.abs(maxX));
  const edgeY = EDGE * (Math.abs(minY) + Math.abs(maxY));
  return x >= minX - edgeX && x <= maxX + edgeX && y >= minY - edgeY && y <= maxY + edgeY;
}

/** T_0(t) … T_degree(t). */
function polynomials(t: number, degree: number, out: Float64Array): void {
  out[0] = 1;
  out[1] = t;
  for (let k = 2; k <= degree; k++) out[k] = 2 * t * out[k - 1] - out[k - 2];
}

/** T_k(t), and its derivative at `out[DEGREE_MAX + 1 + k]`. */
function derivatives(t: number, degree: number, out: Float64Array): void {
  polynomials(t, degree, out);
  const at = DEGREE_MAX + 1;
  out[at] = 0;
  out[at + 1] = 1;
  for (let k = 2; k <= degree; k++) out[at + k] = 2 * out[k - 1] + 2 * t * out[at + k - 1] - out[at + k - 2];
}
