import { FormatError } from "../../errors/index.js";
import { badHierarchy, type HierarchyEntry } from "../contract/point-source.js";
import type { ByteRange } from "./copc-info.js";

/** Bytes of one entry of a hierarchy page (copc.io, "hierarchy VLR"). */
export const ENTRY_LENGTH = 32;

/** LAS coordinates are 32-bit integers: below 31 halvings a cube of an octree holds one of their steps. */
const MAX_DEPTH = 31;

/** Bytes that a chunk takes at most beyond twice those of its records: LAZ hardly makes anything longer. */
const CHUNK_SLACK = 2 ** 16;

/** Bytes that one page may take: 2^20 entries. */
const MAX_PAGE_LENGTH = ENTRY_LENGTH * 2 ** 20;

/** Where a chunk lies, and what its checksum must be. */
export interface ChunkRange extends ByteRange {
  readonly checksum?: number | undefined;
}

/** What entries are held against. */
export interface HierarchyLimits {
  /** Name of the file, for errors. */
  readonly file: string;
  /** Length of the file in bytes, where known. */
  readonly fileSize: number | undefined;
  /** Byte at which point data begins. */
  readonly pointsOffset: number;
  /** Number of points in the whole file. */
  readonly pointCount: number;
  /** Bytes per uncompressed record. */
  readonly recordLength: number;
}

/**
 * Holds the address of a page against the file before it is read.
 * @throws FormatError FORMAT_HIERARCHY, FORMAT_TRUNCATED
 */
export function checkPageAddress(page: ByteRange, limits: HierarchyLimits): void {
  const { offset, length } = page;
  if (length <= 0 || length % ENTRY_LENGTH !== 0 || length > MAX_PAGE_LENGTH || offset <= 0) {
    throw badHierarchy(limits.file, `a page of ${length} bytes at byte ${offset}`);
  }
  checkInside(page, limits);
}

/**
 * Reads a page of the hierarchy, entry by entry as they are taken; each is held against the file, so that nothing is
 * ever asked for that the file cannot hold, and so are all together: nodes that share bytes could unpack a small file
 * to any size.
 * @param checksums one for each entry, where the file has them
 * @throws FormatError FORMAT_HIERARCHY, FORMAT_TRUNCATED
 */
export function* entriesOfPage(
  bytes: Uint8Array,
  limits: HierarchyLimits,
  checksums?: Uint32Array,
): Generator<HierarchyEntry<ChunkRange>> {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let chunks = 0;
  for (let at = 0; at + ENTRY_LENGTH <= bytes.length; at += ENTRY_LENGTH) {
    const entry: HierarchyEntry<ChunkRange> = {
      depth: view.getInt32(at, true),
      x: view.getInt32(at + 4, true),
      y: view.getInt32(at + 8, true),
      z: view.getInt32(at + 12, true),
      address: {
        offset: Number(view.getBigUint64(at + 16, true)),
        length: view.getInt32(at + 24, true),
        checksum: checksums?.[at / ENTRY_LENGTH],
      },
      pointCount: view.getInt32(at + 28, true),
    };
    checkEntry(entry, limits);
    if (entry.pointCount > 0) chunks += entry.address.length;
    if (limits.fileSize !== undefined && chunks > limits.fileSize) {
      throw badHierarchy(limits.file, `chunks of ${chunks} bytes in a file of ${limits.fileSize}`);
    }
    yield entry;
  }
}

function checkEntry(entry: HierarchyEntry<ByteRange>, limits: HierarchyLimits): void {
  const { depth, x, y, z, address, pointCount } = entry;
  const name = () => `node ${depth}-${x}-${y}-${z}`;
  const edge = 2 ** depth;
  const inCube = (index: number) => index >= 0 && index < edge;
  if (depth < 0 || depth > MAX_DEPTH || !inCube(x) || !inCube(y) || !inCube(z)) {
    throw badHierarchy(limits.file, `${name()}, which no octree has`);
  }
  if (pointCount === -1) {
    checkPageAddress(address, limits);
    return;
  }
  if (pointCount < 0 || pointCount > limits.pointCount) {
    throw badHierarchy(limits.file, `${name()} with ${pointCount} points`);
  }
  if (pointCount === 0) return;
  const longest = 2 * pointCount * limits.recordLength + CHUNK_SLACK;
  if (address.length <= 0 || address.length > longest || address.offset < limits.pointsOffset) {
    throw badHierarchy(limits.file, `${name()} with ${address.length} bytes at byte ${address.offset}`);
  }
  checkInside(address, limits);
}

function checkInside(address: ByteRange, limits: HierarchyLimits): void {
  if (limits.fileSize !== undefined && address.offset + address.length > limits.fileSize) {
    throw new FormatError({
      code: "FORMAT_TRUNCATED",
      file: limits.file,
      cause: `its octree names byte ${address.offset + address.length}, the file ends at ${limits.fileSize}`,
      fix: "Copy or convert the file again",
    });
  }
}
