import { type AreaOfUse, extentOf, type Rectangle } from "@groma/georef";
import type { Operation } from "./operation.js";

/** An operation that PROJ proposes, and where it is for. */
export interface Proposal {
  readonly operation: Operation;
  /** Degrees. */
  readonly area: AreaOfUse;
  /** The same in source units. */
  readonly areas: readonly Rectangle[];
}

/** An operation, and where it is taken if no one before it has been. */
export interface TakenAreas {
  readonly operation: Operation;
  /** Source units. */
  readonly areas: readonly Rectangle[];
}

/** Whether a place lies in a rectangle, its edges included; source units. */
export function holds({ minX, minY, maxX, maxY }: Rectangle, x: number, y: number): boolean {
  return x >= minX && x <= maxX && y >= minY && y <= maxY;
}

/**
 * Where PROJ takes which operation, as a list that is gone through from its beginning: the first whose areas hold a point. The
 * better ones go first; where the order of PROJ's own list says otherwise, their parts of the areas go before all of these.
 *
 * @param proposals in the order in which PROJ lists them for all places
 * @param within what has to be covered, source units
 */
export function takenAreas(proposals: readonly Proposal[], within: Rectangle): TakenAreas[] {
  const byRank = [...proposals].sort(byWorth);
  const columns = cuts(proposals, within, "minX", "maxX");
  const rows = cuts(proposals, within, "minY", "maxY");
  const cells = columns.map(([minX, maxX]) =>
    rows.map(([minY, maxY]) => {
      const there = (list: readonly Proposal[]) =>
        list.filter(({ areas }) => areas.some((area) => holds(area, (minX + maxX) / 2, (minY + maxY) / 2)));
      return { taken: suggested(there(proposals)), first: there(byRank)[0] };
    }),
  );
  if (cells.flat().every(({ taken, first }) => taken === first)) return byRank;
  const parts = byRank.map((proposal) => ({
    operation: proposal.operation,
    areas: merged(columns, rows, (i, j) => cells[i]![j]!.taken === proposal),
  }));
  return [...parts.filter(({ areas }) => areas.length > 0), ...byRank];
}

/**
 * The proposal that PROJ takes for a point (`pj_get_suggested_operation` of PROJ 9): it goes through those that are for it, and
 * the first gives way to a later one that goes before it.
 */
function suggested(list: readonly Proposal[]): Proposal | undefined {
  let best: Proposal | undefined;
  for (const one of list) if (!best || goesBefore(one, best)) best = one;
  return best;
}

/**
 * Whether a proposal takes the place of one that PROJ lists earlier: if it is more accurate, or as accurate and for a smaller
 * area that has a name; never if it is for the sea alone. Unknown accuracies are equal to each other, and give way to no other.
 */
function goesBefore(later: Proposal, earlier: Proposal): boolean {
  if (isOffshore(later.operation)) return false;
  const [before, after] = [earlier, later].map(({ operation }) => operation.accuracy ?? -1);
  if (after! >= 0 && after! < before!) return true;
  if (after !== before || (isNameless(later.operation) && !isNameless(earlier.operation))) return false;
  return extentOf(later.area) < extentOf(earlier.area);
}

/** The order of most lists: the sea last, then by accuracy, then by area. */
function byWorth(a: Proposal, b: Proposal): number {
  const [one, other] = [a, b].map(({ operation, area }) => {
    return [Number(isOffshore(operation)), operation.accuracy ?? Number.MAX_VALUE, extentOf(area)] as const;
  });
  return one![0] - other![0] || one![1] - other![1] || one![2] - other![2];
}

function isOffshore({ area }: Operation): boolean {
  return area.includes("- offshore");
}

function isNameless({ area }: Operation): boolean {
  return area === "unknown domain of validity";
}

type Interval = readonly [from: number, to: number];

/** The intervals between the edges of all areas. */
function cuts(
  proposals: readonly Proposal[],
  within: Rectangle,
  least: "minX" | "minY",
  greatest: "maxX" | "maxY",
): Interval[] {
  const [from, to] = [within[least], within[greatest]];
  const edges = proposals.flatMap(({ areas }) => areas.flatMap((area) => [area[least], area[greatest]]));
  const inside = edges.filter((edge) => edge > from && edge < to);
  const all = [...new Set([from, ...inside, to])].sort((a, b) => a - b);
  return all.slice(1).map((edge, i) => [all[i]!, edge]);
}

/** Rectangles of the cells that are wanted: columns of them, and those side by side that reach as far taken together. */
function merged(
  columns: readonly Interval[],
  rows: readonly Interval[],
  isWanted: (i: number, j: number) => boolean,
): Rectangle[] {
  const found: Rectangle[] = [];
  let open: Rectangle[] = [];
  for (const [i, [minX, maxX]] of columns.entries()) {
    const strips: Rectangle[] = [];
    for (const [j, [minY, maxY]] of rows.entries()) {
      if (!isWanted(i, j)) continue;
      const last = strips[strips.length - 1];
      if (last?.maxY === minY) strips[strips.length - 1] = { ...last, maxY };
      else strips.push({ minX, minY, maxX, maxY });
    }
    open = strips.map((strip) => {
      const before = open.find(
        (one) => one.maxX === minX && one.minY === strip.minY && one.maxY === strip.maxY,
      );
      if (!before) return strip;
      found.splice(found.indexOf(before), 1);
      return { ...strip, minX: before.minX };
    });
    found.push(...open);
  }
  return found;
}
