/** Share of cases that a stated band holds. */
export const COVERAGE = 0.95;

/**
 * Half width of the band that holds 95 % of the cases, in standard deviations, by the excess kurtosis of the sum of
 * errors: 1.645 for one error that is evenly likely between two bounds (−1.2), 1.902 for the difference of two such (−0.6),
 * 1.960 for many or normal ones (0), each exact; in between by the parabola through them. After Willink, "A procedure for
 * the evaluation of measurement uncertainty based on moments", Metrologia 42 (2005) 329–343.
 */
export function coverageFactor(excessKurtosis: number): number {
  const k = Math.min(0, Math.max(-1.2, excessKurtosis));
  return 1.96 + k * (LINEAR + k * SQUARE);
}

const [RECTANGLE, TRIANGLE] = [0.95 * Math.sqrt(3) - 1.96, Math.sqrt(6) * (1 - Math.sqrt(0.05)) - 1.96];
/** Of the parabola a k + b k² through (−0.6, TRIANGLE) and (−1.2, RECTANGLE). */
const SQUARE = (RECTANGLE - 2 * TRIANGLE) / 0.72;
const LINEAR = (RECTANGLE - 4 * TRIANGLE) / 1.2;

/** Excess kurtosis of an error that is evenly likely between two bounds. */
export const RECTANGULAR_KURTOSIS = -1.2;
