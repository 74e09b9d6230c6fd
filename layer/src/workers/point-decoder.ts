import type { Encoding } from "../sources/open-source.js";
import type { StoredAttribute } from "./stored-attribute.js";

/** The encoding of a kind. */
export type Encoded<Kind extends Encoding["kind"]> = Extract<Encoding, { readonly kind: Kind }>;

/** What a chunk must turn out to be, and where it is from, for errors. */
export interface Expected {
  readonly pointCount: number;
  /** CRC-32C of the chunk as stored; undefined where there is none. */
  readonly checksum?: number | undefined;
  readonly file: string;
  /** Node name. */
  readonly node: string;
}

/** The points of a chunk as recorded, in its order. */
export interface DecodedPoints {
  /** x, y and z of each point: the integers that the source's scale and offset turn into coordinates. */
  readonly xyz: Int32Array;
  /** All attributes that the source names. */
  readonly attributes: readonly StoredAttribute[];
  /** The LAS records themselves, one after the other, where points are such; attributes may share their bytes. */
  readonly lasRecords?: Uint8Array | undefined;
}

/** Turns the chunks of one encoding into points. */
export interface PointDecoder<E> {
  /**
   * @returns exactly as many points as are expected
   * @throws DecodeError DECODE_CHUNK where the chunk holds something else
   */
  decode(chunk: Uint8Array, encoding: E, expected: Expected): Promise<DecodedPoints>;
}
