import type { PlacingFacts, SceneFacts } from "./declaration/facts.js";
import type { LedgerRow } from "./effect-plan.js";

/** Mean radius of the earth, metres (IUGG). */
const EARTH_RADIUS = 6_371_008.8;

/** Pixels from which a step of the depth buffer shows. */
const DEPTH_THRESHOLD = 0.25;

/** Pixels from which a point is seen beside its place. */
const PLACING_THRESHOLD = 0.05;

type Row = Omit<LedgerRow, "cost">;

/** Rows of what is known of the placing: what leaving each part out would cost, and what all costs as it is. */
export function placingRows({ placing, placingPixels, ...depth }: SceneFacts): LedgerRow[] {
  const rows: Row[] = [
    ...(placing ? rowsOf(placing) : []),
    ...(placing && placingPixels !== undefined ? [onScreen(placingPixels)] : []),
    ...depthRows(depth),
  ];
  return rows.map((row) => ({ ...row, cost: undefined }));
}

function rowsOf(placing: PlacingFacts): Row[] {
  return [
    curvature(placing),
    geoid(placing),
    ...scale(placing),
    {
      ...stated("placing", placing.bound, placing.tolerance, "worst certified bound of a drawn node"),
      why: "certified for each node",
    },
    storage(placing),
    ...placing.parts.map(({ name, metres, note }) => ({
      ...stated(name, metres ?? Number.NaN, placing.tolerance, "part of the stated accuracy"),
      why: note ?? (metres === null ? "not known" : "stated"),
    })),
  ];
}

function storage({ storageBound, tolerance, stored: { steps, floats } }: PlacingFacts): Row {
  const source =
    "rounding in the node's frame: to float32, √3 · 2⁻²⁴ · half-width, and where that leaves room to 2²⁰ steps a side, √3 / 2 · step; part of the bound above";
  return {
    ...stated("storage", storageBound, tolerance, source),
    why: `positions of drawn nodes: ${steps} at whole steps (8 bytes a point), ${floats} as float32 (12 bytes)`,
  };
}

function curvature({ nodeEdge, schemes, tolerance }: PlacingFacts): Row {
  const all = Object.values(schemes).reduce((sum, count) => sum + count, 0);
  const curved = all - (schemes.affine ?? 0);
  const names = Object.entries(schemes).map(([scheme, count]) => `${count} ${scheme}`);
  return {
    effect: "curvature",
    magnitude: nodeEdge ** 2 / (8 * EARTH_RADIUS),
    unit: "m",
    threshold: tolerance,
    active: curved > 0,
    why:
      curved > 0
        ? `drawn nodes are placed by their certificates: ${names.join(", ")}`
        : "one affine map places each drawn node within the tolerance",
    source: "sagitta d² / 8R of the longest drawn node",
  };
}

function onScreen(pixels: number): Row {
  const seen = pixels >= PLACING_THRESHOLD;
  return {
    effect: "placingOnScreen",
    magnitude: pixels,
    unit: "px",
    threshold: PLACING_THRESHOLD,
    active: seen,
    why: seen
      ? "points of nodes that are wide for how near they are may be seen beside their place"
      : "no drawn point is seen beside its place",
    source:
      "certified bound and rounding to float32 in eye space, at the nearest place of each drawn node's box",
  };
}

const HEIGHTS: Readonly<Record<PlacingFacts["heights"], string>> = {
  geoid: "heights are measured from a geoid, and drawn over the ellipsoid",
  ellipsoidal: "heights are ellipsoidal",
  unknown: "what heights are measured from is not known",
};

function geoid({ undulation, heights, tolerance }: PlacingFacts): Row {
  return {
    effect: "geoid",
    magnitude: Math.abs(undulation),
    unit: "m",
    threshold: tolerance,
    active: Math.abs(undulation) >= tolerance,
    why: HEIGHTS[heights],
    source: "height over the ellipsoid of source height 0 at the data set's middle",
  };
}

function scale({ scaleDeviation }: PlacingFacts): Row[] {
  if (scaleDeviation === undefined) return [];
  return [
    {
      effect: "gridScale",
      magnitude: Math.abs(scaleDeviation),
      unit: "m/m",
      threshold: 0,
      active: true,
      why: "points stand on the globe, where lengths are those of the ground",
      source: "|length on the ground / length in source coordinates − 1| at the data set's middle",
    },
  ];
}

function depthRows({ depthStepPixels, logarithmicDepth }: Omit<SceneFacts, "placing">): Row[] {
  if (depthStepPixels === undefined) return [];
  const active = logarithmicDepth ?? false;
  return [
    {
      effect: "logarithmicDepth",
      magnitude: depthStepPixels,
      unit: "px",
      threshold: DEPTH_THRESHOLD,
      active,
      why: active ? "the scene has it on" : "the scene has it off",
      source: "step of a linear depth buffer at the farthest node, on screen",
    },
  ];
}

/** A row of something that is always there and is stated. */
function stated(effect: string, magnitude: number, threshold: number, source: string): Row {
  return { effect, magnitude, unit: "m", threshold, active: true, why: "stated", source };
}
