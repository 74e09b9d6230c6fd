import type { ByteSource, ReadOptions } from "../bytes/byte-source.js";
import type { LasEnvelope, LasVariableRecord } from "../contract/point-source.js";
import type { LasHeader } from "./las-header.js";
import { EVLR_HEADER, readVlr, VLR_HEADER, type VlrEntry, walkEvlrs, walkVlrs } from "./vlrs.js";

/**
 * Records that do not go with a part of the points: how LAZ and COPC store them, and Groma's statistics (2),
 * checksums (4) and first page of the octree (5) of all of them (docs/record.md).
 */
const OF_THE_WHOLE: readonly (readonly [userId: string, recordIds: readonly number[] | "all"])[] = [
  ["laszip encoded", "all"],
  ["copc", "all"],
  ["groma", [2, 4, 5]],
];

/**
 * Reads header and variable length records of a LAS, LAZ or COPC file as bytes.
 * @throws SourceError, FormatError
 */
export async function readEnvelope(
  source: ByteSource,
  header: LasHeader,
  options: ReadOptions,
): Promise<LasEnvelope> {
  const { pointFormat, recordLength, pointsOffset } = header;
  const front = await source.read(0, pointsOffset, options);
  const headerLength = new DataView(front.buffer, front.byteOffset).getUint16(94, true);
  const records: LasVariableRecord[] = [];
  const take = async (entries: readonly VlrEntry[], extended: boolean) => {
    for (const entry of entries) {
      if (isOfTheWhole(entry)) continue;
      const { userId, recordId, begin } = entry;
      const content = (await readVlr(source, entry, options)) ?? new Uint8Array(0);
      const length = extended ? EVLR_HEADER : VLR_HEADER;
      const head = await source.read(begin - length, begin, options);
      records.push({ userId, recordId, extended, header: head.slice(), content: content.slice() });
    }
  };
  await take(walkVlrs(front, header, headerLength, source.name), false);
  await take(await walkEvlrs(source, header, options), true);
  return { header: front.slice(0, headerLength), pointFormat, recordLength, records };
}

function isOfTheWhole({ userId, recordId }: VlrEntry): boolean {
  return OF_THE_WHOLE.some(([id, ids]) => id === userId && (ids === "all" || ids.includes(recordId)));
}
