/** What a view would draw of each node if it could; the nodes in falling order of {@link pixels}. */
export interface Demand {
  /** Points of each node. */
  readonly sizes: number[];
  /** Share of a node that the screen-space error calls for, 0 to 1. */
  readonly caps: number[];
  /** Importance of a node: the distance of its points in pixels, weighted by its place in the picture. */
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

/** Points per square pixel that a threshold stands for; without a threshold as many as there are. */
const densityAt = (threshold: number) => 1 / (threshold * threshold);

/** Share of node `index` at a density: {@link shareOf} up to what the screen-space error calls for. */
function shareAt({ caps, pixels, base, prefix }: Demand, index: number, density: number): number {
  const cap = caps[index];
  if (cap === 0) return 0;
  const ratio = pixels[index] * pixels[index] * density;
  if (!prefix) return 4 * ratio > 1 ? cap : 0;
  const share = base[index] ? ratio : (4 * ratio - 1) / 3;
  return share > 0 ? Math.min(share, cap) : 0;
}

/** What demands come to at a density. */
interface Sum {
  /** Points; not rounded. */
  points: number;
  /** By how many points they grow per density: what the nodes add that are drawn in part. */
  growth: number;
}

/** Points that a demand comes to at a threshold, 0 where there is none; not rounded. */
export function pointsAt(demand: Demand, threshold: number): number {
  return sumAt([demand], densityAt(threshold)).points;
}

function sumAt(demands: readonly Demand[], density: number): Sum {
  let points = 0;
  let rising = 0;
  for (const demand of demands) {
    const { sizes, caps, base } = demand;
    for (let index = 0; index < sizes.length; index++) {
      const share = shareAt(demand, index, density);
      points += sizes[index] * share;
      // A share rises with the density in a straight line from −1/3 on, or from 0 where nothing is above the node.
      if (share > 0 && share < caps[index]) rising += sizes[index] * (base[index] ? share : share + 1 / 3);
    }
  }
  return { points, growth: rising / density };
}

/** Relative width to which a density is narrowed down; where less than half a point is left over, it may be wider. */
const PRECISION = 1e-9;

/**
 * The least threshold at which the demands together keep a limit; 0 where they keep it without one. It is the one
 * spacing on the screen that the limit allows, and so where each point shows most.
 *
 * Points grow with the density, in straight pieces between the densities at which a node begins and is whole. Newton's
 * method ends as soon as it is on the right piece; where it leaves what is known to hold the answer, or nodes are drawn
 * whole, which makes steps of the pieces, the middle is tried.
 *
 * @param near a threshold to begin at
 */
export function thresholdFor(demands: readonly Demand[], limit: number, near?: number): number {
  if (sumAt(demands, Number.POSITIVE_INFINITY).points <= limit) return 0;
  if (limit <= 0) return Number.POSITIVE_INFINITY;
  // Half a point may be left over: a little less is aimed at, so that rounding does not end above the limit.
  const aim = limit - Math.min(0.25, limit / 4);
  let density = densityAt(near || Math.max(...demands.map((demand) => passing(demand, limit))));
  let [low, high] = [0, Number.POSITIVE_INFINITY];
  for (let step = 1; step <= STEPS && high > low * (1 + PRECISION); step++) {
    const { points, growth } = sumAt(demands, density);
    if (points > limit) high = density;
    else low = density;
    if (points <= limit && limit - points <= 0.5) break;
    density += (aim - points) / growth;
    if (!(density > low && density < high) || step % SLOW === 0) density = between(low, high);
  }
  // Wider by a few bits, so that the density it stands for is never above the one that was found.
  return (1 + 2 ** -50) / Math.sqrt(low);
}

/** More than are ever needed between numbers that a picture can have; of others nothing is drawn. */
const STEPS = 500;

/** Steps of Newton's method after which one is halved, in case they go to and fro. */
const SLOW = 8;

/** The middle of a range of densities, as a factor from either end; beyond the one end that is known, where one is. */
function between(low: number, high: number): number {
  if (low === 0) return high / 4;
  return high === Number.POSITIVE_INFINITY ? low * 4 : Math.sqrt(low) * Math.sqrt(high);
}

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
  const density = densityAt(threshold);
  let left = Math.max(0, Math.floor(limit));
  const counts: number[] = [];
  for (let index = 0; index < sizes.length; index++) {
    let count = wantedOf(demand, index, density);
    // A data set that is there at all is seen by one point at least.
    if (threshold === 0 && base[index]) count = Math.max(count, Math.min(sizes[index], 1));
    if (count > left) {
      count = prefix ? left : 0;
      left = 0;
    } else left -= count;
    counts.push(count);
  }
  if (threshold > 0 && prefix) spend(demand, density, counts, left);
  return counts;
}

/** Whole points of a node at a density. Among whole nodes, those that are just at it are for the limit to choose. */
function wantedOf(demand: Demand, index: number, density: number): number {
  const { sizes, prefix } = demand;
  if (!prefix) return shareAt(demand, index, density * (1 + 2e-6)) > 0 ? sizes[index] : 0;
  const points = sizes[index] * shareAt(demand, index, density);
  return density === Number.POSITIVE_INFINITY ? Math.round(points) : Math.floor(points);
}

/** Adds the points left to nodes that are drawn in part, one each, the most important first, until none is left. */
function spend(demand: Demand, density: number, counts: number[], points: number): void {
  let left = points;
  for (let given = true; left > 0 && given; ) {
    given = false;
    for (let index = 0; left > 0 && index < counts.length; index++) {
      if (counts[index] >= demand.sizes[index] || shareAt(demand, index, density) === 0) continue;
      counts[index]++;
      left--;
      given = true;
    }
  }
}
