import type { GeoTiffKeys, LasDeclaration } from "@groma/georef";
import { FormatError } from "../../errors/index.js";
import type { ReadOptions } from "../bytes/byte-source.js";
import type { ServerWait } from "../bytes/host-schedule.js";
import type { PointAttribute } from "./point-attribute.js";
import type { CloudStatistics } from "./statistics.js";

export type { ServerWait } from "../bytes/host-schedule.js";

/**
 * One data set in a format of point clouds: what it says of itself before any point is read, the pages of its octree,
 * and the encoded points of each node. Whoever draws, queries or exports a data set knows no more of its format.
 *
 * `Address` is where the source finds a page or a node's points: a token that others keep and hand back, and never
 * look into. `Encoding` tells by its `kind` which decoder turns a chunk into points, and is all that the decoder needs
 * to know; it goes to the workers, so it must survive `postMessage`.
 */
export interface PointSource<Address = unknown, Encoding extends AnyEncoding = AnyEncoding> {
  /** Address or file name, for errors and to be shown. */
  readonly name: string;
  readonly pointCount: number;
  /** What tells its points from those of other data sets, whatever these are called. The same whenever it is opened. */
  readonly identity: string;
  /** Box that holds all points as far as is known without reading them, source coordinates. */
  readonly boundingBox: SourceBox;
  /** What the data set says of itself and does not hold. */
  readonly warnings: readonly SourceWarning[];
  /** Cube of the octree's root: least x, y, z and edge, source units. */
  readonly cube: readonly [x: number, y: number, z: number, edge: number];
  /** Distance between the points of the root, source units; halved at each level. */
  readonly spacing: number;
  /** Source units per step of the points' integers, per axis: source coordinate = integer · scale + offset. */
  readonly scale: readonly [number, number, number];
  /** Source units, per axis. */
  readonly offset: readonly [number, number, number];
  readonly crs: CrsDeclaration;
  /** The attributes of each point but for x, y and z; names are unique and none of `DERIVED_COLUMNS`. */
  readonly attributes: readonly PointAttribute[];
  /** What a converter counted of all points; undefined where none did. */
  readonly statistics: CloudStatistics | undefined;
  /** Bytes that a decoded point takes with all its attributes. */
  readonly bytesPerPoint: number;
  readonly encoding: Encoding;
  /** Why its bytes are waited for, where a server cannot serve for now. */
  readonly wait?: ServerWait | undefined;
  /** Page of the hierarchy that begins with the root. */
  readonly rootPage: Address;
  /**
   * Reads a page of the hierarchy. Its entries are read and checked as they are taken, so that a long page need not be
   * read in one go.
   * @throws SourceError, FormatError; also while entries are taken
   */
  page(address: Address, options?: ReadOptions): Promise<Iterable<HierarchyEntry<Address>>>;
  /**
   * Reads the encoded points of a node.
   * @throws SourceError, FormatError
   */
  chunk(address: Address, options?: ReadOptions): Promise<EncodedChunk>;
  /**
   * Reads what a LAS file of some of its points begins and ends with; there where points are LAS records.
   * @throws SourceError, FormatError
   */
  lasEnvelope?(options?: ReadOptions): Promise<LasEnvelope>;
}

/** A file of the family of LAS but for its points, as bytes: what a LAS file with some of them begins and ends with. */
export interface LasEnvelope {
  /** Public header block as it stands, 375 bytes or more (LAS 1.4 R15, section 2.4). */
  readonly header: Uint8Array;
  /** Point data record format, without the bits that say that points are compressed. */
  readonly pointFormat: number;
  /** Bytes per uncompressed record, extra bytes included. */
  readonly recordLength: number;
  /**
   * Variable length records in the order of the file, without those that say how its points are stored or that are
   * true of all its points together only.
   */
  readonly records: readonly LasVariableRecord[];
}

/** A variable length record, extended or not, as bytes. */
export interface LasVariableRecord {
  readonly userId: string;
  readonly recordId: number;
  /** Whether it stands behind the points, with a header of 60 bytes instead of 54 (LAS 1.4 R15, section 2.6). */
  readonly extended: boolean;
  /** Its header as it stands. */
  readonly header: Uint8Array;
  readonly content: Uint8Array;
}

/** The encoded points of a node. */
export interface EncodedChunk {
  /** In a buffer of their own. */
  readonly bytes: ArrayBuffer;
  /** CRC-32C of the bytes as their writer has stored it; undefined where it stored none. */
  readonly checksum: number | undefined;
}

/** What all encodings have in common. */
interface AnyEncoding {
  readonly kind: string;
}

/** Least and greatest corner in source coordinates. */
export interface SourceBox {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/** Something that a data set says of itself and that does not hold; it is drawn by what does. */
export interface SourceWarning {
  /** Stable, to be matched by. */
  readonly code: "BOUNDS_WRONG";
  /** What is wrong and what is done about it, in words. */
  readonly message: string;
}

/** What a data set says of its coordinate system; nothing of it need be there. */
export interface CrsDeclaration {
  /** OGC WKT, or whatever else `resolveCrs` understands in its place. */
  readonly wkt?: string;
  readonly geoTiff?: GeoTiffKeys;
  /** What the header of a LAS file says of which of the two is in force. */
  readonly las?: LasDeclaration;
  /** Raw bytes of Groma's georeference record. */
  readonly georeference?: Uint8Array;
  /** Raw bytes of the transformation that goes with that record, in a buffer of their own. */
  readonly transformation?: Uint8Array;
}

/** One entry of a hierarchy page: a node with its points, or a reference to a further page. */
export interface HierarchyEntry<Address = unknown> {
  /** 0 at the root; x, y and z lie in [0, 2^depth). */
  readonly depth: number;
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Where the points are, or the further page; of no meaning where the node holds no points. */
  readonly address: Address;
  /** Number of points; -1 for a reference to a further page. */
  readonly pointCount: number;
}

/** The error for an octree that cannot be. */
export function badHierarchy(file: string, what: string): FormatError {
  return new FormatError({
    code: "FORMAT_HIERARCHY",
    file,
    cause: `its octree names ${what}`,
    fix: "Convert the scan again",
  });
}

/** Said where the declared bounds do not hold the points. */
export function wrongBounds(bounds: SourceBox): SourceWarning {
  const message = `the declared bounds do not hold the points (${ranges(bounds)}); the octree's cube is used`;
  return { code: "BOUNDS_WRONG", message };
}

/** Said where the declared bounds reach beyond the octree, which holds all points. */
export function tooWideBounds(bounds: SourceBox): SourceWarning {
  const message = `the declared bounds reach beyond the octree (${ranges(bounds)}); they are cut to its cube`;
  return { code: "BOUNDS_WRONG", message };
}

function ranges({ min, max }: SourceBox): string {
  return ["x", "y", "z"].map((axis, index) => `${axis} ${min[index]} to ${max[index]}`).join(", ");
}
