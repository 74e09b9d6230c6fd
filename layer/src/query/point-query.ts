import { keyName, type OctreeNode, ROOT_KEY, type VoxelKey } from "../octree/index.js";
import { checkSignal, number, optionPlace, some, withMethods } from "../options/index.js";
import type { RecordedNode } from "../workers/index.js";
import { Pace } from "./pace.js";

/** How a box lies to a volume: within it, apart from it, or partly in it (or it may be). */
export type BoxRelation = "in" | "out" | "crossing";

/**
 * A part of space in source coordinates and their units. Both answers must agree: of a box that is `in` every point is
 * contained, of one that is `out` none.
 */
export interface QueryVolume {
  /** How a box lies to the volume: least x, y, z, greatest x, y, z. Bounds belong to the box. */
  toBox(box: Float64Array): BoxRelation;
  /** Whether a point lies in the volume; asked of each point of the nodes that cross it. */
  contains(x: number, y: number, z: number): boolean;
}

/** What is asked for. */
export interface QueryOptions {
  /** Where points are wanted. Default: everywhere. */
  readonly volume?: QueryVolume | undefined;
  /**
   * Distance between neighbouring points that suffices, metres on the ground: levels below the first one that is as
   * dense are left out. Default: 0, all levels, and so every point.
   */
  readonly spacing?: number | undefined;
}

/** Points of one node, whole records. */
export interface PointBatch {
  /** Node, `depth-x-y-z`. */
  readonly node: string;
  readonly key: VoxelKey;
  /** All points of the node as they are recorded, in the order of the file. */
  readonly records: RecordedNode;
  /** Which of them the volume contains: indices of records, rising. */
  readonly inside: Uint32Array;
}

/** How many points a query finds, as far as the hierarchy tells: between these two, both possible. */
export interface PointBracket {
  /** Points of the nodes that lie within the volume. */
  readonly least: number;
  /** Those and the points of the nodes that cross it. */
  readonly most: number;
  /** Nodes that are read. */
  readonly nodes: number;
}

const OPTIONS = some<QueryOptions>({
  volume: withMethods<QueryVolume>("an object with the methods toBox and contains", "toBox", "contains"),
  spacing: number(0),
});

/** A node that is read, known before any of its points is. */
interface WantedNode {
  readonly key: VoxelKey;
  readonly pointCount: number;
  /** Whether it lies within the volume, so that none of its points needs to be asked. */
  readonly within: boolean;
}

/** What a query works with. */
export interface QueryParts {
  /** Name of the data set, for errors. */
  readonly file: string;
  /** Does work with the node of a key, whose hierarchy page is read before where need be. */
  withNode<T>(key: VoxelKey, signal: AbortSignal, work: (node: OctreeNode) => T | Promise<T>): Promise<T>;
  /** A node's points as recorded. */
  records(node: OctreeNode, signal: AbortSignal): Promise<RecordedNode>;
  /** Box that all points of a node lie in, source coordinates: least x, y, z, greatest x, y, z. */
  box(key: VoxelKey, out: Float64Array): Float64Array;
  /** Distance between points of the root, metres on the ground; halved at each level. */
  readonly spacing: number;
  /** Source units per step of the recorded integers, per axis. */
  readonly scale: readonly [number, number, number];
  /** Source units, per axis. */
  readonly offset: readonly [number, number, number];
}

/** Nodes that are read ahead of the one that is waited for: enough for the workers of most machines. */
const AHEAD = 6;

/** Nodes whose pages are asked for at a time. */
const PAGES_AT_ONCE = 8;

/** Points between two looks at the clock. */
const SLICE = 2048;

/**
 * The points of a data set in a volume, by whole nodes: each node once, coarser levels before finer ones, whatever a
 * view shows or has loaded. Either all of it comes or the failure is thrown: no part is left out silently.
 *
 * Nodes are read a few at a time, and only as batches are taken: whoever stops taking them pauses the query, and memory
 * is bounded by those few nodes.
 */
export class PointQuery {
  readonly #parts: QueryParts;
  readonly #volume: QueryVolume | undefined;
  /** The last level that is read. */
  readonly #deepest: number;
  /** Nodes to be read, as far as the hierarchy was followed, coarser ones first. */
  readonly #wanted: WantedNode[] = [];
  /** Nodes of the next level that may be wanted, with whether the node above lies within the volume. */
  #frontier: { readonly key: VoxelKey; readonly within: boolean }[] = [{ key: ROOT_KEY, within: false }];
  #following: Promise<void> | undefined;

  /** @internal @throws StyleError STYLE_OPTION */
  constructor(parts: QueryParts, options: QueryOptions) {
    const { volume, spacing = 0 } = OPTIONS.read(options, optionPlace("options", parts.file));
    this.#parts = parts;
    this.#volume = volume;
    this.#deepest = Math.max(0, Math.ceil(Math.log2(parts.spacing / spacing)));
  }

