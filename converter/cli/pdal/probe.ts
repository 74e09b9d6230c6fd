import { PdalError } from "./errors.js";
import type { Pdal } from "./find.js";
import { type Job, typeOf } from "./pipeline.js";
import { complaint, failed, runPdal } from "./run.js";

/** One dimension of the points of a job, as PDAL has it. */
export interface Dimension {
  readonly name: string;
  readonly type: "floating" | "signed" | "unsigned";
  /** Bytes. */
  readonly size: number;
  readonly min: number;
  readonly max: number;
}

/** What a job gives, from a first pass over all its points. */
export interface Probe {
  readonly job: Job;
  readonly points: number;
  /** Bounds of the points themselves, source units; to ten digits. */
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
  readonly dimensions: readonly Dimension[];
  /** Empty where PDAL knows no coordinate reference system. */
  readonly wkt: string;
  /** Whether PDAL passes the points through, or holds all of them in memory. */
  readonly streamed: boolean;
  /** Types of the readers, e.g. `readers.e57`. */
  readonly readers: readonly string[];
  /** Scale and offset that all readers agree on, where they read LAS. */
  readonly stored?: Stored | undefined;
}

/** How coordinates are stored, source units per axis: coordinate = integer · scale + offset. */
export interface Stored {
  readonly scale: readonly [number, number, number];
  readonly offset: readonly [number, number, number];
}

interface Statistic {
  readonly name: string;
  readonly average: number | string;
  readonly minimum: number;
  readonly maximum: number;
}

interface Metadata {
  readonly stages: {
    readonly "filters.stats": { readonly statistic: readonly Statistic[] };
    readonly "filters.info": {
      readonly num_points: number;
      readonly schema: {
        readonly dimensions: readonly { name: string; type: Dimension["type"]; size: number }[];
      };
      readonly srs: { readonly compoundwkt?: string; readonly wkt?: string };
    };
    readonly [stage: string]: unknown;
  };
}

/** What PDAL says when a stage needs all points at once. */
const NOT_STREAMABLE = /requested execution mode|not streamable|stream mode/i;

/**
 * Passes over the points of a job: how many, where, with which dimensions and in which system they are.
 *
 * @throws PdalError PDAL_FAILED, PDAL_EMPTY, PDAL_COORDINATES
 */
export async function probe(pdal: Pdal, job: Job, signal?: AbortSignal): Promise<Probe> {
  const stages = [...job.stages, { type: "filters.stats" }, { type: "filters.info" }];
  const run = (...mode: string[]) =>
    runPdal(
      pdal.program,
      ["pipeline", "--stdin", "--metadata", "STDOUT", ...mode],
      JSON.stringify({ pipeline: stages }),
      signal,
    );
  let outcome = await run("--stream");
  const streamed = outcome.status === 0 || !NOT_STREAMABLE.test(outcome.stderr);
  if (!streamed) outcome = await run();
  if (outcome.status !== 0) throw failed(job.name, complaint(outcome));
  return described(job, metadataOf(job, outcome.stdout), streamed);
}

function metadataOf(job: Job, text: string): Metadata {
  try {
    return JSON.parse(text.slice(text.indexOf("{"))) as Metadata;
  } catch {
    throw failed(job.name, "PDAL's metadata cannot be read");
  }
}

