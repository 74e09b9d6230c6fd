import { badHeader, type LasHeader, notCopc, readText, readU64 } from "../las/las-header.js";

/** Where COPC 1.0 puts the content of its info VLR: 375 bytes of header and 54 of VLR header. */
const COPC_INFO_BEGIN = 429;
/** Byte after the info VLR's content. */
export const COPC_INFO_END = COPC_INFO_BEGIN + 160;

/** The info VLR of COPC 1.0 (copc.io, "info VLR"). */
export interface CopcInfo {
  /** Centre of the root cube, source units. */
  readonly center: readonly [number, number, number];
  /** Half the root cube's edge, source units. */
  readonly halfSize: number;
  /** Distance between points at the root node, source units; halved at each level. */
  readonly spacing: number;
  /** Root page of the hierarchy, in bytes from the file's start. */
  readonly rootPage: ByteRange;
}

/** Where a page of the hierarchy or a chunk of points lies: bytes from the file's start. */
export interface ByteRange {
  readonly offset: number;
  readonly length: number;
}

/**
 * Reads the COPC info VLR.
 * @param bytes at least {@link COPC_INFO_END} bytes from the file's start
 * @throws FormatError FORMAT_NOT_COPC, FORMAT_HEADER
 */
export function parseCopcInfo(bytes: Uint8Array, file: string): CopcInfo {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const vlr = 375;
  const present =
    bytes.length >= COPC_INFO_END &&
    readText(bytes, vlr + 2, 16) === "copc" &&
    view.getUint16(vlr + 18, true) === 1 &&
    view.getUint16(vlr + 20, true) === 160;
  if (!present) throw notCopc(file, "this is a LAZ file without a COPC octree");
  const number = (index: number) => view.getFloat64(COPC_INFO_BEGIN + 8 * index, true);
  const info: CopcInfo = {
    center: [number(0), number(1), number(2)],
    halfSize: number(3),
    spacing: number(4),
    rootPage: {
      offset: readU64(view, COPC_INFO_BEGIN + 40, file),
      length: readU64(view, COPC_INFO_BEGIN + 48, file),
    },
  };
  if (!info.center.every(Number.isFinite)) throw badHeader(file, "octree centre");
  if (!Number.isFinite(info.halfSize) || info.halfSize < 0) throw badHeader(file, "octree size");
  if (!Number.isFinite(info.spacing) || info.spacing < 0) throw badHeader(file, "octree spacing");
  return info;
}

/** Steps of the integers of LAS that an octree may be wide, or its centre away from their origin: twice as many as there are. */
const MOST_STEPS = 2 ** 33;

/**
 * Holds the octree's cube against what integers of 32 bits can reach.
 * @throws FormatError FORMAT_HEADER
 */
export function checkCube(
  { center, halfSize }: CopcInfo,
  { scale, offset }: Pick<LasHeader, "scale" | "offset">,
  file: string,
): void {
  if (2 * halfSize > MOST_STEPS * Math.max(...scale)) throw badHeader(file, `octree size (${2 * halfSize})`);
  const reaches = center.every(
    (middle, axis) => Math.abs(middle - offset[axis]) <= MOST_STEPS * scale[axis] + halfSize,
  );
  if (!reaches) throw badHeader(file, `octree centre (${center.join(", ")})`);
}