  /**
   * Counts the points to come by the hierarchy alone, of which it reads the pages that the volume meets.
   * @throws SourceError, FormatError; StyleError STYLE_OPTION; the signal's reason when aborted
   */
  async bracket(options: { signal?: AbortSignal | undefined } = {}): Promise<PointBracket> {
    const signal = checkSignal(options, this.#parts.file);
    while (this.#frontier.length > 0) await this.#follow(signal);
    let [least, most] = [0, 0];
    for (const { pointCount, within } of this.#wanted) {
      most += pointCount;
      if (within) least += pointCount;
    }
    return { least, most, nodes: this.#wanted.length };
  }

  /**
   * Reads the points. Batches come in a fixed order, whatever the network does; batches without points are left out.
   * May be called several times: each goes through all points.
   * @throws StyleError STYLE_OPTION, at once; SourceError, FormatError, DecodeError, the signal's reason when aborted
   */
  batches(options: { signal?: AbortSignal | undefined } = {}): AsyncGenerator<PointBatch, void> {
    return this.#batches(checkSignal(options, this.#parts.file));
  }

  async *#batches(signal: AbortSignal): AsyncGenerator<PointBatch, void> {
    const stop = new AbortController();
    const either = AbortSignal.any([signal, stop.signal]);
    const ahead: Promise<PointBatch>[] = [];
    let next = 0;
    try {
      for (;;) {
        while (ahead.length < AHEAD && next < this.#wanted.length) {
          ahead.push(handled(this.#read(this.#wanted[next++], either)));
        }
        // The hierarchy is followed while points are on their way.
        const more = next === this.#wanted.length && this.#frontier.length > 0;
        const following = more ? handled(this.#follow(either)) : undefined;
        const first = ahead.shift();
        const batch = await first;
        if (batch && batch.inside.length > 0) yield batch;
        await following;
        if (!first && !more) return;
      }
    } finally {
      stop.abort();
    }
  }

  /** Goes one level down. Whoever comes while that is done waits for it, and looks again. */
  async #follow(signal: AbortSignal): Promise<void> {
    signal.throwIfAborted();
    if (this.#following) {
      await this.#following.catch(() => undefined);
      return;
    }
    this.#following = this.#followLevel(signal);
    try {
      await this.#following;
    } finally {
      this.#following = undefined;
    }
  }

  /** Takes in the level of the frontier whole, or leaves everything as it is. */
  async #followLevel(signal: AbortSignal): Promise<void> {
    const { withNode } = this.#parts;
    const pace = new Pace(signal);
    const wanted: WantedNode[] = [];
    const below: { key: VoxelKey; within: boolean }[] = [];
    const met = this.#frontier.flatMap(({ key, within }) => {
      const relation = within ? "in" : this.#relation(key);
      return relation === "out" ? [] : { key, within: relation === "in" };
    });
    for (let from = 0; from < met.length; from += PAGES_AT_ONCE) {
      const visits = met.slice(from, from + PAGES_AT_ONCE).map(({ key, within }) =>
        withNode(key, signal, ({ pointCount, children }) => {
          const keys = (children ?? []).flatMap((child) => child?.key ?? []);
          return { key, within, pointCount, keys };
        }),
      );
      for (const { keys, ...node } of await Promise.all(visits)) {
        if (node.pointCount > 0) wanted.push(node);
        if (node.key.depth < this.#deepest) {
          for (const key of keys) below.push({ key, within: node.within });
        }
      }
      await pace.rest();
    }
    this.#frontier = below;
    this.#wanted.push(...wanted);
  }

  #relation(key: VoxelKey): BoxRelation {
    return this.#volume?.toBox(this.#parts.box(key, new Float64Array(6))) ?? "in";
  }

  async #read({ key, within }: WantedNode, signal: AbortSignal): Promise<PointBatch> {
    const { withNode, records } = this.#parts;
    const found = await withNode(key, signal, (node) => records(node, signal));
    const inside = within ? everyRecord(found.count) : await this.#select(found, signal);
    return { node: keyName(key), key, records: found, inside };
  }

  /** Asks the volume for each point, with pauses. */
  async #select({ xyz, count }: RecordedNode, signal: AbortSignal): Promise<Uint32Array> {
    const volume = this.#volume!;
    const [scaleX, scaleY, scaleZ] = this.#parts.scale;
    const [offsetX, offsetY, offsetZ] = this.#parts.offset;
    const inside = new Uint32Array(count);
    const pace = new Pace(signal);
    let found = 0;
    for (let from = 0; from < count; from += SLICE) {
      const to = Math.min(count, from + SLICE);
      for (let point = from, at = 3 * from; point < to; point++, at += 3) {
        const x = xyz[at] * scaleX + offsetX;
        const y = xyz[at + 1] * scaleY + offsetY;
        const z = xyz[at + 2] * scaleZ + offsetZ;
        if (volume.contains(x, y, z)) inside[found++] = point;
      }
      await pace.rest();
    }
    return inside.slice(0, found);
  }
}

/** Indices of all records of a node. */
export function everyRecord(count: number): Uint32Array {
  const indices = new Uint32Array(count);
  for (let index = 0; index < count; index++) indices[index] = index;
  return indices;
}

/** A promise whose failure is noticed by whoever awaits it, however late. */
function handled<T>(promise: Promise<T>): Promise<T> {
  promise.catch(() => undefined);
  return promise;
}

/** Those of a batch's points that are of some classes: indices of records, rising. */
export function ofClasses(
  { records, inside }: Pick<PointBatch, "records" | "inside">,
  classes: ReadonlySet<number>,
): Uint32Array {
  const attribute = records.attributes.find(({ name }) => name === "classification");
  if (!attribute) return new Uint32Array(0);
  const { bytes, at, stride } = attribute;
  return inside.filter((point) => classes.has(bytes[at + point * stride]));
}

/** Classes of a batch's points, each once; none where its records have no classes. */
export function classesOf({ records, inside }: Pick<PointBatch, "records" | "inside">): Set<number> {
  const attribute = records.attributes.find(({ name }) => name === "classification");
  if (!attribute) return new Set();
  const { bytes, at, stride } = attribute;
  return new Set(inside.map((point) => bytes[at + point * stride]));
}
