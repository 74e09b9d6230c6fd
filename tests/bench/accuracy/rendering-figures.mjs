export function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length / 2;
  return (sorted[Math.ceil(middle) - 1] + sorted[Math.floor(middle)]) / 2;
}

export const percent = (share) => `${(100 * share).toFixed(share < 0.1 ? 1 : 0)} %`;

/** Points in thousands or millions. */
export function points(count) {
  return count >= 1e6 ? `${Number((count / 1e6).toPrecision(3))} M` : `${Math.round(count / 1e3)} k`;
}