function described(job: Job, { stages }: Metadata, streamed: boolean): Probe {
  const { num_points: points, schema, srs } = stages["filters.info"];
  if (points === 0) {
    throw new PdalError({
      ...{ code: "PDAL_EMPTY", file: job.name, cause: "PDAL found no points in it" },
      fix: "give a file with points, or a pipeline that keeps some",
    });
  }
  const statistics = new Map(stages["filters.stats"].statistic.map((one) => [one.name, one]));
  const axes = ["X", "Y", "Z"].map((name) => statistics.get(name));
  if (
    axes.some(
      (axis) => axis === undefined || ![axis.average, axis.minimum, axis.maximum].every(Number.isFinite),
    )
  ) {
    throw new PdalError({
      ...{ code: "PDAL_COORDINATES", file: job.name, cause: "some coordinates are not finite numbers" },
      fix: 'remove these points with --pipeline and {"type": "filters.range", "limits": "X[-1e9:1e9]"}',
    });
  }
  const three = (get: (axis: Statistic) => number) =>
    axes.map((axis) => get(axis!)) as unknown as [number, number, number];
  const readers = Object.keys(stages).filter((name) => name.startsWith("readers."));
  return {
    ...{ job, points, streamed, readers },
    min: three((axis) => axis.minimum),
    max: three((axis) => axis.maximum),
    dimensions: schema.dimensions.map(({ name, type, size }) => {
      const { minimum = 0, maximum = 0 } = statistics.get(name) ?? {};
      return { name, type, size, min: minimum, max: maximum };
    }),
    wkt: (srs.compoundwkt || srs.wkt || "").trim(),
    stored: keepsCoordinates(job) ? storedAlike(stages, readers) : undefined,
  };
}

/** Filters of PDAL that pass coordinates on as they are, or leave points out. */
const KEEPING = new RegExp(
  `^filters\\.(${[
    ...["cluster", "colorinterp", "colorization", "covariancefeatures", "crop", "csf", "dbscan"],
    ...["decimation", "eigenvalues", "elm", "estimaterank", "expression", "fps", "groupby", "hag_.*", "head"],
    ...["hexbin", "info", "iqr", "litree", "locate", "lof", "mad", "merge", "mongo", "mortonorder"],
    ...[
      "neighborclassifier",
      "nndistance",
      "normal",
      "outlier",
      "overlay",
      "planefit",
      "pmf",
      "radialdensity",
    ],
    ...[
      "randomize",
      "range",
      "reciprocity",
      "returns",
      "sample",
      "skewnessbalancing",
      "smrf",
      "sort",
      "stats",
    ],
    ...["streamcallback", "tail", "voxelcenternearestneighbor"],
  ].join("|")})$`,
);

function keepsCoordinates({ stages }: Job): boolean {
  return stages.every((stage) => {
    const type = typeOf(stage);
    if (type === "filters.assign") return !/\b[XYZ]\b/.test(JSON.stringify(stage));
    return !type.startsWith("filters.") || KEEPING.test(type);
  });
}

/** What PDAL tells of a reader of LAS, as far as it is used. */
type ReaderMetadata = Readonly<Record<`${"scale" | "offset"}_${"x" | "y" | "z"}`, unknown>>;

/** The scale and offset of readers of LAS, if there are no others and all of them agree. */
function storedAlike(stages: Metadata["stages"], readers: readonly string[]): Stored | undefined {
  if (readers.length !== 1 || !/^readers\.(las|copc)$/.test(readers[0]!)) return undefined;
  const entry = Object.entries(stages).find(([name]) => name === readers[0]);
  const all = [entry?.[1]].flat() as ReaderMetadata[];
  const three = (what: "scale" | "offset") => (one: ReaderMetadata) =>
    (["x", "y", "z"] as const).map((axis) => Number(one[`${what}_${axis}`])) as unknown as [
      number,
      number,
      number,
    ];
  const [first] = all;
  if (first === undefined) return undefined;
  const stored = { scale: three("scale")(first), offset: three("offset")(first) };
  const text = JSON.stringify(stored);
  const alike = all.every(
    (one) => JSON.stringify({ scale: three("scale")(one), offset: three("offset")(one) }) === text,
  );
  const whole = [...stored.scale, ...stored.offset].every(isWhole);
  return alike && whole && stored.scale.every((scale) => scale > 0) ? stored : undefined;
}

/** Whether PDAL, which writes ten digits, has not cut the number off. */
function isWhole(value: number): boolean {
  return Number.isFinite(value) && Number(value.toPrecision(9)) === value;
}
