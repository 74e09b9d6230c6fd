import { MeasureError } from "../../../errors/index.js";
import { joined } from "../points/read-points.js";
import type { Progress, VolumeBase } from "./base.js";
import { cutAndFill, type RingVolume } from "./cut-and-fill.js";
import type { Sensitivities } from "./sensitivity.js";

/** A volume to be worked out, as it goes to a worker: nothing but numbers. */
export interface VolumeJob {
  /** x, y, z of the surface's points, metres in one plan. */
  readonly points: readonly Float64Array[];
  /** x, y, z of the ring's vertices. */
  readonly outline: Float64Array;
  readonly base:
    | Exclude<VolumeBase, { readonly kind: "surface" }>
    | { readonly points: readonly Float64Array[] };
}

/** What comes back. */
export interface VolumeSums {
  readonly whole: Pick<RingVolume, "cut" | "fill">;
  /** The same of every second point; undefined where these make no surface. */
  readonly half: Pick<RingVolume, "cut" | "fill"> | undefined;
  /** Square metres: of the ring, and of what of it the surface covers. */
  readonly area: number;
  readonly covered: number;
  readonly points: number;
  readonly sensitivities: Sensitivities;
}

/** Share of the work that the whole takes; the rest is for the half of the points. */
const WHOLE = 0.67;

/** @throws MeasureError MEASURE_VERTICES, MEASURE_CROSSING, MEASURE_SURFACE */
export function runVolumeJob({ points: parts, outline, base }: VolumeJob, onProgress: Progress): VolumeSums {
  const points = joined(parts);
  const against: VolumeBase = "kind" in base ? base : { kind: "surface", points: joined(base.points) };
  const {
    sensitivities,
    cut,
    fill,
    area,
    covered,
    points: count,
  } = wholeOf(points, outline, against, (share) => onProgress(WHOLE * share));
  const coarse = coarser(points, outline, against, (share) => onProgress(WHOLE + (1 - WHOLE) * share));
  onProgress(1);
  return {
    whole: { cut, fill },
    half: coarse && { cut: coarse.cut, fill: coarse.fill },
    ...{ area, covered, points: count, sensitivities },
  };
}

/** The whole, and none of its surfaces is kept. */
function wholeOf(...asked: Parameters<typeof cutAndFill>) {
  const { sensitivities, ...sums } = cutAndFill(...asked);
  return { ...sums, sensitivities: sensitivities() };
}

function coarser(
  points: Float64Array,
  ring: Float64Array,
  base: VolumeBase,
  onProgress: Progress,
): RingVolume | undefined {
  try {
    const other = base.kind === "surface" ? { ...base, points: everySecond(base.points) } : base;
    return cutAndFill(everySecond(points), ring, other, onProgress);
  } catch (thrown) {
    if (thrown instanceof MeasureError) return undefined;
    throw thrown;
  }
}

function everySecond(points: Float64Array): Float64Array {
  const half = new Float64Array(3 * Math.ceil(points.length / 6));
  for (let from = 0, to = 0; from < points.length; from += 6, to += 3) {
    half[to] = points[from];
    half[to + 1] = points[from + 1];
    half[to + 2] = points[from + 2];
  }
  return half;
}
