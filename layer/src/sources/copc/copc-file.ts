import type { GeoTiffKeys } from "@groma/georef";
import type { ByteSource, ReadOptions } from "../bytes/byte-source.js";
import type { KnownParts } from "../bytes/known-parts.js";
import type { CrsDeclaration } from "../contract/point-source.js";
import type { CloudStatistics } from "../contract/statistics.js";
import { type ExtraBytes, parseExtraBytes } from "../las/extra-bytes.js";
import {
  BASE_RECORD_LENGTH,
  badHeader,
  type LasHeader,
  parseLasHeader,
  truncated,
} from "../las/las-header.js";
import { findVlr, readVlr, type VlrEntry, walkEvlrs, walkVlrs } from "../las/vlrs.js";
import { type ByteRange, COPC_INFO_END, type CopcInfo, checkCube, parseCopcInfo } from "./copc-info.js";
import { copiedPage, type FirstPage } from "./first-page.js";
import { checkPageAddress, type HierarchyLimits } from "./hierarchy.js";
import { decodeStatistics } from "./statistics-record.js";

/** Everything a COPC file says about itself before any point is read. */
export interface CopcFile {
  readonly source: ByteSource;
  readonly header: LasHeader;
  readonly info: CopcInfo;
  /**
   * The coordinate system as it is declared: WKT (VLR or extended VLR LASF_Projection 2112), GeoTIFF keys (34735 to
   * 34737), and Groma's records (VLR `groma` 1; VLR or extended VLR `groma` 3).
   */
  readonly crs: CrsDeclaration;
  /** Groma's statistics record (VLR `groma` 2). */
  readonly statistics?: CloudStatistics;
  /** What the extra bytes of each record hold (LASF_Spec 4); empty where they are not described. */
  readonly extraBytes: readonly ExtraBytes[];
  /** Where Groma's record of checksums stands (VLR `groma` 4); undefined also where it is not known yet. */
  readonly checksums: VlrEntry | undefined;
  /** The root page of the hierarchy, where it stands before the points as well (VLR `groma` 5). */
  readonly firstPage: FirstPage | undefined;
  readonly limits: HierarchyLimits;
}

const PROJECTION = "LASF_Projection";

/** Bytes before the points that are read at most: a few records of 64 KiB are usual, a header that says more is damaged. */
const MAX_POINTS_OFFSET = 64 * 1024 * 1024;

/** Bytes behind the points that are read in one go, for what stands there. */
const BEHIND = 256 * 1024;

/**
 * Reads header, VLRs and COPC info. With an HTTP source of the usual kind this costs no request beyond the
 * opening one: everything lies in what that brings. Where something of it stands behind the points, one more request
 * brings that together with the root page.
 * @throws SourceError, FormatError
 */
export async function openCopc(source: KnownParts, options: ReadOptions = {}): Promise<CopcFile> {
  const file = source.name;
  const opening = await source.read(0, Math.min(COPC_INFO_END, source.size ?? COPC_INFO_END), options);
  const header = parseLasHeader(opening, file);
  const info = parseCopcInfo(opening, file);
  checkCube(info, header, file);
  if (source.size !== undefined && header.pointsOffset > source.size) throw truncated(file, "its records");
  if (header.pointsOffset < COPC_INFO_END || header.pointsOffset > MAX_POINTS_OFFSET) {
    throw badHeader(file, "offset to the points");
  }
  const limits: HierarchyLimits = {
    file,
    fileSize: source.size,
    pointsOffset: header.pointsOffset,
    pointCount: header.pointCount,
    recordLength: header.recordLength,
  };
  checkPageAddress(info.rootPage, limits);
  const bytes = await source.read(0, header.pointsOffset, options);
  const headerLength = new DataView(bytes.buffer, bytes.byteOffset).getUint16(94, true);
  const entries = walkVlrs(bytes, header, headerLength, file);
  const copy = findVlr(entries, "groma", 5);
  const firstPage = copy && copiedPage(bytes.subarray(copy.begin, copy.end), info, file);
  const spread = isSpreadOut(entries, header);
  if (spread || !firstPage) await readBehind(source, header, info.rootPage, { ...options, spread });
  if (spread) entries.push(...(await walkEvlrs(source, header, options)));
  const checksums = findVlr(entries, "groma", 4);
  return {
    source,
    header,
    info,
    limits,
    checksums,
    firstPage,
    ...(await readRecords(source, header, entries, options)),
  };
}

