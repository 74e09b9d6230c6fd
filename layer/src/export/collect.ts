import { FormatError } from "../errors/index.js";
import { ROOT_KEY } from "../octree/index.js";
import { everyRecord, type PointBatch, type PointOrigin } from "../query/index.js";
import { type RecordedNode, readCoordinates, type StoredAttribute } from "../workers/index.js";
import type { BlockStore } from "./block-store.js";
import {
  type AlongLine,
  type ExportOptions,
  eachBatch,
  type PartedSelection,
  type PartedVolume,
  type PointSelection,
} from "./selection.js";
import { crsOf } from "./systems.js";

/** Bytes of a block of records, and of the first, smaller one of a part with few of them. */
const BLOCK = 1 << 16;
const FIRST_BLOCK = 1 << 10;

/** Records of one part of one data set: full blocks in the store, the last one here. */
class PartRecords {
  readonly blocks: unknown[] = [];
  count = 0;
  #filled = 0;
  #block = new Uint8Array(0);

  /** @param capacity whole records only, so that no block cuts one */
  add(from: Uint8Array, begin: number, length: number): void {
    if (this.#filled + length > this.#block.length) this.#grow(length);
    const to = this.#block;
    for (let byte = 0, at = this.#filled; byte < length; byte++, at++) to[at] = from[begin + byte];
    this.#filled += length;
    this.count++;
  }

  /** Whether the block has to go to the store before another record is added. */
  isFull(length: number): boolean {
    return this.#filled + length > BLOCK;
  }

  async store(store: BlockStore): Promise<void> {
    this.blocks.push(await store.put(this.#block.subarray(0, this.#filled)));
    this.#filled = 0;
  }

  /** The records that are in no block yet. */
  get rest(): Uint8Array {
    return this.#block.subarray(0, this.#filled);
  }

  #grow(length: number): void {
    const larger = new Uint8Array(
      Math.max(length, Math.min(BLOCK, Math.max(FIRST_BLOCK, 2 * this.#block.length))),
    );
    larger.set(this.rest);
    this.#block = larger;
  }
}

/**
 * Reads the points of many parts of data sets in one pass, each node once, and keeps their records apart.
 *
 * @param selections data sets with the same parts
 * @param alongOf the line of a part, asked about the coordinates of one of the data sets
 * @returns of each part a selection per data set, which any export takes; those without points are left out
 * @throws FormatError EXPORT_NO_LAS where points are no LAS records
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what the store throws
 */
export async function collectParts<S extends PartedSelection>(
  selections: readonly S[],
  store: BlockStore,
  options: ExportOptions = {},
  alongOf: (selection: S, part: number) => AlongLine | undefined = () => undefined,
): Promise<PointSelection[][]> {
  const collected = new Map<PointSelection, Collected>();
  await eachBatch(selections, options, async (batch, wanted, selection) => {
    const { volume } = selection as PartedSelection;
    let own = collected.get(selection);
    if (!own) {
      own = new Collected(selection.origin, batch.records, volume.count);
      collected.set(selection, own);
    }
    await own.take(batch.records, wanted, volume, store);
  });
  const count = Math.max(0, ...selections.map(({ volume }) => volume.count));
  return Array.from({ length: count }, (_, part) =>
    selections.flatMap((selection) => {
      const { volume: _volume, ...rest } = selection;
      const origin = collected.get(selection)?.originOf(part, store);
      if (!origin) return [];
      return [
        {
          ...rest,
          crs: crsOf(selection),
          origin,
          along: alongOf(selection, part),
          classes: undefined,
          filter: undefined,
        },
      ];
    }),
  );
}

/** The records of all parts of one data set. */
class Collected {
  readonly #origin: PointOrigin;
  readonly #attributes: readonly StoredAttribute[];
  readonly #length: number;
  readonly #parts: PartRecords[];
  readonly #found: Uint32Array;
  /** Read once for all parts. */
  #envelope: ReturnType<PointOrigin["lasEnvelope"]> | undefined;

  constructor(origin: PointOrigin, { lasRecords, attributes, count }: RecordedNode, parts: number) {
    if (!lasRecords || attributes.some(({ bytes }) => bytes.buffer !== lasRecords.buffer)) {
      throw new FormatError({
        code: "EXPORT_NO_LAS",
        file: origin.name,
        cause: "its points are no LAS records",
        fix: "Export each part by itself, as CSV, GeoJSON or DXF",
      });
    }
    this.#origin = origin;
    this.#attributes = attributes;
    this.#length = lasRecords.length / count;
    this.#parts = Array.from({ length: parts }, () => new PartRecords());
    this.#found = new Uint32Array(parts);
  }

  async take(
    { xyz, lasRecords }: RecordedNode,
    wanted: Uint32Array,
    volume: PartedVolume,
    store: BlockStore,
  ): Promise<void> {
    const [scaleX, scaleY, scaleZ] = this.#origin.scale;
    const [offsetX, offsetY, offsetZ] = this.#origin.offset;
    const [length, found, parts] = [this.#length, this.#found, this.#parts];
    for (const point of wanted) {
      const at = 3 * point;
      const x = xyz[at] * scaleX + offsetX;
      const y = xyz[at + 1] * scaleY + offsetY;
      const count = volume.partsAt(x, y, xyz[at + 2] * scaleZ + offsetZ, found);
      for (let hit = 0; hit < count; hit++) {
        const part = parts[found[hit]];
        if (part.isFull(length)) await part.store(store);
        part.add(lasRecords!, point * length, length);
      }
    }
  }

  /** A data set of the points of one part; undefined where there is none. */
  originOf(part: number, store: BlockStore): PointOrigin | undefined {
    const records = this.#parts[part];
    const { name, scale, offset } = this.#origin;
    if (records.count === 0) return undefined;
    const batchOf = (bytes: Uint8Array): PointBatch => {
      const count = bytes.length / this.#length;
      const inside = everyRecord(count);
      const attributes = this.#attributes.map((attribute) => ({ ...attribute, bytes }));
      const xyz = readCoordinates(bytes, this.#length);
      return {
        node: "0-0-0-0",
        key: ROOT_KEY,
        records: { count, xyz, attributes, lasRecords: bytes },
        inside,
      };
    };
    // Of most parts that is all there is, and each of their files goes through it.
    let last: PointBatch | undefined;
    async function* batches(options?: { signal?: AbortSignal | undefined }) {
      for (const block of records.blocks) {
        options?.signal?.throwIfAborted();
        yield batchOf(await store.get(block));
      }
      if (records.rest.length === 0) return;
      last ??= batchOf(records.rest);
      yield last;
    }
    const bracket = async () => ({ least: records.count, most: records.count, nodes: 1 });
    return {
      ...{ name, scale, offset },
      lasEnvelope: (options) => {
        this.#envelope ??= this.#origin.lasEnvelope(options);
        return this.#envelope;
      },
      query: () => ({ bracket, batches }),
    };
  }
}
