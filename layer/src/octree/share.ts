/** What a view would draw of each node if it could; the nodes in falling order of {@link pixels}. */
export interface Demand {
  /** Points of each node. */
  readonly sizes: number[];
  /** Share of a node that the screen-space error calls for, 0 to 1. */
  readonly caps: number[];
  /** Importance of a node: its spacing in pixels, weighted by its place in the picture. */
  readonly pixels: number[];
  /** Whether no node above it has points. */
  readonly base: boolean[];
  /** Whether nodes are drawn in part; else whole or not at all. */
  readonly prefix: boolean;
}

/**
 * Share of a node's points that brings the picture to one point per `threshold` pixels.
 *
 * A node whose points are p pixels apart, drawn whole and with all above it, shows 1/p² points per square pixel. Its
 * parents, twice as wide apart, show 1/(4p²) of that without it. So that
 * 1/(4p²) + share · (1/p² − 1/(4p²)) = 1/threshold², share = (4p²/threshold² − 1)/3: 0 where the parents suffice, at
 * p = threshold/2, and 1 at p = threshold, where the node's own children begin. Where nothing is above a node,
 * share/p² = 1/threshold².
 *
 * @param pixels distance between the node's points on the screen
 * @param base whether no node above it has points
 */
export function shareOf(pixels: number, threshold: number, base: boolean): number {
  const ratio = (pixels / threshold) ** 2;
  return Math.max(0, Math.min(1, base ? ratio : (4 * ratio - 1) / 3));
}

/** Share of node `index` at a threshold; 0 stands for no threshold. */
function shareAt(demand: Demand, index: number, threshold: number): number {
  const cap = demand.caps[index];
  if (threshold === 0 || cap === 0) return cap;
  const { pixels, base, prefix } = demand;
  if (!prefix) return 2 * pixels[index] > threshold ? cap : 0;
  return Math.min(cap, shareOf(pixels[index], threshold, base[index]));
}

/** Points that a demand comes to at a threshold; not rounded. */
export function pointsAt(demand: Demand, threshold: number): number {
  const { sizes } = demand;
  let points = 0;
  for (let index = 0; index < sizes.length; index++)
    points += sizes[index] * shareAt(demand, index, threshold);
  return points;
}

/** Relative width to which a threshold is narrowed down; where less than half a point is left over, it may be wider. */
const PRECISION = 1e-9;

/**
 * The least threshold at which the demands together keep a limit; 0 where they keep it without one. It is the one
 * spacing on the screen that the limit allows, and so where each point shows most.
 */
export function thresholdFor(demands: readonly Demand[], limit: number): number {
  const pointsOf = (threshold: number) =>
    demands.reduce((sum, demand) => sum + pointsAt(demand, threshold), 0);
  // Points fall with the square of a threshold, nearly: logarithms make that a line.
  const excess = (points: number) => Math.log(Math.max(points, LEAST) / Math.max(limit, LEAST));
  if (pointsOf(0) <= limit) return 0;
  let [low, high] = [1, 1].fill(Math.max(...demands.map((demand) => passing(demand, limit))));
  let below = pointsOf(high);
  let above = below;
  for (; below > limit; below = pointsOf(high)) {
    [low, above] = [high, below];
    high *= 2;
  }
  for (; above <= limit; above = pointsOf(low)) {
    [high, below] = [low, above];
    low /= 2;
  }
  let [over, under] = [excess(above), excess(below)];
  // False position, by the Illinois rule: an end that stays counts half, and a bisection in case both hardly move.
  for (let step = 1; step <= 100 && high / low - 1 > PRECISION && limit - below > 0.5; step++) {
    const part = step % 5 === 0 ? 0.5 : over / (over - under);
    const guess = low * (high / low) ** part;
    const points = pointsOf(guess);
    if (points > limit) {
      low = guess;
      over = excess(points);
      under /= 2;
    } else {
      high = guess;
      below = points;
      under = excess(points);
      over /= 2;
    }
  }
  return high;
}

/** In place of no points: a logarithm needs some. */
const LEAST = 1e-300;

/** Spacing in pixels of the node with which a demand, drawn whole from the most important node on, passes a limit. */
function passing({ sizes, caps, pixels }: Demand, limit: number): number {
  let points = 0;
  let index = 0;
  while (index < sizes.length - 1 && points <= limit) {
    points += sizes[index] * caps[index];
    index++;
  }
  return pixels[index] ?? 1;
}

/**
 * Points of each node at a threshold, at most `limit` of them; where nodes may be drawn in part, what rounding leaves
 * of the limit goes to the most important ones.
 */
export function countsAt(demand: Demand, threshold: number, limit: number): number[] {
  const { sizes, prefix, base } = demand;
  let left = Math.max(0, Math.floor(limit));
  const counts = sizes.map((size, index) => {
    let count = wantedOf(demand, index, threshold);
    // A data set that is there at all is seen by one point at least.
    if (threshold === 0 && base[index]) count = Math.max(count, Math.min(size, 1));
    if (count > left) {
      count = prefix ? left : 0;
      left = 0;
    } else left -= count;
    return count;
  });
  if (threshold > 0 && prefix) spend(demand, threshold, counts, left);
  return counts;
}

/** Whole points of a node at a threshold. Among whole nodes, those that are just at it are for the limit to choose. */
function wantedOf(demand: Demand, index: number, threshold: number): number {
  const { sizes, pixels, prefix } = demand;
  if (prefix) {
    const points = sizes[index] * shareAt(demand, index, threshold);
    return threshold === 0 ? Math.round(points) : Math.floor(points);
  }
  return 2 * pixels[index] > threshold * (1 - 1e-6) ? sizes[index] : 0;
}

/** Adds the points left to nodes that are drawn in part, one each, the most important first, until none is left. */
function spend(demand: Demand, threshold: number, counts: number[], points: number): void {
  const open = counts.map((_, index) => index).filter((index) => shareAt(demand, index, threshold) > 0);
  let left = points;
  for (let given = true; left > 0 && given; ) {
    given = false;
    for (const index of open) {
      if (left === 0 || counts[index] >= demand.sizes[index]) continue;
      counts[index]++;
      left--;
      given = true;
    }
  }
}
