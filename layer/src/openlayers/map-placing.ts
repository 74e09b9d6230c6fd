import type Projection from "ol/proj/Projection.js";
import type { PlacedOctree, PointCloud } from "../cloud/index.js";
import type { LayerSettings } from "../drawing/frame.js";
import type { MapFrame } from "./map-camera.js";
import { PlacedFrames } from "./placed-frames.js";
import { projectionOfMap } from "./projections.js";

/** What a map wants points to be placed for. */
export interface PlacingWish {
  readonly cloud: PointCloud;
  readonly projection: Projection;
  /** Least resolution that the view allows, units of the projection per pixel. */
  readonly finest: number;
}

/**
 * How far the points are that were asked for.
 * - `pending`: on their way to the picture
 * - `here`: in the picture, or none were asked for
 * - `failed`: they could not be placed
 * - `again`: the same, and the next frame has them placed anew
 */
type Progress = "pending" | "here" | "failed" | "again";

/** Who wants to hear of it. */
interface PlacingEvents {
  /** Something has come, or is gone: a frame is to be drawn. */
  changed(): void;
  failed(error: unknown): void;
}

/**
 * Where a layer's points are placed for its map: what is drawn, and what is to take its place, which is brought and uploaded
 * behind it. So the picture stays when the map has another projection or comes closer than the points were placed for.
 */
export class MapPlacing {
  readonly #owner: object;
  readonly #events: PlacingEvents;
  #asked: PlacingWish | undefined;
  #progress: Progress = "here";
  /** Grows whenever what is asked for is another: answers that come late are told by it. */
  #turn = 0;
  #shown: PlacedFrames | undefined;
  #next: PlacedFrames | undefined;

  /** @param owner the layer, by which stream and budgets know it */
  constructor(owner: object, events: PlacingEvents) {
    this.#owner = owner;
    this.#events = events;
  }

  /** The data set that was asked for last. */
  get cloud(): PointCloud | undefined {
    return this.#asked?.cloud;
  }

  /** What is drawn now. */
  get shown(): PlacedFrames | undefined {
    return this.#shown;
  }

  get pending(): boolean {
    return this.#progress === "pending";
  }

  /** Has the points placed as a map wants them, unless they are, or are being placed. */
  want(wish: PlacingWish, gl: WebGL2RenderingContext): void {
    const asked = this.#asked;
    const { cloud, projection, finest } = wish;
    const same = asked?.cloud === cloud && asked.projection === projection && finest >= asked.finest;
    if (same && this.#progress !== "again") return;
    this.#asked = wish;
    this.#turn++;
    this.#dropNext();
    this.#progress = "pending";
    const placing = projectionOfMap(projection, finest, cloud.name).then((asked) =>
      cloud.maps.acquire(asked),
    );
    void this.#await(placing, wish, gl, this.#turn);
  }

  /**
   * Makes what comes next ready for a frame, and shows it from now on where it is: at once where nothing else may be drawn,
   * with its first points where the picture is of another projection, else when all that the view wants is there.
   * @returns what still keeps it; undefined where nothing is on its way
   */
  advance(settings: LayerSettings, frame: Omit<MapFrame, "metresPerUnit" | "bounds">) {
    const next = this.#next;
    if (!next) return undefined;
    const report = next.prepare(settings, frame);
    const whole = report === "blocked" || (report !== "unfinished" && report.done);
    const begun = next.renderer.content.nodes.length > 0;
    if (!whole && !(begun && next.projection !== this.#shown?.projection)) return { report, placed: next };
    this.#shown?.destroy();
    this.#show(next);
    return undefined;
  }

  /**
   * Lets nodes that failed be asked for again, of what is drawn and of what is to take its place, and points that could not be
   * placed at all.
   */
  retryFailed(): void {
    if (this.#progress === "failed") this.#progress = "again";
    for (const placed of [this.#shown, this.#next]) placed?.octree.stream.retryFailed();
  }

  /** Nothing of it is drawn, or brought, for now. */
  rest(): void {
    this.#shown?.rest(false);
    this.#next?.rest(false);
  }

  /** Gives up all of it. */
  clear(): void {
    this.#turn++;
    this.#asked = undefined;
    this.#progress = "here";
    this.#dropNext();
    this.#shown?.destroy();
    this.#shown = undefined;
  }

  async #await(
    placing: Promise<PlacedOctree>,
    wish: PlacingWish,
    gl: WebGL2RenderingContext,
    turn: number,
  ): Promise<void> {
    const { cloud, projection } = wish;
    try {
      const octree = await placing;
      if (turn !== this.#turn) {
        cloud.maps.release(octree);
        return;
      }
      if (octree === this.#shown?.octree && projection === this.#shown.projection) {
        // It is as exact as the closer view asks for.
        cloud.maps.release(octree);
        this.#progress = "here";
      } else {
        const next = new PlacedFrames({ cloud, octree, projection }, gl, this.#owner, this.#events);
        if (this.#shown) this.#next = next;
        else this.#show(next);
      }
    } catch (thrown) {
      if (turn !== this.#turn) return;
      this.#failed(wish);
      this.#events.failed(thrown);
    }
    this.#events.changed();
  }

  #show(placed: PlacedFrames): void {
    this.#shown = placed;
    this.#next = undefined;
    this.#progress = "here";
  }

  /** What was asked for cannot be had: what is drawn stays where it is of the same map. */
  #failed({ projection }: PlacingWish): void {
    this.#progress = "failed";
    if (this.#shown?.projection === projection) return;
    this.#shown?.destroy();
    this.#shown = undefined;
  }

  #dropNext(): void {
    this.#next?.destroy();
    this.#next = undefined;
  }
}
