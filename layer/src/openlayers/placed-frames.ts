import type Projection from "ol/proj/Projection.js";
import { noPlace, type PlacedOctree, type PointCloud } from "../cloud/index.js";
import { type FrameReport, LayerFrames, type LayerSettings } from "../drawing/frame.js";
import { LayerRenderer } from "../webgl2/layer-renderer.js";
import type { GlView } from "../webgl2/node-drawable.js";
import type { NodeVertices } from "../workers/index.js";
import { type Corners, ExtentMask } from "./extent-mask.js";
import { type MapCamera, type MapFrame, mapCamera } from "./map-camera.js";

/** A frame as a map asks for it. */
type AskedFrame = Omit<MapFrame, "metresPerUnit" | "bounds">;

/** Points as they are placed in the plane of a map. */
interface PlacedPoints {
  readonly cloud: PointCloud;
  readonly octree: PlacedOctree;
  readonly projection: Projection;
}

/** The frames of a layer in one projection of a map, and what it has on the GPU for them. */
export class PlacedFrames implements PlacedPoints {
  readonly cloud: PointCloud;
  readonly octree: PlacedOctree;
  readonly projection: Projection;
  readonly frames: LayerFrames<GlView>;
  readonly renderer: LayerRenderer;
  readonly #mask: ExtentMask;
  readonly #failed: (error: Error) => void;
  /** Least and greatest y that the map's world has, units of the projection; undefined where it has no such edges. */
  readonly #world: readonly [number, number] | undefined;
  #crossed = false;
  readonly #unsubscribe: () => void;

  /**
   * @param owner the layer, by which stream and budgets know it
   * @param changed called when points have come, or are gone
   * @param failed called with what cannot be had
   */
  constructor(
    { cloud, octree, projection }: PlacedPoints,
    gl: WebGL2RenderingContext,
    owner: object,
    { changed, failed }: { readonly changed: () => void; readonly failed: (error: Error) => void },
  ) {
    this.cloud = cloud;
    this.octree = octree;
    this.projection = projection;
    this.frames = new LayerFrames(cloud, owner, octree);
    this.renderer = new LayerRenderer(gl);
    this.#failed = failed;
    const world = projection.canWrapX() ? projection.getExtent() : undefined;
    this.#world = world && [world[1], world[3]];
    octree.stream.forEachVertices((vertices) => this.#holdAgainst(vertices));
    this.#mask = new ExtentMask(this.renderer.objects);
    this.#unsubscribe = octree.stream.subscribe({
      nodeLoaded: (node) => {
        const vertices = octree.stream.vertices(node);
        if (vertices) this.#holdAgainst(vertices);
        changed();
      },
      nodeFailed: (_node, error) => {
        failed(error);
        changed();
      },
      nodeEvicted: (node) => this.renderer.content.free(node),
    });
  }

  /** Least and greatest y that may be drawn, units of the projection; undefined where no point lies beyond. */
  get edges(): readonly [number, number] | undefined {
    return this.#crossed ? this.#world : undefined;
  }

  /** Draws a frame. @param extent beyond which nothing of it shows */
  draw(
    settings: LayerSettings,
    frame: AskedFrame,
    extent: Corners | undefined,
  ): FrameReport | "unfinished" | "blocked" {
    const camera = this.#cameraOf(frame);
    return this.frames.draw(settings, camera.frame, () => {
      this.renderer.begin(camera, extent && ((screen) => this.#mask.draw(screen, extent, camera.pixelRatio)));
      return this.renderer;
    });
  }

  /** Brings and uploads what a frame shows and draws nothing, before the first one is drawn. */
  prepare(settings: LayerSettings, frame: AskedFrame): FrameReport | "unfinished" | "blocked" {
    // A renderer that has no camera yet leaves the canvas as it is.
    return this.frames.draw(settings, this.#cameraOf(frame).frame, () => this.renderer);
  }

  /** Nothing is drawn for now. */
  rest(show: boolean): void {
    this.frames.rest(show);
    this.renderer.rest();
  }

  /** Frees all, and gives the octree back. */
  destroy(): void {
    this.rest(false);
    this.#unsubscribe();
    this.renderer.destroy();
    this.cloud.maps.release(this.octree);
  }

  /** Tells, once, of points beyond the edge of the map's world: towards the poles Mercator's plane goes on without end. */
  #holdAgainst({ frame, box, bound }: NodeVertices): void {
    if (this.#crossed || !this.#world) return;
    const { metresPerUnit = 1, code = "" } = this.octree.plane ?? {};
    const [south, north] = this.#world.map((edge) => edge * metresPerUnit);
    const [low, high] = [box[1], box[4]].map((y) => frame.origin[1] + y);
    this.#crossed = low < south - bound || high > north + bound;
    if (this.#crossed) this.#failed(noPlace(this.cloud.name, code));
  }

  #cameraOf(frame: AskedFrame): MapCamera {
    const { plane, bounds } = this.octree;
    if (!plane || !bounds) throw new TypeError("a map needs an octree in its plane");
    return mapCamera({ ...frame, metresPerUnit: plane.metresPerUnit, bounds });
  }
}
