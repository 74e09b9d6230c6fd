import { type AccuracyPart, ecefToGeodetic } from "@groma/georef";
import { type NodeShapes, SHAPE } from "../octree/index.js";
import type { PlacingFacts } from "./declaration/facts.js";

/** A data set as far as its placing is stated; a `PointCloud` is one. */
export interface PlacedCloud {
  /** Source coordinates → ECEF, metres. */
  place(x: number, y: number, z: number, out: Float64Array): Float64Array;
  readonly boundingBox: {
    readonly min: readonly [number, number, number];
    readonly max: readonly [number, number, number];
  };
  readonly crs: {
    readonly horizontalUnit: { readonly kind: "linear" | "angular"; readonly size: number };
    readonly verticalUnit: { readonly size: number };
  };
  readonly height: { readonly kind: PlacingFacts["heights"] };
  readonly accuracy: { readonly parts: readonly AccuracyPart[] };
}

/** What holds for a data set whatever is drawn of it. */
export type CloudPlacing = Pick<
  PlacingFacts,
  "tolerance" | "heights" | "undulation" | "scaleDeviation" | "parts"
>;

/** Greatest distance that a data set allows a drawn point from its exact place, where nothing else is said, metres. */
const TOLERANCE = 0.001;

/** Source length over which the scale is taken, as a share of the data set. */
const SCALE_STEP = 0.01;

/** What the placing of a data set is, from its own map at the middle of its box. */
export function cloudPlacing(cloud: PlacedCloud, tolerance = TOLERANCE): CloudPlacing {
  const { boundingBox, crs, height, accuracy } = cloud;
  const { min, max } = boundingBox;
  const [x, y, z] = [0, 1, 2].map((axis) => (min[axis] + max[axis]) / 2);
  const here = cloud.place(x, y, z, new Float64Array(3));
  const geodetic = new Float64Array(3);
  ecefToGeodetic(here[0], here[1], here[2], geodetic);
  const { kind, size } = crs.horizontalUnit;
  const step = Math.max(max[0] - min[0], max[1] - min[1]) * SCALE_STEP;
  const inward = max[0] > min[0] ? [step, 0] : [0, step];
  const there = cloud.place(x + inward[0], y + inward[1], z, new Float64Array(3));
  const ground = Math.hypot(there[0] - here[0], there[1] - here[1], there[2] - here[2]);
  return {
    tolerance,
    heights: height.kind,
    undulation: geodetic[2] - z * crs.verticalUnit.size,
    scaleDeviation: kind === "linear" && step > 0 ? ground / (step * size) - 1 : undefined,
    parts: accuracy.parts,
  };
}

/**
 * The same with the nodes that are drawn.
 * @param slots of the nodes in `shapes`; below 0: not here, and not drawn
 */
export function placingFacts(cloud: CloudPlacing, slots: Int32Array, shapes: NodeShapes): PlacingFacts {
  const { numbers } = shapes;
  const counts: number[] = shapes.schemes.map(() => 0);
  /** Indices of the schemes, in the order in which the nodes come to them. */
  const found: number[] = [];
  let nodeEdge = 0;
  let bound = 0;
  let storageBound = 0;
  let steps = 0;
  let floats = 0;
  for (let index = 0; index < slots.length; index++) {
    if (slots[index] < 0) continue;
    const begin = shapes.begin(slots[index]);
    const scheme = numbers[begin + SHAPE.scheme];
    if (counts[scheme]++ === 0) found.push(scheme);
    const step = numbers[begin + SHAPE.step];
    if (step === 0) floats++;
    else steps++;
    bound = Math.max(bound, numbers[begin + SHAPE.bound]);
    nodeEdge = Math.max(nodeEdge, numbers[begin + SHAPE.longest]);
    // Half a unit in the last place of each of three coordinates, and half a step.
    storageBound = Math.max(storageBound, numbers[begin + SHAPE.reach] * 2 ** -24 + step / 2);
  }
  const schemes = Object.fromEntries(found.map((scheme) => [shapes.schemes[scheme], counts[scheme]]));
  storageBound *= Math.sqrt(3);
  return { ...cloud, schemes, nodeEdge, bound, storageBound, stored: { steps, floats } };
}
