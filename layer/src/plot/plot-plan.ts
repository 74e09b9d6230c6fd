import {
  type EffectPlan,
  OFFSET,
  type PointCloudStyle,
  type PointFilter,
  planEffects,
  type SceneFacts,
  type StyledAttribute,
} from "../effects/index.js";
import type { PlotView } from "../tools/plot/plot-view.js";
import { LEVEL } from "./section-vertices.js";

/** What of a series a plan follows from. */
export interface PlannedSeries {
  readonly cloud: {
    readonly attributes: readonly StyledAttribute[];
    /** Distance between the points of the root, metres. */
    readonly bounds: { readonly spacing: number };
  };
  readonly style: PointCloudStyle;
  readonly filter?: PointFilter | undefined;
  readonly nodes: number;
  readonly points: number;
  /** Deepest level of its nodes. */
  readonly deepest: number;
  /** Greatest distance of a point from the line, metres. */
  readonly reach: number;
}

/** What has no sense in a section: depth is folded about the line there, and the points of all levels lie in one plane. */
const NEVER = { eyeDomeLighting: false, clip: false, highlight: false } as const;

/**
 * A layer's style as a plot draws it. Points are as wide as its fixed size: a section is read by where points are, and not as
 * a surface that they close.
 */
export function plotStyle(style: PointCloudStyle): PointCloudStyle {
  return { ...style, size: "fixed" };
}

/**
 * The effects that a plot shows a style with: colours, gradients, classes, filter, shapes, opacity and dithering as they are.
 * The level of detail of a point is that of its node.
 * @param series its style is one of {@link plotStyle}
 * @param blends whether sums of colours can be drawn into
 */
export function planSeries(
  series: PlannedSeries,
  view: PlotView,
  pixelRatio: number,
  blends: boolean,
): EffectPlan {
  const forced = blends ? NEVER : { ...NEVER, splats: false };
  return planEffects(series.style, factsOf(series, view, pixelRatio), forced);
}

function factsOf(series: PlannedSeries, view: PlotView, pixelRatio: number): SceneFacts {
  const { cloud, filter, nodes, points, deepest, reach } = series;
  const { from, to } = view.shown;
  const pixelsPerMetre = (view.width * pixelRatio) / (to - from);
  const spacing = cloud.bounds.spacing / 2 ** deepest;
  const own: StyledAttribute[] = [
    { name: OFFSET, kind: "scalar", range: [-reach, reach] },
    { name: LEVEL, kind: "scalar", range: [0, deepest] },
  ];
  return {
    viewportHeight: view.height * pixelRatio,
    ...{ pixelRatio, nodes, points, pixelsPerMetre, filter },
    spacings: [spacing * pixelsPerMetre, spacing * pixelsPerMetre],
    levels: [deepest, deepest],
    groundSpacings: [spacing, spacing],
    groundSpacing: spacing,
    ...{ depthStep: 0, clips: 0, highlights: 0 },
    attributes: [...own, ...cloud.attributes],
  };
}
