import { sameHeights, samePlane, type Vector } from "@groma/georef";
import { MeasureError } from "../../../errors/index.js";
import { checkedRing } from "../figures/ring.js";
import { Plan } from "../points/local-plan.js";
import { readPoints, type SourceRectangle } from "../points/read-points.js";
import type { Vertex } from "../vertex/vertex.js";
import { cloudErrors, type PointError, type WorthOptions } from "../worth/point-errors.js";
import { type OwnError, type Quantity, quantity } from "../worth/quantity.js";
import { inWorker } from "./in-worker.js";
import type { Sensitivity } from "./sensitivity.js";
import { runVolumeJob, type VolumeJob, type VolumeSums } from "./volume-job.js";
import { checkVolumeOptions, type VolumeCloud, type VolumeOptions } from "./volume-options.js";

/** Volumes over a polygon. */
export interface Volume {
  /** Material above the base. */
  readonly cut: Quantity<"m³">;
  /** Material missing below it. */
  readonly fill: Quantity<"m³">;
  /** Cut less fill. */
  readonly net: Quantity<"m³">;
  /** Level area of the polygon, and the part of it that the points cover, square metres. */
  readonly area: number;
  readonly covered: number;
  /** Points of the surface. */
  readonly points: number;
  /**
   * Between two data sets, metres: differences of height below it are not told from none (95 %); null where the precision
   * or the accuracy of one of them is not known.
   */
  readonly levelOfDetection?: number | null | undefined;
}

/** Share of the polygon's extent around it from which points are taken too, so that the surface reaches its edge. */
const AROUND = 0.05;

/**
 * Volume between the surface of a data set's points and a base, over a polygon: cut, fill and their difference,
 * prismoidal over Delaunay's triangles, lengths in the level of the polygon.
 *
 * The surface has one height at each place: of points above each other one counts, so take the classes that are meant.
 * Its worth: the precision of the points of the surface, of those of the base and of the polygon's vertices, what two surfaces
 * may be off against each other, and what the surface may do between the points, told by how far half of them lead.
 *
 * The surfaces are made in a worker of their own; where there are none (Node), on the calling thread.
 *
 * @param ring vertices of the data set
 * @throws MeasureError MEASURE_OPTION, MEASURE_VERTICES, MEASURE_CROSSING, MEASURE_SURFACE, MEASURE_DATASET where the ring is of another
 *   data set, MEASURE_WORKER; SourceError, FormatError, DecodeError; the signal's reason when aborted
 */
export async function measureVolume(
  cloud: VolumeCloud,
  ring: readonly Vertex[],
  given: VolumeOptions = {},
): Promise<Volume> {
  const options = checkVolumeOptions(given, cloud.name);
  const { base = { kind: "lowest" }, signal, onProgress } = options;
  const classes = options.classes && new Set(options.classes);
  const corners = checkedRing(ring).map(({ cloud: of, source }) => {
    if (of === cloud && source) return source;
    throw new MeasureError({
      code: "MEASURE_DATASET",
      file: cloud.name,
      cause: "a vertex of the polygon does not stand on this data set",
      fix: "draw the polygon on the data set whose volume is measured",
    });
  });
  const plan = new Plan(cloud, corners);
  const outline = plan.take(Float64Array.from(corners.flat()));
  const other = base.kind === "cloud" ? base.cloud : undefined;
  if (other && !(samePlane(cloud.crs, other.crs) && sameHeights(cloud.crs, other.crs))) {
    throw new MeasureError({
      code: "MEASURE_DATASET",
      file: other.name,
      cause: `it has another coordinate or height system than ${cloud.name}`,
      fix: "convert one of them into the system of the other first",
    });
  }
  const steps = other ? 2 : 1;
  const rectangle = around(corners);
  const pointsOf = (of: VolumeCloud, step: number) =>
    readPoints(of, rectangle, {
      ...{ plan, classes, signal },
      onProgress: (share) => onProgress?.((0.5 * (step + share)) / steps),
    });
  const points = await pointsOf(cloud, 0);
  const against = base.kind === "cloud" ? { points: await pointsOf(base.cloud, 1) } : base;
  const job: VolumeJob = { points, outline, base: against };
  const sums = await worked(job, options);
  const { whole, half } = sums;
  const own = errorsOf(cloud, other, { ring, sums, precision: options.precision });
  const told = (value: number, coarse: number | undefined) =>
    quantity(value, "m³", [], { own: [...own, betweenPoints(value, coarse)] });
  return {
    cut: told(whole.cut, half?.cut),
    fill: told(whole.fill, half?.fill),
    net: told(whole.cut - whole.fill, half && half.cut - half.fill),
    ...{ area: sums.area, covered: sums.covered, points: sums.points },
    ...(other && { levelOfDetection: levelOfDetection(cloud, other, options) }),
  };
}

