/** Nodes per direction; a fit has degree 8 in u and in v. */
export const NODES = 9;

/** cos(kθ_i) at the Chebyshev nodes θ_i = π(i + ½)/NODES, row k. */
const COSINES: readonly Float64Array[] = Array.from({ length: NODES }, (_, k) =>
  Float64Array.from({ length: NODES }, (_, i) => Math.cos((k * Math.PI * (i + 0.5)) / NODES)),
);

/** The nodes of one direction in (−1, 1), falling. */
export const CHEBYSHEV_NODES: ArrayLike<number> = COSINES[1];

/**
 * How far interpolation on these nodes can amplify an error of the samples: the square of the Lebesgue constant of
 * nine Chebyshev nodes, (2/π)(ln 9 + γ + ln(8/π)) + O(1/81) (Trefethen, Approximation Theory and Approximation
 * Practice, theorem 15.2), rounded up.
 */
export const AMPLIFICATION = 6;

/**
 * Chebyshev coefficients of several functions of (u, v) from their values on the 9 × 9 nodes (discrete cosine
 * transform; Trefethen, ch. 3): f_c(u, v) = Σ a_kl T_k(u) T_l(v), a_kl at `(NODES·k + l)·count + c`.
 *
 * @param values f_c at node i of u and j of v at `(NODES·i + j)·count + c`
 * @param count number of functions
 */
export function chebyshevCoefficients(values: Float64Array, count: number): Float64Array {
  const byColumn = new Float64Array(values.length);
  for (let k = 0; k < NODES; k++) {
    const weight = (k === 0 ? 1 : 2) / NODES;
    for (let rest = 0; rest < NODES * count; rest++) {
      let sum = 0;
      for (let i = 0; i < NODES; i++) sum += COSINES[k][i] * values[i * NODES * count + rest];
      byColumn[k * NODES * count + rest] = sum * weight;
    }
  }
  const out = new Float64Array(values.length);
  for (let k = 0; k < NODES; k++) {
    for (let l = 0; l < NODES; l++) {
      const weight = (l === 0 ? 1 : 2) / NODES;
      for (let c = 0; c < count; c++) {
        let sum = 0;
        for (let j = 0; j < NODES; j++) sum += COSINES[l][j] * byColumn[(k * NODES + j) * count + c];
        out[(k * NODES + l) * count + c] = sum * weight;
      }
    }
  }
  return out;
}

const DECAY_MIN = 0.001;
const DECAY_MAX = 0.9;
const LAST = NODES - 1;

/**
 * Bound on what a 9 × 9 expansion itself leaves out. Interpolation is off by at most 2 Σ |a_k| over the degrees k > 8
 * of the true series (Trefethen, theorem 8.2), here 2·a₈·r/(1 − r) for one whose terms fall by the ratio r. The shells
 * s_k of coefficients met are those of the true ones less what the samples take for them: T_(18−k) is −T_k on the
 * nodes, so s_k = a_k − a_(18−k) and a₈ = s₈/(1 − r²). The ratio is the greater of what s₈/s₇ and s₈/s₆ say, within
 * [0.001, 0.9]. That it stays so is a model, not a proof.
 *
 * @param norm size of the coefficients of degree k in u and l in v
 */
export function geometricTail(norm: (k: number, l: number) => number): number {
  const shells = new Float64Array(NODES);
  for (let k = 0; k < NODES; k++) {
    for (let l = 0; l < NODES; l++) shells[Math.max(k, l)] += norm(k, l);
  }
  const last = shells[LAST];
  const byOne = shells[LAST - 1] > 0 ? last / shells[LAST - 1] : 0;
  const byTwo = shells[LAST - 2] > 0 ? last / shells[LAST - 2] : 0;
  // s₈/s₇ = r/(1 + r²), and s₈/s₆ = r²/(1 + r² + r⁴).
  const ratio = Math.max(smallerRoot(byOne, 1, byOne), Math.sqrt(smallerRoot(byTwo, 1 - byTwo, byTwo)));
  const decay = Math.min(DECAY_MAX, Math.max(DECAY_MIN, ratio));
  return (2 * last * decay) / ((1 - decay * decay) * (1 - decay));
}

/** The smaller root of a·x² − b·x + c for a, c ≥ 0 and b ≤ 1, or 1 where there is none: the series does not fall. */
function smallerRoot(a: number, b: number, c: number): number {
  const discriminant = b * b - 4 * a * c;
  return b > 0 && discriminant >= 0 ? (2 * c) / (b + Math.sqrt(discriminant)) : 1;
}

/** Sum of the norms of the coefficients of degree above `degree` in u or in v: what leaving them out can cost. */
export function discardedBeyond(degree: number, norm: (k: number, l: number) => number): number {
  let sum = 0;
  for (let k = 0; k < NODES; k++) {
    for (let l = 0; l < NODES; l++) if (Math.max(k, l) > degree) sum += norm(k, l);
  }
  return sum;
}
