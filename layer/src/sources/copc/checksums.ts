import { FormatError } from "../../errors/index.js";
import type { ReadOptions } from "../bytes/byte-source.js";
import { readU64 } from "../las/las-header.js";
import { EVLR_HEADER, evlrEntry, type VlrEntry } from "../las/vlrs.js";
import type { CopcFile } from "./copc-file.js";
import type { ByteRange } from "./copc-info.js";
import { ENTRY_LENGTH } from "./hierarchy.js";

/** Bytes before the checksums: method, number, byte of the first entry of the hierarchy. */
const HEADER = 16;

/** The only method there is. */
const CRC_32C = 1;

/** Bytes of the file that have been read, from `begin` on. */
interface Part {
  readonly begin: number;
  readonly bytes: Uint8Array;
}

/** The checksums of a file's chunks: Groma's record 4 (docs/record.md), of which each page of the hierarchy takes its own. */
export class Checksums {
  readonly #file: CopcFile;
  /** Byte of the first checksum. */
  readonly #begin: number;
  readonly #count: number;
  /** The record's beginning. */
  readonly #known: Part;

  private constructor(file: CopcFile, begin: number, count: number, known: Part) {
    this.#file = file;
    this.#begin = begin;
    this.#count = count;
    this.#known = known;
  }

  /**
   * Finds the record. One before the points lies in what is read first of a file; one behind the points costs a
   * request, which brings the checksums of the root page too.
   * @returns undefined where there is none, or one that was made for another file
   * @throws SourceError, FormatError
   */
  static async open(file: CopcFile): Promise<Checksums | undefined> {
    const found = file.checksums ? await inFront(file, file.checksums) : await behindPoints(file);
    if (!found || found.entry.end - found.entry.begin < HEADER) return undefined;
    const { entry, known } = found;
    const { bytes } = known;
    const view = new DataView(bytes.buffer, bytes.byteOffset + entry.begin - known.begin, HEADER);
    const count = view.getUint32(4, true);
    const isOwn =
      view.getUint32(0, true) === CRC_32C &&
      readU64(view, 8, file.source.name) === file.info.rootPage.offset &&
      entry.end - entry.begin === HEADER + 4 * count;
    return isOwn ? new Checksums(file, entry.begin + HEADER, count, known) : undefined;
  }

  /**
   * The checksum of each entry of a page.
   * @throws SourceError; FormatError FORMAT_CHECKSUMS where the record has none for the page
   */
  async ofPage({ offset, length }: ByteRange, options: ReadOptions): Promise<Uint32Array> {
    const { source, info } = this.#file;
    const first = (offset - info.rootPage.offset) / ENTRY_LENGTH;
    const entries = length / ENTRY_LENGTH;
    if (!Number.isInteger(first) || first < 0 || first + entries > this.#count) {
      throw new FormatError({
        code: "FORMAT_CHECKSUMS",
        file: source.name,
        cause: `its octree has a page at byte ${offset} for which no checksums are stored`,
        fix: "Copy or download the file again, or convert the scan again",
      });
    }
    const begin = this.#begin + 4 * first;
    const end = begin + 4 * entries;
    const { begin: from, bytes: known } = this.#known;
    const isKnown = begin >= from && end <= from + known.length;
    const bytes = isKnown ? known.subarray(begin - from, end - from) : await source.read(begin, end, options);
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    return Uint32Array.from({ length: entries }, (_, index) => view.getUint32(4 * index, true));
  }
}

interface Found {
  readonly entry: VlrEntry;
  readonly known: Part;
}

async function inFront({ source }: CopcFile, entry: VlrEntry): Promise<Found> {
  const { begin, end } = entry;
  return { entry, known: { begin, bytes: await source.read(begin, end) } };
}

/** The first record behind the points, if it may be this one: it stands before the hierarchy, in files of Groma. */
async function behindPoints({ source, header, info, statistics }: CopcFile): Promise<Found | undefined> {
  const begin = header.evlrOffset;
  const { offset, length } = info.rootPage;
  const end = Math.min(offset, begin + EVLR_HEADER + HEADER + (4 * length) / ENTRY_LENGTH);
  if (!statistics || begin === 0 || begin + EVLR_HEADER + HEADER > end) return undefined;
  const bytes = await source.read(begin, end);
  const entry = evlrEntry(bytes, begin, source.name);
  return entry.userId === "groma" && entry.recordId === 4 ? { entry, known: { begin, bytes } } : undefined;
}
