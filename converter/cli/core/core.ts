import { type Fault, GromaError } from "@groma/georef";
import type { CloudStatistics } from "@groma/layer/sources";
import { coreFailed, runCore } from "./core-process.js";

export { CoreError, coreProgram } from "./core-process.js";

/** What `groma-core scan` tells of a file: its header and records as they stand, nothing interpreted. */
export interface Scan {
  readonly file: string;
  readonly fileSize: number;
  /** LAS version, e.g. `1.4`. */
  readonly version: string;
  readonly pointFormat: number;
  readonly points: number;
  /** Bytes per record. */
  readonly recordLength: number;
  readonly compressed: boolean;
  readonly copc: boolean;
  /** Source units per integer step. */
  readonly scale: readonly [number, number, number];
  readonly offset: readonly [number, number, number];
  /** Bounds as the header declares them, source units. */
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
  readonly systemIdentifier: string;
  readonly generatingSoftware: string;
  readonly creation: string | null;
  readonly extraBytes: readonly { readonly name: string; readonly type: string }[];
  /** Bit 4 of the global encoding: the coordinate reference system is declared as WKT, not as GeoTIFF keys. */
  readonly wktBit: boolean;
  readonly wkt?: string;
  readonly geoTiff?: { readonly directory: number[]; readonly doubles: number[]; readonly ascii: string };
  /** The records of user id `groma`: base64 of georeference and transformation, and the statistics. */
  readonly groma?: { readonly "1"?: string; readonly "2"?: ScanStatistics; readonly "3"?: string };
  /** How the checksums of the nodes were made; null where there are none. */
  readonly checksums: "CRC-32C" | null;
  /** Why a conversion would refuse the file, as far as that shows without reading its points. */
  readonly problem: Fault | null;
  readonly warnings: readonly string[];
}

/** The statistics record (docs/record.md). */
export type ScanStatistics = CloudStatistics;

/** What was found in a file whose points are all as they were written. */
export interface Verified {
  readonly points: number;
  /** Chunks, or blocks of uncompressed points. */
  readonly parts: number;
  /** Whether each was held against its checksum; otherwise its points were decoded. */
  readonly checksums: boolean;
}

/** What a conversion tells while it runs. */
export type CoreEvent =
  | { readonly event: "progress"; readonly stage: string; readonly done: number; readonly total: number }
  | { readonly event: "warning"; readonly text: string; readonly code?: string };

