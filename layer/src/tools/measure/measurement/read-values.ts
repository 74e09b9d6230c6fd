import { MeasureError } from "../../../errors/index.js";
import { measureHeightAboveGround } from "../ground/height-above-ground.js";
import { measureHeightAboveTerrain, type Terrain } from "../ground/height-above-terrain.js";
import { datasetAmong, whyNotAmong } from "../vertex/dataset.js";
import type { MeasuredCloud, Vertex } from "../vertex/vertex.js";
import type { VolumeWorker } from "../volume/in-worker.js";
import { measureVolume } from "../volume/measure-volume.js";
import type { VolumeCloud, VolumeOptions } from "../volume/volume-options.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { quantity } from "../worth/quantity.js";
import { type Measurement, type NamedValue, value } from "./measurement.js";
import type { VolumeBaseSetting } from "./volume-settings.js";

/** What reading values needs. */
export interface ReadValuesOptions extends WorthOptions {
  /** Data sets that a volume may be measured against; its vertices' own need not be among them. */
  readonly clouds?: readonly MeasuredCloud[] | undefined;
  /** For heights above the ground: the terrain's is told too. */
  readonly terrain?: Terrain | undefined;
  /** Stops it; what is asked for ends with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  /** Hears the share of the work that is done, 0 to 1. */
  readonly onProgress?: ((share: number) => void) | undefined;
  /** Makes the worker of a volume; see `VolumeOptions`. */
  readonly createWorker?: (() => VolumeWorker) | undefined;
}

/** Whether a measurement has values that take reading points of the scan. */
export function readsPoints({ kind }: Pick<Measurement, "kind">): boolean {
  return kind === "volume" || kind === "aboveGround";
}

/**
 * The values of a measurement that take reading points of the scan: volumes, heights above the ground. None of the other
 * kinds.
 *
 * @throws MeasureError as `measureVolume` and `measureHeightAboveGround`, MEASURE_DATASET where a data set is not at hand;
 *   SourceError, FormatError, DecodeError; the signal's reason when aborted
 */
export async function readValues(
  measurement: Measurement,
  options: ReadValuesOptions = {},
): Promise<readonly NamedValue[]> {
  const { kind, vertices } = measurement;
  if (kind === "volume") return volumeValues(measurement, options);
  if (kind === "aboveGround") return groundValues(vertices[0], options);
  return [];
}

async function volumeValues(
  { vertices, volume: settings }: Measurement,
  { clouds = [], precision, signal, onProgress, createWorker }: ReadValuesOptions,
): Promise<readonly NamedValue[]> {
  const cloud = readable(vertices[0]);
  const { base = { kind: "lowest" }, classes } = settings ?? {};
  const options: VolumeOptions = {
    ...{ base: baseOf(base, clouds), classes: classes && new Set(classes) },
    ...{ precision, signal, onProgress, createWorker },
  };
  const found = await measureVolume(cloud, vertices, options);
  const { cut, fill, net, area, covered, levelOfDetection: level } = found;
  const share = quantity(covered / area, "1", []);
  return [
    value("net", "net", net),
    value("cut", "above it", cut),
    value("fill", "below it", fill),
    value("covered", "covered by points", share),
    ...(typeof level === "number"
      ? [value("levelOfDetection", "level of detection", quantity(level, "m", []))]
      : []),
  ];
}

function baseOf(base: VolumeBaseSetting, clouds: readonly MeasuredCloud[]): VolumeOptions["base"] {
  if (base.kind !== "cloud") return base;
  const cloud = datasetAmong(clouds, base);
  if (cloud && hasPoints(cloud)) return { kind: "cloud", cloud };
  const why = cloud ? "its points cannot be read" : whyNotAmong(clouds, base);
  throw notAtHand(base.dataset, `the volume is measured against it: ${why}`);
}

/** Above the points of the ground, and above a terrain where there is one; one of them will do. */
async function groundValues(
  vertex: Vertex,
  { precision, terrain, signal }: ReadValuesOptions,
): Promise<readonly NamedValue[]> {
  const options = { precision, signal };
  const asked = [measureHeightAboveGround(readable(vertex), vertex, options)];
  if (terrain) asked.push(measureHeightAboveTerrain(vertex, terrain, options));
  const [ground, above] = await Promise.allSettled(asked);
  signal?.throwIfAborted();
  const values = [
    ...(ground.status === "fulfilled"
      ? [value("aboveGround", "above the ground's points", ground.value)]
      : []),
    ...(above?.status === "fulfilled" ? [value("aboveTerrain", "above the terrain", above.value)] : []),
  ];
  if (values.length === 0) throw (ground as PromiseRejectedResult).reason;
  return values;
}

/** The data set that a vertex stands on, to read points of. */
function readable({ cloud, record }: Vertex): VolumeCloud {
  if (cloud && hasPoints(cloud)) return cloud;
  const name = record?.dataset ?? cloud?.name;
  throw name === undefined
    ? notAtHand("a vertex", "it stands on no data set, so there are no points to read")
    : notAtHand(name, "its points are needed, and it is not open");
}

function hasPoints(cloud: MeasuredCloud): cloud is VolumeCloud {
  return "query" in cloud && typeof cloud.query === "function";
}

function notAtHand(file: string, cause: string): MeasureError {
  return new MeasureError({
    code: "MEASURE_DATASET",
    file,
    cause,
    fix: "open the data set, then measure again",
  });
}
