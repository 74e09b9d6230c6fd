import type { Vector } from "@groma/georef";
import { Cartesian3, SceneMode } from "cesium";
import type { PointCloud } from "../cloud/index.js";
import type { PickOptions } from "../drawing/drawing-options.js";
import { LayerFrames, type LayerSettings } from "../drawing/frame.js";
import { liftOf } from "../drawing/height-offset.js";
import type { LedgerRow } from "../effects/index.js";
import type { OctreeNode, SharedBudget } from "../octree/index.js";
import type { FrameState } from "./engine/cesium-private.js";
import { ContextWatch } from "./engine/context-watch.js";
import { cameraOfFrame } from "./frame-camera.js";
import { type EventSource, FrameEvents } from "./frame-events.js";
import type { WindowPosition } from "./layer-options.js";
import { LayerRenderer } from "./layer-renderer.js";
import { type LayerStatistics, statisticsOf } from "./layer-statistics.js";
import type { CesiumView } from "./node-drawable.js";

/** A layer as its properties stand at a frame, and the events that tell of it. */
interface DrawnLayer extends LayerSettings, EventSource {
  readonly cloud: PointCloud;
  readonly show: boolean;
  /** Metres. */
  readonly heightOffset: number;
}

/** A layer as a scene of Cesium draws it: its frames, what is on the GPU for them in the scene's context, and its events. */
export class SceneDrawing {
  readonly #layer: DrawnLayer;
  readonly #picked: object;
  readonly #frames: LayerFrames<CesiumView>;
  readonly #watch = new ContextWatch(() => this.#release());
  readonly #events: FrameEvents;
  #renderer: LayerRenderer | undefined;

  /** @param picked what `scene.pick` returns */
  constructor(layer: DrawnLayer, picked: object) {
    this.#layer = layer;
    this.#picked = picked;
    this.#frames = new LayerFrames(layer.cloud, layer);
    this.#events = new FrameEvents(layer);
  }

  get ledger(): readonly LedgerRow[] {
    return this.#frames.ledger(this.#renderer?.content.material?.plan.active);
  }

  /** @param requestsPending nodes and pages being loaded */
  statistics(requestsPending: number): LayerStatistics {
    return statisticsOf(this.#frames, this.#renderer, requestsPending);
  }

  /** Whether the last frame showed all that can be had of what the layer is to show as it stands now. */
  get settled(): boolean {
    const { show, heightOffset, style } = this.#layer;
    const content = this.#renderer?.content;
    const lifted = content !== undefined && content.heightOffset !== heightOffset;
    const drawn = content?.material?.style;
    const restyled = drawn !== undefined && drawn !== style;
    return this.#frames.settled(show) && !lifted && !restyled;
  }

  /** Runs once what the first frame will run, see {@link LayerFrames.rehearse}. */
  rehearse(): void {
    this.#frames.rehearse(this.#layer);
  }

  /** Has the scene draw a frame whenever another view has changed the parts of this budget. */
  watch(budget: SharedBudget | undefined): void {
    this.#events.watch(budget);
  }

  /** Has the scene that showed the layer last draw a frame. */
  redraw(): void {
    this.#events.redraw();
  }

  /** The point that the last frame shows nearest to a place of the canvas. */
  async pick(position: WindowPosition, options: PickOptions) {
    return this.#renderer?.pick(position, options);
  }

  /** Where that point is drawn, ECEF, metres. */
  async pickPosition(position: WindowPosition, options: PickOptions): Promise<Cartesian3 | undefined> {
    const renderer = this.#renderer;
    const found = await renderer?.pick(position, options);
    return found && renderer?.placeOf(found);
  }

  /** Where points drawn lately lie within some metres of a place: x, y, z of each, ECEF, metres. */
  near(place: Vector, radius: number): readonly number[] {
    return this.#renderer?.near(new Cartesian3(...place), radius) ?? [];
  }

  /** Frees what is on the GPU of a node whose vertices are given up. */
  free(node: OctreeNode): void {
    this.#renderer?.content.free(node);
  }

  /** Draws the layer in one pass of a frame. Never throws, which would end Cesium's render loop. */
  draw(frameState: FrameState): void {
    try {
      this.#pass(frameState);
    } catch (thrown) {
      this.#events.failed(thrown, frameState);
      this.#rest();
    }
  }

  /** Frees all GPU objects, and wants no nodes any more. */
  destroy(): void {
    this.#rest();
    this.#events.watch(undefined);
    this.#release();
    this.#watch.destroy();
  }

  #pass(frameState: FrameState): void {
    const { show, heightOffset } = this.#layer;
    const { passes, context, mode } = frameState;
    this.#renderer?.content.lift(heightOffset);
    if (show) this.#events.shownIn(mode);
    // A lost context takes no commands.
    if (!show || mode !== SceneMode.SCENE3D || context._gl.isContextLost()) {
      this.#rest();
      return;
    }
    if (passes.render) this.#render(frameState);
    else if (passes.pick || passes.depth) this.#renderer?.repeat(frameState);
  }

  #render(frameState: FrameState): void {
    const { cloud, heightOffset } = this.#layer;
    const camera = cameraOfFrame(frameState, liftOf(cloud.bounds, heightOffset));
    // Before the frame's time begins: what a context has, a browser may tell only once all is drawn that it was given.
    const renderer = this.#rendererFor(frameState);
    const report = this.#frames.draw(this.#layer, camera, () => renderer);
    this.#events.failed(this.#frames.takeFailure(), frameState);
    if (report === "blocked") {
      this.#rest();
      return;
    }
    if (report === "unfinished") {
      frameState.afterRender.push(() => true);
      return;
    }
    this.#events.drawn(report, frameState);
  }

  #rendererFor(frameState: FrameState): LayerRenderer {
    const { context } = frameState;
    if (this.#renderer && this.#renderer.objects.context !== context) {
      // The primitive was moved to another scene: nothing of the first context can be used in it.
      this.#release();
    }
    this.#watch.follow(context);
    if (!this.#renderer) {
      this.#renderer = new LayerRenderer(context, this.#layer, this.#picked, this.#watch.losses);
      this.#renderer.content.lift(this.#layer.heightOffset);
    }
    this.#renderer.begin(frameState);
    return this.#renderer;
  }

  #rest(): void {
    this.#frames.rest(this.#layer.show);
    this.#renderer?.rest();
  }

  /** Frees all that is on the GPU. */
  #release(): void {
    this.#renderer?.destroy();
    this.#renderer = undefined;
    this.#layer.budget?.gpu.report(this.#layer, 0);
  }
}
