import { type AccuracyPart, CrsError } from "@groma/georef";
import { type Scan, type ScanStatistics, scanFile, type Verified, verifyFile } from "../core/core.js";
import { FileSource } from "../files/file-source.js";
import { type GeodeticBounds, geodeticBounds } from "../place/describe.js";
import { type Placed, placed } from "../place/placed.js";
import { type Whereabouts, whereabouts } from "../place/whereabouts.js";
import { count, counted } from "../terminal/output.js";
import { type GpsSpan, gpsSpan } from "./gps-time.js";
import { type HeaderDetails, headerDetails } from "./header.js";
import type { Octree } from "./octree.js";
import { sample } from "./sample.js";

/** What `groma info` knows of a file. */
export interface Inspection {
  readonly scan: Scan;
  readonly header: HeaderDetails;
  /** Undefined where the file says nothing, `problem` then tells. */
  readonly place: Placed | undefined;
  readonly problem: CrsError | undefined;
  readonly bounds: GeodeticBounds | undefined;
  readonly whereabouts: Whereabouts;
  readonly accuracy: readonly AccuracyPart[];
  /** Of all points, from the file's record, or of a sample; undefined where neither can be had. */
  readonly statistics: ScanStatistics | undefined;
  /** Which points the statistics are of, in words; undefined where they are of all of them. */
  readonly sampled: string | undefined;
  readonly gps: GpsSpan | undefined;
  /** Undefined for a file without octree, and for one whose octree is damaged. */
  readonly octree: Octree | undefined;
  /** What reading all points has shown; undefined where that was not asked for. */
  readonly verified: Verified | undefined;
  /** What is wrong with the octree. */
  readonly octreeProblem: string | undefined;
}

/**
 * Reads header, records, octree and, where the file has no statistics of its own, some of the points: a bounded amount,
 * whatever the size of the file.
 *
 * @param verify reads all points besides
 * @throws CoreError INPUT_*; RecordError
 */
export async function inspect(file: string, verify = false): Promise<Inspection> {
  const declared = await scanFile(file);
  const verified = verify ? await verifyFile(file) : undefined;
  const source = await FileSource.open(file);
  try {
    const header = await headerDetails(source);
    const { octree, octreeProblem } = declared.copc ? await octreeOf(source) : noOctree;
    const scan = checked(declared, header, octree);
    const whole = scan.groma?.["2"];
    const taken = whole ? undefined : await sample(source, scan, header, octree);
    const statistics = whole ?? taken?.statistics;
    const time = statistics?.attributes.find(({ name }) => name === "gpsTime");
    return {
      ...{ scan, verified, header, octree, octreeProblem, statistics, sampled: taken?.of },
      gps: gpsSpan(header.gpsTime, time),
      ...(await placeOf(scan)),
    };
  } finally {
    await source.close();
  }
}

const nowhere: Whereabouts = { centre: undefined, notes: [] };

/** The scan as its header declares it, but for what the octree proves wrong, and what is not in the file. */
function checked(declared: Scan, { pointsOffset }: HeaderDetails, octree: Octree | undefined): Scan {
  const { compressed, points, fileSize, recordLength } = declared;
  const there = Math.max(0, Math.floor((fileSize - pointsOffset) / recordLength));
  const short = `the header declares ${counted(points, "point")}, the file holds ${count(there)}: it is incomplete`;
  const isShort = !compressed && there < points;
  const scan = isShort ? { ...declared, warnings: [...declared.warnings, short] } : declared;
  if (!octree || octree.source.warnings.length === 0) return scan;
  const { boundingBox, warnings } = octree.source;
  const { min, max } = boundingBox;
  return { ...scan, min, max, warnings: [...scan.warnings, ...warnings.map(({ message }) => message)] };
}

const noOctree = { octree: undefined, octreeProblem: undefined } as const;

async function octreeOf(source: FileSource): Promise<Pick<Inspection, "octree" | "octreeProblem">> {
  const [{ openSource }, { octree }] = await Promise.all([
    import("@groma/layer/sources"),
    import("./octree.js"),
  ]);
  try {
    return { octree: await octree(await openSource(source)), octreeProblem: undefined };
  } catch (error) {
    // Everything else that is known of the file is worth telling all the same.
    return { octree: undefined, octreeProblem: error instanceof Error ? error.message : String(error) };
  }
}

type Place = Pick<Inspection, "place" | "problem" | "bounds" | "whereabouts" | "accuracy">;

async function placeOf(scan: Scan): Promise<Place> {
  try {
    const place = await placed(scan);
    const bounds = geodeticBounds(scan, place.truth);
    const where = scan.points > 0 ? whereabouts(place.crs, place.truth, scan) : nowhere;
    // A bound of an error is worth nothing where there is no place at all.
    const accuracy = bounds || scan.points === 0 ? place.accuracy : [];
    return { place, problem: undefined, bounds, whereabouts: where, accuracy };
  } catch (error) {
    if (!(error instanceof CrsError)) throw error;
    return { place: undefined, problem: error, bounds: undefined, whereabouts: nowhere, accuracy: [] };
  }
}
