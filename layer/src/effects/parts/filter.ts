import type { Effect } from "../effect.js";
import { hidesClasses, RETURN_BITS } from "../filter.js";
import type { Part } from "../part.js";
import { rejectIf } from "../reject.js";
import type { Scene } from "../scene.js";

/** Number of conditions that points must meet; hidden classes are one. */
function conditionsOf({ style, facts }: Scene): number {
  const { filter } = facts;
  const ranges = Object.keys(filter?.ranges ?? {}).length;
  return (hidesClasses(style, filter) ? 1 : 0) + (filter?.returns ? 1 : 0) + ranges;
}

/** Points left out by class, return and ranges of values. */
export const filter: Effect = {
  name: "filter",
  unit: "1",
  threshold: 1,
  source: "number of conditions and of hidden classes",
  wish: (scene) =>
    conditionsOf(scene) > 0
      ? { kind: "asked", why: "points are left out by their attributes" }
      : { kind: "off", why: "all classes and values are shown" },
  magnitude: conditionsOf,
  part({ plan, attribute }): Part {
    const { filters } = plan;
    const columns = [
      ...(filters.classes ? ["classification"] : []),
      ...(filters.returns ? ["returnNumber", "numberOfReturns"] : []),
      ...filters.ranges,
    ];
    const ranges = filters.ranges.map((column, index) => {
      const name = attribute(column);
      return rejectIf(`${name} < u_range${index}.x || ${name} > u_range${index}.y`);
    });
    return {
      attributes: columns.map((column) => ({ column, components: 1, normalized: false })),
      uniforms: [
        { name: "u_classes", type: "sampler2D", scope: "texture" },
        { name: "u_returns", type: "int", scope: "layer" },
        ...filters.ranges.map((_, index) => ({
          name: `u_range${index}`,
          type: "vec2" as const,
          scope: "node" as const,
        })),
      ],
      ...(filters.classes && { vertexFunctions: "#include <classEntry>" }),
      vertex: {
        cull: [
          ...(filters.classes ? [rejectIf("classEntry(a_classification).a < 0.5")] : []),
          ...(filters.returns ? [RETURNS] : []),
          ...ranges,
        ].join("\n"),
      },
    };
  },
  values: ({ facts }, plan) => ({
    ...(plan.filters.returns && {
      u_returns: (facts.filter?.returns ?? []).reduce((bits, kind) => bits | RETURN_BITS[kind], 0),
    }),
  }),
};

const { first, last, intermediate, single } = RETURN_BITS;

const RETURNS = `bool isFirst = a_returnNumber < 1.5;
bool isLast = a_returnNumber > a_numberOfReturns - 0.5;
int returnKind = isFirst ? (isLast ? ${first | last | single} : ${first}) : (isLast ? ${last} : ${intermediate});
${rejectIf("(returnKind & u_returns) == 0")}`;
