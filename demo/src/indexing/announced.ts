import { changed, IndexError } from "./index-error.js";

/** Most points of a scan that the page indexes. */
const MOST_POINTS = 10_000_000;

/** Most bytes that its records may have in all, uncompressed: they are in memory while they get their nodes. */
const MOST_BYTES = 1 << 30;

/** Length of the header of LAS 1.4 (R15, 2.4), bytes. */
const HEADER = 375;

const words = (count: number | bigint) => count.toLocaleString("en");

/**
 * Refuses a scan that is too large for the page, by what its header announces. Nothing else of it is read.
 * @throws IndexError INDEX_POINTS, SOURCE_CHANGED
 */
export async function checkAnnounced(scan: File): Promise<void> {
  const bytes = await scan
    .slice(0, HEADER)
    .arrayBuffer()
    .catch((thrown: unknown) => {
      throw changed(scan.name, thrown instanceof Error ? thrown.name : "unknown");
    });
  const header = new DataView(bytes);
  // What is too short for a header is the core's to refuse.
  if (header.byteLength < 111) return;
  const recordLength = header.getUint16(105, true);
  const legacy = BigInt(header.getUint32(107, true));
  const isLong = header.getUint8(24) === 1 && header.getUint8(25) >= 4 && header.byteLength >= 255;
  const points = (isLong && header.getBigUint64(247, true)) || legacy;
  const inAll = points * BigInt(recordLength);
  if (points <= MOST_POINTS && inAll <= MOST_BYTES) return;
  throw new IndexError({
    code: "INDEX_POINTS",
    file: scan.name,
    cause:
      points > MOST_POINTS
        ? `it has no octree, and ${words(points)} points; the page itself indexes up to ${words(MOST_POINTS)}`
        : `it has no octree, and ${words(inAll)} bytes of points; the page itself indexes up to ${words(MOST_BYTES)}`,
    fix: "Convert it: groma convert IN OUT.copc.laz",
  });
}