/** Bounds of the points themselves, source units; the same that the output's header gets. */
export interface PointBounds {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/** Files of the records that are made while a conversion runs. */
export interface RecordFiles {
  readonly record: string;
  readonly transformation?: string | undefined;
}

/** Makes the records once the bounds are known; the signal says that the conversion has ended without them. */
export type RecordMaker = (bounds: PointBounds, signal: AbortSignal) => Promise<RecordFiles>;

/** What a conversion made. */
export interface Conversion {
  readonly points: number;
  readonly nodes: number;
  readonly bytes: number;
  /** 8 where no colour exceeds 255 in its 16-bit field, null where there is no colour. */
  readonly rgbBits: 8 | 16 | null;
  readonly seconds: number;
}

/** What a conversion would do, from the headers of its inputs. */
export interface Plan {
  readonly inputs: number;
  readonly points: number;
  /** Bytes of a record of the output. */
  readonly recordLength: number;
  /** Estimate. */
  readonly levels: number;
  /** Cells of the coarse level that the points are distributed to. */
  readonly cells: number;
  /** Bytes that are used at most. */
  readonly memory: number;
  /** Bytes of temporary files in the worst case. */
  readonly tempBytes: number;
  readonly tempDir: string;
  /** Bytes free there. */
  readonly tempFree: number;
  /** Estimate, bytes. */
  readonly outputBytes: number;
  readonly sampling: string;
}

type Line =
  | CoreEvent
  | ({ event: "bounds" } & PointBounds)
  | ({ event: "done" } & Conversion)
  | ({ event: "plan" } & Plan);

/**
 * Header and records of a LAS or LAZ file.
 *
 * @throws CoreError INPUT_* when it is no such file
 */
export async function scanFile(file: string, signal?: AbortSignal): Promise<Scan> {
  let scan: Scan | undefined;
  const onLine = (line: Scan & { readonly event?: string }) => {
    scan = line;
    return undefined;
  };
  await runCore(["scan", file], onLine, signal);
  if (scan === undefined) throw coreFailed("no answer about the file");
  return withCheckedStatistics(scan);
}

/** The core passes on the statistics record as JSON that somebody wrote; one that is damaged is left out, and told. */
async function withCheckedStatistics(scan: Scan): Promise<Scan> {
  const { "2": statistics, ...records } = scan.groma ?? {};
  if (statistics === undefined) return scan;
  const { decodeStatistics } = await import("@groma/layer/sources");
  try {
    const bytes = new TextEncoder().encode(JSON.stringify(statistics));
    return { ...scan, groma: { ...records, "2": decodeStatistics(bytes, scan.file) } };
  } catch (error) {
    if (!(error instanceof GromaError)) throw error;
    return { ...scan, groma: records, warnings: [...scan.warnings, `${error.cause}; it is ignored`] };
  }
}

/**
 * Reads all points of a LAS or LAZ file and holds its chunks against their checksums.
 *
 * @throws CoreError INPUT_CHECKSUM where the file has checksums and a chunk another one, INPUT_CORRUPT where points
 * cannot be decoded, other INPUT_* codes as for a conversion
 */
export async function verifyFile(file: string, signal?: AbortSignal): Promise<Verified> {
  let verified: Verified | undefined;
  const onLine = (line: Verified & { readonly event?: string }) => {
    verified = line;
    return undefined;
  };
  await runCore(["verify", file], onLine, signal);
  if (verified === undefined) throw coreFailed("it ended without a result");
  return verified;
}

/**
 * Compresses a LAS file to LAZ, record by record; everything else is copied.
 *
 * @throws CoreError INPUT_*, OUTPUT_WRITE
 */
export async function compressFile(input: string, output: string, signal?: AbortSignal): Promise<void> {
  await runCore(["compress", input, output], () => undefined, signal);
}

/**
 * Runs a conversion to its end. Where the records cannot be made, the core is stopped and leaves nothing behind.
 *
 * @param args arguments of `groma-core convert`
 * @throws CoreError INPUT_*, OUTPUT_*, OPTION_*, TEMP_*, INTERRUPTED, and whatever `makeRecords` throws
 */
export async function convertFiles(
  args: readonly string[],
  onEvent: (event: CoreEvent) => void,
  makeRecords: RecordMaker,
  signal?: AbortSignal,
): Promise<Conversion> {
  let done: Conversion | undefined;
  const onLine = (line: Line, ended: AbortSignal) => {
    if (line.event === "bounds") return makeRecords(line, ended).then((files) => JSON.stringify(files));
    if (line.event === "done") done = line;
    else if (line.event === "progress" || line.event === "warning") onEvent(line);
    return undefined;
  };
  await runCore(["convert", "--wait-for-record", ...args], onLine, signal);
  if (done === undefined) throw coreFailed("it ended without a result");
  return done;
}

/**
 * What a conversion with these arguments would do; nothing is written.
 *
 * @param args arguments of `groma-core convert`
 * @throws CoreError as a conversion does before it reads points
 */
export async function planFiles(
  args: readonly string[],
  onEvent: (event: CoreEvent) => void,
  signal?: AbortSignal,
): Promise<Plan> {
  let plan: Plan | undefined;
  const onLine = (line: Line) => {
    if (line.event === "plan") plan = line;
    else if (line.event === "warning") onEvent(line);
    return undefined;
  };
  await runCore(["convert", "--dry-run", ...args], onLine, signal);
  if (plan === undefined) throw coreFailed("it ended without a plan");
  return plan;
}
