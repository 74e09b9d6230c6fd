import type { EffectPlan } from "./effect-plan.js";
import type { SceneFacts } from "./facts.js";
import { rangeOf } from "./ranges.js";
import type { PointCloudStyle } from "./style.js";
import type { UniformValues } from "./uniforms.js";

/** How a column's stored numbers become values: stored · scale + offset, or one value for all points. */
export interface ColumnScale {
  readonly scale: number;
  readonly offset: number;
  readonly constant?: readonly number[] | undefined;
}

/** What the effects must know of a node to draw it. */
export interface DrawnNode {
  /** Its columns by name, at least those that the program's attributes name. */
  readonly columns: { get(name: string): ColumnScale | undefined };
  /** Number of the first point of the node among all points drawn. */
  readonly firstId: number;
  /** Level in the octree. */
  readonly level: number;
  /** Distance of its points on the ground, metres. */
  readonly spacing: number;
  /** Its texel in the texture of the visible octree. */
  readonly octreeIndex: number;
  /** 3 × 4, row by row: node frame → its own cube, 0 to 1. */
  readonly toCube: ArrayLike<number>;
  /** First texel and number of its records in the texture of clips. */
  readonly clips: readonly [first: number, count: number];
}

/** Values of the uniforms of one node; matrices are column-major. Form them when the node, the style or the view's nodes change. */
export function nodeUniforms(
  plan: EffectPlan,
  style: PointCloudStyle,
  facts: SceneFacts,
  node: DrawnNode,
): UniformValues {
  const { active, colourings, filters } = plan;
  const values: Record<string, number | readonly number[]> = { u_firstId: node.firstId };
  colourings.forEach(({ kind, column }, index) => {
    if (kind !== "scalar") return;
    values[`u_value${index}`] = valueMap(node.columns.get(column!), rangeOf(column!, style, facts));
  });
  filters.ranges.forEach((column, index) => {
    values[`u_range${index}`] = storedRange(node.columns.get(column), filters.filter!.ranges![column]);
  });
  if (active.has("adaptiveSize") || active.has("levelOfDetail")) {
    values.u_octreeIndex = node.octreeIndex;
    values.u_toCube = columnMajor(node.toCube);
    values.u_nodeSize = style.spacingFactor * node.spacing;
    values.u_nodeLevel = node.level;
  }
  if (active.has("clip") || active.has("highlight")) values.u_clipRecords = node.clips;
  return values;
}

/** Factor and summand that take stored numbers to 0 … 1 over a range; formed in float64. */
function valueMap(column: ColumnScale | undefined, [least, greatest]: readonly [number, number]): number[] {
  const width = greatest > least ? greatest - least : 1;
  if (!column) return [0, 0];
  if (column.constant) return [0, (column.constant[0] - least) / width];
  return [column.scale / width, (column.offset - least) / width];
}

/** More than any stored number. */
const BEYOND = 3e38;
const ALL = [-BEYOND, BEYOND];
const NONE = [BEYOND, -BEYOND];

/**
 * A range in a column's stored numbers. Bounds that lie a rounding error beside a stored number take it in, so that
 * what float64 makes of `stored · scale + offset` decides nothing.
 */
function storedRange(column: ColumnScale | undefined, range: readonly [number, number]): readonly number[] {
  if (!column) return NONE;
  const [least, greatest] = range;
  if (column.constant) return column.constant[0] >= least && column.constant[0] <= greatest ? ALL : NONE;
  const ends = range.map((value) => (value - column.offset) / column.scale).sort((a, b) => a - b);
  const slack = 1e-6;
  return [ends[0] - slack, ends[1] + slack];
}

/** A 3 × 4 matrix, row by row, as 4 × 4, column by column. */
function columnMajor(rows: ArrayLike<number>): number[] {
  return [
    ...[rows[0], rows[4], rows[8], 0],
    ...[rows[1], rows[5], rows[9], 0],
    ...[rows[2], rows[6], rows[10], 0],
    ...[rows[3], rows[7], rows[11], 1],
  ];
}
