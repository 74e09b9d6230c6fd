import type { PointCloudLayer, ServerWait } from "@groma/layer/cesium";
import type { PrimitiveCollection } from "cesium";
import type { Indexed, IndexProgress } from "../indexing/index-file.js";
import { type OpenOptions, openLayer } from "./open-layer.js";

/** A cloud of the scene, and what it was opened from. */
export interface OpenCloud {
  /** Of this visit of the page; stays when the cloud is opened anew in its place. */
  readonly id: number;
  readonly from: string | File;
  readonly how: OpenOptions;
  /** Coordinate system that the reader gave, where it was used. */
  readonly crs: string | undefined;
  /** Set where the file had no octree, and the page gave it one. */
  readonly indexed: Indexed | undefined;
  readonly layer: PointCloudLayer;
}

/** What is told while a cloud is on its way. */
export interface OpeningTold {
  /** Its server is waited for; undefined: it answers. */
  readonly waits: (wait: ServerWait | undefined) => void;
  /** It is given an octree. */
  readonly indexing: (progress: IndexProgress) => void;
}

/** A cloud that is on its way. */
export interface Opening {
  readonly from: string | File;
  readonly work: AbortController;
}

/** The clouds of the scene, in the order in which they came. One of them is chosen: the panel speaks of it. */
export class Clouds {
  readonly #primitives: PrimitiveCollection;
  readonly #changed: () => void;
  #all: readonly OpenCloud[] = [];
  #openings: readonly Opening[] = [];
  #chosen: number | undefined;
  #next = 1;
  /** What was indexed and could not be opened, say for want of a coordinate system that the reader gives next. */
  #indexed: Pick<OpenCloud, "from" | "indexed"> | undefined;

  /** @param changed hears that there are others, or that another one is chosen */
  constructor(primitives: PrimitiveCollection, changed: () => void) {
    this.#primitives = primitives;
    this.#changed = changed;
  }

  get all(): readonly OpenCloud[] {
    return this.#all;
  }

  get openings(): readonly Opening[] {
    return this.#openings;
  }

  get layers(): readonly PointCloudLayer[] {
    return this.#all.map(({ layer }) => layer);
  }

  get chosen(): OpenCloud | undefined {
    return this.#all.find(({ id }) => id === this.#chosen);
  }

  /** The layer of the chosen cloud. */
  get layer(): PointCloudLayer | undefined {
    return this.chosen?.layer;
  }

  /** Makes a cloud the chosen one. */
  choose(cloud: OpenCloud): void {
    this.#chosen = cloud.id;
    this.#changed();
  }

  /**
   * Opens a cloud beside those that are there. One of the same origin is replaced by it, once it could be opened: a file may
   * have been converted anew. The first is chosen. One of the same origin that is on its way is given up.
   *
   * @returns undefined where the opening was given up
   * @throws GromaError where it cannot be opened; what is there stays
   */
  async open(
    from: string | File,
    how: OpenOptions,
    { waits, indexing }: OpeningTold,
  ): Promise<OpenCloud | undefined> {
    for (const other of this.#openings) if (sameOrigin(other.from, from)) other.work.abort();
    const opening = { from, work: new AbortController() };
    const { signal } = opening.work;
    this.#openings = [...this.#openings, opening];
    this.#changed();
    try {
      const onWait = (wait: ServerWait | undefined) => {
        if (this.#openings.includes(opening)) waits(wait);
      };
      let { indexed } = [...this.#all, this.#indexed].find((one) => one && sameOrigin(one.from, from)) ?? {};
      const onIndexed = (made: Indexed) => {
        indexed = made;
        this.#indexed = { from, indexed };
      };
      const onIndexing = (progress: IndexProgress) => {
        if (this.#openings.includes(opening) && !signal.aborted) indexing(progress);
      };
      const events = { onWait, onIndexing, onIndexed, signal };
      const layer = await openLayer(indexed?.copc ?? from, how, events);
      if (!signal.aborted) return this.#take(from, how, indexed, layer);
      layer.destroy();
      return undefined;
    } catch (thrown) {
      if (signal.aborted) return undefined;
      throw thrown;
    } finally {
      this.#openings = this.#openings.filter((one) => one !== opening);
      this.#changed();
    }
  }

  /** Takes a cloud out of the scene; of the chosen one its neighbour takes the place. */
  remove(cloud: OpenCloud): void {
    const at = this.#all.findIndex(({ id }) => id === cloud.id);
    if (at < 0) return;
    const { layer, id } = this.#all[at]!;
    this.#all = this.#all.filter((_, i) => i !== at);
    if (this.#chosen === id) this.#chosen = (this.#all[at] ?? this.#all.at(-1))?.id;
    this.#changed();
    this.#primitives.remove(layer);
  }

  #take(
    from: string | File,
    how: OpenOptions,
    indexed: Indexed | undefined,
    layer: PointCloudLayer,
  ): OpenCloud {
    this.#indexed = undefined;
    const before = this.#all.find((one) => sameOrigin(one.from, from));
    const { crs, crsIfMissing, vertical } = how;
    // A system for clouds without one was taken where nothing else could have been given.
    const taken = vertical === undefined && layer.cloud.basis === "given" ? crsIfMissing : undefined;
    const cloud = { id: before?.id ?? this.#next++, from, how, crs: crs ?? taken, indexed, layer };
    this.#all = before ? this.#all.map((one) => (one === before ? cloud : one)) : [...this.#all, cloud];
    this.#chosen ??= cloud.id;
    this.#primitives.add(layer);
    if (before) this.#primitives.remove(before.layer);
    return cloud;
  }
}

/** Whether two are of one address, or one file of the reader's disk. */
function sameOrigin(a: string | File, b: string | File): boolean {
  if (typeof a === "string" || typeof b === "string") return a === b;
  return a === b || (a.name === b.name && a.size === b.size && a.lastModified === b.lastModified);
}