/**
 * Whether what the file says of its coordinates may go on behind the points. Extended records cost requests, so they
 * are only walked where the file does not say its CRS up front, or where a transformation too long for a VLR may
 * follow Groma's record. The hierarchy of a COPC file is an extended record itself: one alone is that. A file with a
 * copy of its first page has checksums; where they do not stand in front, they are the other one.
 */
function isSpreadOut(entries: readonly VlrEntry[], { evlrCount }: LasHeader): boolean {
  if (findVlr(entries, "groma", 1)) {
    const checksumsBehind = findVlr(entries, "groma", 5) && !findVlr(entries, "groma", 4);
    return !findVlr(entries, "groma", 3) && evlrCount > (checksumsBehind ? 2 : 1);
  }
  return !findVlr(entries, PROJECTION, 2112);
}

/** Reads the root page ahead, and with it the extended records around it as far as they are short. */
async function readBehind(
  source: KnownParts,
  { evlrOffset }: LasHeader,
  { offset, length }: ByteRange,
  { spread, ...options }: ReadOptions & { readonly spread: boolean },
): Promise<void> {
  const isNear = evlrOffset > 0 && Math.abs(offset - evlrOffset) + length <= BEHIND;
  const begin = isNear ? Math.min(offset, evlrOffset) : offset;
  const end = offset + length;
  // A source whose size is not known may end right behind the page.
  const further = spread && isNear && source.size !== undefined ? Math.min(source.size, begin + BEHIND) : end;
  await source.readAhead(begin, Math.max(end, further), options);
}

type Records = Pick<CopcFile, "crs" | "statistics" | "extraBytes">;

async function readRecords(
  source: ByteSource,
  { pointFormat, recordLength, wktBit }: LasHeader,
  entries: readonly VlrEntry[],
  options: ReadOptions,
): Promise<Records> {
  const content = (userId: string, id: number) => readVlr(source, findVlr(entries, userId, id), options);
  const wkt = await content(PROJECTION, 2112);
  const directory = await content(PROJECTION, 34735);
  const georeference = await content("groma", 1);
  const transformation = await content("groma", 3);
  const statistics = await content("groma", 2);
  const extraBytes = await content("LASF_Spec", 4);
  return {
    crs: {
      las: { pointFormat, wktBit },
      // LAS allows WKT to end with NULs.
      ...(wkt && {
        wkt: new TextDecoder()
          .decode(wkt)
          .replace(/\0[\s\S]*$/, "")
          .trim(),
      }),
      ...(directory && {
        geoTiff: geoTiffKeys(directory, await content(PROJECTION, 34736), await content(PROJECTION, 34737)),
      }),
      ...(georeference && { georeference }),
      // A copy: what goes to the workers takes its whole buffer along, here that of the opening read.
      ...(transformation && { transformation: transformation.slice() }),
    },
    extraBytes: extraBytes ? parseExtraBytes(extraBytes, recordLength - BASE_RECORD_LENGTH[pointFormat]) : [],
    ...(statistics && { statistics: decodeStatistics(statistics, source.name) }),
  };
}

/** The three GeoTIFF records as typed arrays; a copy, since VLR contents are not aligned. */
function geoTiffKeys(directory: Uint8Array, doubles?: Uint8Array, ascii?: Uint8Array): GeoTiffKeys {
  const whole = (bytes: Uint8Array, size: number) =>
    bytes.slice(0, bytes.length - (bytes.length % size)).buffer as ArrayBuffer;
  return {
    directory: new Uint16Array(whole(directory, 2)),
    doubles: doubles ? new Float64Array(whole(doubles, 8)) : new Float64Array(0),
    // The keys address characters by their byte.
    ascii: ascii ? new TextDecoder("latin1").decode(ascii) : "",
  };
}