async function worked(job: VolumeJob, options: VolumeOptions): Promise<VolumeSums> {
  const { signal, onProgress, createWorker } = options;
  const told = (share: number) => onProgress?.(0.5 + 0.5 * share);
  if (createWorker || typeof Worker !== "undefined")
    return inWorker(job, { signal, createWorker, onProgress: told });
  signal?.throwIfAborted();
  return runVolumeJob(job, told);
}

/** The rectangle of a polygon with a margin. */
function around(corners: readonly Vector[]): SourceRectangle {
  const [[minX, maxX], [minY, maxY]] = ([0, 1] as const).map((axis) => {
    const values = corners.map((corner) => corner[axis]);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const margin = AROUND * (high - low);
    return [low - margin, high + margin] as const;
  });
  return [minX, minY, maxX, maxY];
}

/**
 * Half of the points, twice the square of their distance, twice the error of triangles: what the half is off by is about
 * what the whole is off by.
 */
function betweenPoints(whole: number, half: number | undefined): OwnError {
  const note = "what the surface may do between its points, by every second of them";
  return { name: "surface", standard: half === undefined ? null : Math.abs(whole - half), note };
}

/**
 * Errors of a volume: the heights of the points of the surface and of those that the base is made of (the polygon's vertices,
 * unless it is a height or another surface), the places of the polygon's vertices, and what two data sets are off by against
 * each other.
 */
function errorsOf(
  cloud: VolumeCloud,
  other: VolumeCloud | undefined,
  {
    ring,
    sums,
    precision,
  }: Pick<WorthOptions, "precision"> & {
    readonly ring: readonly Vertex[];
    readonly sums: VolumeSums;
  },
): OwnError[] {
  // What the same points are off by is no difference.
  if (other === cloud) return [{ name: "place", standard: 0, note: "the data set is held against itself" }];
  const { sensitivities, covered } = sums;
  const { ofRecords, ofPlaces } = cloudErrors(cloud, precision);
  const ofVertices = ring.every(({ record }) => record) ? ofRecords : ofPlaces;
  const ofBase = other ? cloudErrors(other, precision).ofRecords : ofRecords;
  const errors = new Map<string, OwnError>();
  const add = (among: readonly PointError[], { up: upwards, plan }: Sensitivity) => {
    if (upwards === 0 && plan === 0) return;
    for (const { name, known, up, horizontal, of, note } of among) {
      if (of === "place") continue;
      const before = errors.get(name)?.standard;
      const square = known && before !== null ? [before ?? 0, upwards * up, plan * horizontal] : undefined;
      errors.set(name, { name, standard: square ? Math.hypot(...square) : null, ...(note && { note }) });
    }
  };
  add(ofRecords, sensitivities.surface);
  add(ofBase, sensitivities.base);
  add(ofVertices, sensitivities.ring);
  const gaps = gapsIn(sums);
  if (!other) return [...errors.values(), ...gaps];
  const parts = [cloud, other].map(({ accuracy }) => accuracy.total);
  const apart = parts.every((total) => total !== null) ? covered * Math.hypot(...parts) : null;
  const note = "against each other, over the whole area";
  return [...errors.values(), { name: "place of both data sets", standard: apart, note }, ...gaps];
}

/** What is not known where there are no points. */
function gapsIn({ area, covered }: VolumeSums): OwnError[] {
  const share = 1 - covered / area;
  if (share < NO_GAP) return [];
  const percent = (100 * share).toPrecision(2);
  return [{ name: "gaps", standard: null, note: `${percent} % of the polygon have no points` }];
}

/** Share of a polygon that its edge may leave out. */
const NO_GAP = 1e-3;

/** 1.96 standard deviations of a difference of two heights (Lane, Westaway and Hicks 2003). */
function levelOfDetection(a: VolumeCloud, b: VolumeCloud, { precision }: WorthOptions): number | null {
  if (a === b) return 0;
  const deviations = [a, b].flatMap((cloud) => [precisionOf(cloud, precision), cloud.accuracy.total]);
  return deviations.every((one) => one !== null) ? 1.96 * Math.hypot(...deviations) : null;
}

/** Standard deviation of the heights of a data set's points, metres; null where it is not given. */
function precisionOf(cloud: VolumeCloud, given: WorthOptions["precision"]): number | null {
  const precision = typeof given === "function" ? given(cloud) : given;
  return typeof precision === "object" ? precision.vertical : (precision ?? null);
}
