import type Projection from "ol/proj/Projection.js";
import type { PlacedOctree, PointCloud } from "../cloud/index.js";
import { type FrameReport, LayerFrames, type LayerSettings } from "../drawing/frame.js";
import { LayerRenderer } from "../webgl2/layer-renderer.js";
import type { GlView } from "../webgl2/node-drawable.js";
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
    this.#mask = new ExtentMask(this.renderer.objects);
    this.#unsubscribe = octree.stream.subscribe({
      nodeLoaded: changed,
      nodeFailed: (_node, error) => {
        failed(error);
        changed();
      },
      nodeEvicted: (node) => this.renderer.content.free(node),
    });
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

  #cameraOf(frame: AskedFrame): MapCamera {
    const { plane, bounds } = this.octree;
    if (!plane || !bounds) throw new TypeError("a map needs an octree in its plane");
    return mapCamera({ ...frame, metresPerUnit: plane.metresPerUnit, bounds });
  }
}
