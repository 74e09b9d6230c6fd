import type { Scan, ScanStatistics } from "../core/core.js";
import type { FileSource } from "../files/file-source.js";
import { fields } from "./fields.js";
import type { HeaderDetails } from "./header.js";
import type { Octree } from "./octree.js";

/** Statistics of some of the points, for a file that has none of all. */
export interface Sample {
  readonly statistics: ScanStatistics;
  /** Which points these are, in words: `first chunk`. */
  readonly of: string;
}

/** Uncompressed records, one after the other. */
interface Records {
  readonly bytes: Uint8Array;
  readonly count: number;
}

/** Points that are looked at. */
const MOST_POINTS = 100_000;
/** Bytes of uncompressed records that are looked at. */
const MOST_BYTES = 1 << 25;
/** Places of a LAS file that the points are taken from, evenly spread. */
const PLACES = 50;

/**
 * Looks at a bounded number of points: of LAS evenly spread ones, of COPC the coarsest nodes, which cover the whole, of
 * LAZ the first chunk, since the others cannot be found without reading all before them.
 *
 * @param octree of a COPC file; undefined for a file without
 * @returns nothing for point formats that cannot be decoded here, and for damaged data
 */
export async function sample(
  source: FileSource,
  scan: Scan,
  { pointsOffset, records }: HeaderDetails,
  octree: Octree | undefined,
): Promise<Sample | undefined> {
  const most = Math.min(MOST_POINTS, Math.floor(MOST_BYTES / scan.recordLength), scan.points);
  if (most === 0) return undefined;
  try {
    const [taken, of] = !scan.compressed
      ? [await spread(source, scan, pointsOffset, most), "evenly spread"]
      : octree && octree.nodes.length > 0
        ? [await coarse(octree, scan, most), "coarsest nodes"]
        : [await first(source, scan, pointsOffset, chunkSize(source, records), most), "first chunk"];
    const count = taken.reduce((sum, one) => sum + one.count, 0);
    return count > 0 ? { statistics: statisticsOf(scan, taken, count), of } : undefined;
  } catch {
    // Whether the points can be read is for a conversion to say.
    return undefined;
  }
}

async function spread(
  source: FileSource,
  scan: Scan,
  pointsOffset: number,
  most: number,
): Promise<Records[]> {
  const places = most === scan.points ? 1 : PLACES;
  const each = Math.floor(most / places);
  const taken: Records[] = [];
  for (let place = 0; place < places; place++) {
    const begin = pointsOffset + Math.floor((scan.points * place) / places) * scan.recordLength;
    const bytes = await source.upTo(begin, begin + each * scan.recordLength);
    taken.push({ bytes, count: Math.floor(bytes.length / scan.recordLength) });
  }
  return taken;
}

async function coarse({ source, nodes }: Octree, scan: Scan, most: number): Promise<Records[]> {
  const [{ decodeChunk }, { checkChecksum }] = await Promise.all([
    import("./decode.js"),
    import("@groma/layer/sources"),
  ]);
  const taken: Records[] = [];
  let count = 0;
  for (const { depth, x, y, z, address, pointCount } of nodes) {
    if (count + pointCount > most && count > 0) break;
    const { bytes, checksum } = await source.chunk(address);
    const chunk = new Uint8Array(bytes);
    checkChecksum(chunk, checksum, { file: source.name, node: [depth, x, y, z].join("-") });
    const points = Math.min(pointCount, most);
    taken.push({ bytes: await decodeChunk(chunk, scan, points), count: points });
    count += points;
  }
  return taken;
}

async function first(
  source: FileSource,
  scan: Scan,
  pointsOffset: number,
  chunk: Promise<number>,
  most: number,
): Promise<Records[]> {
  const { decodeChunk } = await import("./decode.js");
  const count = Math.min(most, await chunk);
  if (count === 0) return [];
  // The point data begin with the place of the chunk table. A chunk hardly outgrows its records.
  const begin = pointsOffset + 8;
  const bytes = await source.upTo(begin, begin + count * scan.recordLength * 2 + 4096);
  return [{ bytes: await decodeChunk(bytes, scan, count), count }];
}

/** Points of the first chunk by the record of LASzip; 0 where chunks differ in size or there is no such record. */
async function chunkSize(source: FileSource, records: HeaderDetails["records"]): Promise<number> {
  const record = records.find(({ userId, recordId }) => userId === "laszip encoded" && recordId === 22204);
  if (!record || record.bytes < 16) return 0;
  const bytes = await source.read(record.begin, record.begin + 16);
  const size = new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true);
  return size === 0xffffffff ? 0 : size;
}

function statisticsOf(scan: Scan, taken: readonly Records[], points: number): ScanStatistics {
  const classes: Record<number, number> = {};
  const returns: Record<number, number> = {};
  const tallies = new Map([
    ["classification", classes],
    ["returnNumber", returns],
  ]);
  const attributes = fields(scan).map((field) => {
    const tally = tallies.get(field.name);
    let [min, max, sum, count] = [Infinity, -Infinity, 0, 0];
    for (const { bytes, count: records } of taken) {
      const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
      for (let record = 0; record < records; record++) {
        const value = field.read(view, record);
        if (tally) tally[value] = (tally[value] ?? 0) + 1;
        if (!Number.isFinite(value)) continue;
        if (value < min) min = value;
        if (value > max) max = value;
        sum += value;
        count++;
      }
    }
    // A sum of many equal values may round to a mean just outside of them.
    return { name: field.name, min, max, mean: Math.min(max, Math.max(min, sum / count)) };
  });
  const known = attributes.filter(({ mean }) => Number.isFinite(mean));
  const brightest = Math.max(
    0,
    ...known.filter(({ name }) => /^(red|green|blue)$/.test(name)).map(({ max }) => max),
  );
  const rgbBits = brightest === 0 ? null : brightest > 255 ? 16 : 8;
  return { points, rgbBits, attributes: known, classes, returns };
}
