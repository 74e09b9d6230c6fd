import BaseEvent from "ol/events/Event.js";
import type { Extent } from "ol/extent.js";
import type Feature from "ol/Feature.js";
import type Polygon from "ol/geom/Polygon.js";
import type { ProjectionLike } from "ol/proj.js";
import Source, { type AttributionLike } from "ol/source/Source.js";
import type VectorSource from "ol/source/Vector.js";
import { checkCloudOptions, PointCloud, type PointCloudOptions } from "../cloud/index.js";
import { StyleError } from "../errors/index.js";
import type { SourceLike } from "../sources/index.js";
import { Footprint, outlineOf } from "./footprint.js";

/** Where a source's points come from, and what is said of them. */
export interface PointCloudSourceOptions extends PointCloudOptions {
  /** Address of the data set, or a function that gives a signed one. One of `url`, `file` and `cloud` is given. */
  readonly url?: SourceLike | undefined;
  /** A file that the user chose. */
  readonly file?: Blob | undefined;
  /** A data set that is open already; it stays open when the source is disposed of. */
  readonly cloud?: PointCloud | undefined;
  /** As for any source of OpenLayers. */
  readonly attributions?: AttributionLike | undefined;
}

/** What a source or a layer of points could not do. */
export class PointCloudErrorEvent extends BaseEvent {
  /** A `GromaError`, with `code`, `file`, `cause` and `fix`. */
  readonly error: Error;

  constructor(error: Error) {
    super("error");
    this.error = error;
  }
}

/**
 * A georeferenced point cloud as a source of OpenLayers: `loading` until it is open, then `ready`, or `error` with an
 * event `error`. Several layers, on several maps, may draw one source.
 */
export class PointCloudSource extends Source {
  readonly #opened: Promise<PointCloud>;
  readonly #owned: boolean;
  readonly #stop = new AbortController();
  #cloud: PointCloud | undefined;
  #footprint: Footprint | undefined;

  /** @throws StyleError STYLE_OPTION where not exactly one of `url`, `file` and `cloud` is given */
  constructor({ url, file, cloud, attributions, ...options }: PointCloudSourceOptions = {}) {
    const given = [url, file, cloud].filter((from) => from !== undefined);
    if (given.length !== 1) throw notOne(given.length);
    const checked = checkCloudOptions(options);
    super({ attributions, state: cloud ? "ready" : "loading" });
    this.#owned = cloud === undefined;
    this.#cloud = cloud;
    const from = url ?? file;
    this.#opened = from === undefined ? Promise.resolve(cloud!) : this.#open(from, checked);
    // Whoever does not wait for it hears of it by the event.
    this.#opened.catch(() => undefined);
  }

  /** The data set; undefined until it is open, and when the source is disposed of. */
  get cloud(): PointCloud | undefined {
    return this.#cloud;
  }

  /** The data set once it is open. @throws what kept it from being opened; an AbortError when the source is disposed of */
  async opened(): Promise<PointCloud> {
    const cloud = await this.#opened;
    this.#stop.signal.throwIfAborted();
    return cloud;
  }

  /**
   * The outline of the data set's box, with its name, for vector layers: each map has it in its own projection, also after
   * that has changed. Who asks the source itself is given the one of the map that was drawn last.
   */
  get footprint(): VectorSource<Feature<Polygon>> {
    this.#footprint ??= new Footprint(this.#opened);
    return this.#footprint;
  }

  /**
   * Box around the data set in a projection, to fit a view to; undefined until it is open, and where it has no place there.
   * Across 180° it goes on beyond the edge of the world.
   * @param projection Default: EPSG:3857
   * @throws CrsError CRS_PROJECTION where the projection is not registered
   */
  getExtent(projection: ProjectionLike = "EPSG:3857"): Extent | undefined {
    return this.#cloud && outlineOf(this.#cloud, projection)?.getExtent();
  }

  override disposeInternal(): void {
    this.#stop.abort(new DOMException("The source was disposed of.", "AbortError"));
    if (this.#owned) this.#cloud?.destroy();
    this.#cloud = undefined;
    super.disposeInternal();
  }

  async #open(from: SourceLike, options: PointCloudOptions): Promise<PointCloud> {
    this.loading = true;
    try {
      const { signal } = options;
      const either = signal ? AbortSignal.any([signal, this.#stop.signal]) : this.#stop.signal;
      const cloud = await PointCloud.fromUrl(from, { ...options, signal: either });
      this.#cloud = cloud;
      this.loading = false;
      this.setState("ready");
      return cloud;
    } catch (thrown) {
      this.loading = false;
      if (!this.#stop.signal.aborted) {
        this.setState("error");
        this.dispatchEvent(new PointCloudErrorEvent(thrown as Error));
      }
      throw thrown;
    }
  }
}

function notOne(count: number): StyleError {
  return new StyleError({
    code: "STYLE_OPTION",
    file: "PointCloudSource",
    cause: `${count} of url, file and cloud are given`,
    fix: "Give one of them",
  });
}
