import { ecefToGeodetic } from "@groma/georef";
import BaseEvent from "ol/events/Event.js";
import type { Extent } from "ol/extent.js";
import Feature from "ol/Feature.js";
import Polygon from "ol/geom/Polygon.js";
import type Projection from "ol/proj/Projection.js";
import { type ProjectionLike, transform } from "ol/proj.js";
import Source, { type AttributionLike } from "ol/source/Source.js";
import VectorSource from "ol/source/Vector.js";
import { checkCloudOptions, PointCloud, type PointCloudOptions } from "../cloud/index.js";
import { StyleError } from "../errors/index.js";
import type { SourceLike } from "../sources/index.js";

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

/** Parts that a side of the outline is cut into, so that it bends as the ground does. */
const SIDE = 16;

/** The outline of a data set, in the projection that was asked for last. */
class Footprint extends VectorSource {
  readonly #feature = new Feature<Polygon>();
  #cloud: PointCloud | undefined;
  #code: string | undefined;

  constructor(opened: Promise<PointCloud>) {
    super();
    // What keeps it from being opened is told by the source of the points.
    opened.then(
      (cloud) => {
        this.#cloud = cloud;
        this.changed();
      },
      () => undefined,
    );
  }

  override loadFeatures(extent: Extent, resolution: number, projection: Projection): void {
    const code = projection.getCode();
    if (this.#cloud && code !== this.#code) {
      this.#code = code;
      this.#feature.set("name", this.#cloud.name);
      this.#feature.setGeometry(outlineOf(this.#cloud, projection));
      if (!this.hasFeature(this.#feature)) this.addFeature(this.#feature);
    }
    super.loadFeatures(extent, resolution, projection);
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
  #footprint: VectorSource | undefined;

  /** @throws StyleError STYLE_OPTION where not exactly one of `url`, `file` and `cloud` is given */
  constructor({ url, file, cloud, attributions, ...options }: PointCloudSourceOptions) {
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

  /** The data set; undefined until it is open. */
  get cloud(): PointCloud | undefined {
    return this.#cloud;
  }

  /** The data set once it is open. @throws what kept it from being opened */
  opened(): Promise<PointCloud> {
    return this.#opened;
  }

  /**
   * The outline of the data set's box, with its name, for a vector layer. It comes in the projection of the map that
   * asks for it, and follows it to another one. Maps of several projections need a source each.
   */
  get footprint(): VectorSource {
    this.#footprint ??= new Footprint(this.#opened);
    return this.#footprint;
  }

  /**
   * Box around the data set in a projection, to fit a view to; undefined until it is open. Across 180° it goes on beyond
   * the edge of the world.
   * @param projection Default: EPSG:3857
   */
  getExtent(projection: ProjectionLike = "EPSG:3857"): Extent | undefined {
    return this.#cloud && outlineOf(this.#cloud, projection).getExtent();
  }

  override disposeInternal(): void {
    this.#stop.abort(new DOMException("The source was disposed of.", "AbortError"));
    if (this.#owned) this.#cloud?.destroy();
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

/** The sides of a data set's box on the ground, at its middle height, in a projection. */
function outlineOf(cloud: PointCloud, projection: ProjectionLike): Polygon {
  const { min, max } = cloud.boundingBox;
  const z = (min[2] + max[2]) / 2;
  const corners = [
    [min[0], min[1]],
    [max[0], min[1]],
    [max[0], max[1]],
    [min[0], max[1]],
  ];
  const place = new Float64Array(3);
  let near: number | undefined;
  const ring = corners.flatMap(([x, y], side) => {
    const [toX, toY] = corners[(side + 1) % corners.length];
    return Array.from({ length: SIDE }, (_, step) => {
      const share = step / SIDE;
      cloud.place(x + share * (toX - x), y + share * (toY - y), z, place);
      ecefToGeodetic(place[0], place[1], place[2], place);
      const [longitude, latitude] = [place[0], place[1]].map((angle) => (angle * 180) / Math.PI);
      // In one piece across 180°.
      near ??= longitude;
      const turns = Math.round((near - longitude) / 360);
      return transform([longitude + 360 * turns, latitude], "EPSG:4326", projection);
    });
  });
  return new Polygon([[...ring, ring[0]]]);
}

function notOne(count: number): StyleError {
  return new StyleError({
    code: "STYLE_OPTION",
    file: "PointCloudSource",
    cause: `${count} of url, file and cloud are given`,
    fix: "Give one of them",
  });
}
