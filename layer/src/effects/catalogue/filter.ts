import { CLASS_ENTRY, type ClassStyle, classTexture, hidesClasses } from "../declaration/classes.js";
import { type Effect, rejectIf, type Scene } from "../declaration/effect.js";
import type { ColumnScale } from "../declaration/facts.js";
import { RETURN_BITS } from "../declaration/filter.js";

/** What the filter asks for: classes, kinds of returns, columns that it holds against ranges. */
export interface Conditions {
  readonly classes: boolean;
  readonly returns: boolean;
  readonly ranges: readonly string[];
}

/** What points must meet; hidden classes are one condition. */
function conditionsOf({ style, facts: { filter } }: Pick<Scene<ClassStyle>, "style" | "facts">): Conditions {
  return {
    classes: hidesClasses(style, filter),
    returns: filter?.returns !== undefined,
    ranges: Object.keys(filter?.ranges ?? {}),
  };
}

function numberOf(scene: Scene<ClassStyle>): number {
  const { classes, returns, ranges } = conditionsOf(scene);
  return (classes ? 1 : 0) + (returns ? 1 : 0) + ranges.length;
}

const { first, last, intermediate, single } = RETURN_BITS;

const RETURNS = `bool isFirst = a_returnNumber < 1.5;
bool isLast = a_returnNumber > a_numberOfReturns - 0.5;
int returnKind = isFirst ? (isLast ? ${first | last | single} : ${first}) : (isLast ? ${last} : ${intermediate});
${rejectIf("(returnKind & u_returns) == 0")}`;

/** Points left out by class, return and ranges of values. */
export const filter: Effect<{ name: "filter"; reads: ClassStyle; variant: Conditions }> = {
  name: "filter",
  options: {},
  // There may be nothing to filter by.
  forcible: "off",
  unit: "1",
  threshold: 1,
  source: "number of conditions and of hidden classes",
  wish: (scene) =>
    numberOf(scene) > 0
      ? { kind: "asked", why: "points are left out by their attributes" }
      : { kind: "off", why: "all classes and values are shown" },
  magnitude: numberOf,
  variant: conditionsOf,
  part({ variant: { classes, returns, ranges }, attribute }) {
    const columns = [
      ...(classes ? ["classification"] : []),
      ...(returns ? ["returnNumber", "numberOfReturns"] : []),
      ...ranges,
    ];
    const outside = ranges.map((column, index) => {
      const name = attribute(column);
      return rejectIf(`${name} < u_range${index}.x || ${name} > u_range${index}.y`);
    });
    return {
      attributes: columns.map((column) => ({ column, components: 1, normalized: false })),
      uniforms: [
        { name: "u_classes", type: "sampler2D", scope: "texture" },
        { name: "u_returns", type: "int", scope: "layer" },
        ...ranges.map((_, index) => ({ name: `u_range${index}`, type: "vec2", scope: "node" }) as const),
      ],
      ...(classes && { vertexFunctions: [CLASS_ENTRY] }),
      vertex: {
        cull: [
          ...(classes ? [rejectIf("classEntry(a_classification).a < 0.5")] : []),
          ...(returns ? [RETURNS] : []),
          ...outside,
        ].join("\n"),
      },
    };
  },
  values: ({ facts: { filter } }) =>
    filter?.returns ? { u_returns: filter.returns.reduce((bits, kind) => bits | RETURN_BITS[kind], 0) } : {},
  nodeValues: ({ facts: { filter } }, { columns }) =>
    Object.fromEntries(
      Object.entries(filter?.ranges ?? {}).map(([column, range], index) => [
        `u_range${index}`,
        storedRange(columns.get(column), range),
      ]),
    ),
  textures: (scene) => (conditionsOf(scene).classes ? [classTexture(scene.style, scene.facts.filter)] : []),
};

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
  const slack = 1e-6;
  const [lower, upper] = range.map((value) => (value - column.offset) / column.scale).sort((a, b) => a - b);
  // float32 has no greater number, and a GPU need not know infinity.
  return [Math.max(lower - slack, -BEYOND), Math.min(upper + slack, BEYOND)];
}
