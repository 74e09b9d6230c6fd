import { BoundingSphere, type Camera, Cartesian3, Event, SceneMode } from "cesium";
import { PointCloud, type PointCloudOptions, type StreamProgress } from "../cloud/index.js";
import type { OctreeNode, Selection } from "../octree/index.js";
import type { Context, DrawCommand, FrameState } from "./cesium-private.js";
import { viewOfFrame } from "./frame-view.js";
import { checkHeightOffset, liftOf } from "./height-offset.js";
import { LayerResources } from "./layer-resources.js";
import { NodeUploads } from "./node-uploads.js";
import { type LayerSource, resolveSource } from "./source-from-resource.js";
import { completeStyle, defaultStyle, type PointCloudStyle } from "./style.js";

/** How a layer draws; all can be changed later. */
export interface PointCloudLayerOptions {
  /** Default: true. */
  readonly show?: boolean;
  readonly style?: Partial<PointCloudStyle>;
  /** Pixels between neighbouring points above which the next level is drawn. Default: 2. */
  readonly maximumScreenSpaceError?: number;
  /** Most points drawn at once. Default: 1,000,000. */
  readonly pointBudget?: number;
  /** Metres above their places at which points are drawn, for looks only. Default: 0. */
  readonly heightOffset?: number;
  /** What `scene.pick` returns as `id`. Default: the cloud's name. */
  readonly id?: unknown;
}

/** Numbers about the frame drawn last. */
export interface LayerStatistics {
  /** Nodes with points that the view wants. */
  readonly nodesVisible: number;
  /** Of these, drawn. */
  readonly nodesLoaded: number;
  /** Of these, failed; hierarchy pages that cannot be read count as well. Never counted as loaded. */
  readonly nodesFailed: number;
  readonly pointsDrawn: number;
  /** True where the point budget, not the screen-space error, ended the refinement. */
  readonly budgetReached: boolean;
  /** Nodes and pages being loaded. */
  readonly requestsPending: number;
  /** Bytes of vertices on the GPU. */
  readonly gpuBytes: number;
  /** GPU buffers alive; 0 after `destroy()`. */
  readonly gpuBuffers: number;
}

/**
 * A georeferenced point cloud for `viewer.scene.primitives`.
 *
 * Each node is drawn with an own matrix node frame → ECEF, which Cesium multiplies with the view in float64:
 * no coordinate of the earth's size ever becomes a float32. Drawn in 3D only, not in 2D and Columbus view.
 */
export class PointCloudLayer {
  /** Whether the layer is drawn; a hidden layer loads nothing. */
  show: boolean;
  /** Pixels between neighbouring points above which the next level is drawn. */
  maximumScreenSpaceError: number;
  /** Most points drawn at once. */
  pointBudget: number;
  /** The data set. */
  readonly cloud: PointCloud;
  /** Sphere around all points as they are drawn, to fly to; moves with {@link heightOffset}. */
  readonly boundingSphere: BoundingSphere;
  /** Raised with a node's name (`depth-x-y-z`) once its points are here. */
  readonly nodeLoaded = new Event<(name: string) => void>();
  /** Raised with a node's name and the error, a `GromaError` with a code. */
  readonly nodeFailed = new Event<(name: string, error: Error) => void>();
  /** Raised when all that the current view wants is drawn and nothing is on its way; not while any of it failed. */
  readonly allNodesLoaded = new Event<() => void>();
  /** Raised when the numbers of wanted, ready, failed and pending nodes change. */
  readonly loadProgress = new Event<(progress: StreamProgress) => void>();

  readonly #ownsCloud: boolean;
  readonly #picked: object;
  readonly #uploads = new NodeUploads();
  readonly #unsubscribe: () => void;
  #style: PointCloudStyle;
  #heightOffset = 0;
  #resources: LayerResources | undefined;
  #context: Context | undefined;
  #commands: DrawCommand[] = [];
  #selection: Selection | undefined;
  #progress: StreamProgress = { wanted: 0, ready: 0, failed: 0, pending: 0 };
  #points = 0;
  #drawn = 0;
  #complete = false;
  #settled = false;
  /** `show` as the last frame found it. */
  #shown: boolean | undefined;
  #camera: Camera | undefined;
  #pose = "";
  #destroyed = false;

  /** @param ownsCloud whether `destroy()` destroys the cloud too; a cloud that several views share stays */
  private constructor(cloud: PointCloud, options: PointCloudLayerOptions, ownsCloud: boolean) {
    this.cloud = cloud;
    this.#ownsCloud = ownsCloud;
    this.show = options.show ?? true;
    this.maximumScreenSpaceError = options.maximumScreenSpaceError ?? 2;
    this.pointBudget = options.pointBudget ?? 1_000_000;
    this.#style = defaultStyle(cloud.hasColour);
    this.style = options.style ?? {};
    this.#picked = { primitive: this, id: options.id ?? cloud.name };
    this.boundingSphere = new BoundingSphere(new Cartesian3(), cloud.bounds.radius);
    this.heightOffset = options.heightOffset ?? 0;
    this.#unsubscribe = cloud.stream.subscribe({
      nodeLoaded: (node) => this.nodeLoaded.raiseEvent(node.name),
      nodeFailed: (node, error) => this.nodeFailed.raiseEvent(node.name, error),
      nodeEvicted: (node) => this.#uploads.free(node),
    });
  }

  /**
   * Opens a data set and makes a layer of it, which owns it.
   * @throws SourceError, FormatError, CrsError, PlacementError, RecordError, StyleError
   */
  static async fromUrl(
    source: LayerSource,
    options: PointCloudLayerOptions & PointCloudOptions = {},
  ): Promise<PointCloudLayer> {
    const { from, http } = resolveSource(source);
    const cloud = await PointCloud.fromUrl(from, { ...http, ...options });
    try {
      return new PointCloudLayer(cloud, options, true);
    } catch (thrown) {
      cloud.destroy();
      throw thrown;
    }
  }

  /** A layer of a data set that is open already, and that stays open when the layer is destroyed. */
  static fromCloud(cloud: PointCloud, options: PointCloudLayerOptions = {}): PointCloudLayer {
    return new PointCloudLayer(cloud, options, false);
  }

  /** How points are drawn. Assigning some of the properties leaves the others as they are. @throws StyleError */
  get style(): PointCloudStyle {
    return this.#style;
  }

  set style(parts: Partial<PointCloudStyle>) {
    const { hasColour, name } = this.cloud;
    const style = completeStyle(parts, this.#style, hasColour, name);
    if (style.color !== this.#style.color && this.#resources) {
      this.#uploads.setProgram(this.#resources.program(style.color));
    }
    this.#style = style;
  }

  /**
   * Metres above their places at which points are drawn, along the local up: to lift a cloud out of a terrain that
   * does not fit it. For looks only: `cloud.place`, `cloud.loadNode` and `cloud.accuracy` know nothing of it, while
   * what Cesium reads from the picture (`scene.pickPosition`) includes it. From −10,000 to 10,000. @throws StyleError
   */
  get heightOffset(): number {
    return this.#heightOffset;
  }

  set heightOffset(metres: number) {
    const { bounds, name } = this.cloud;
    this.#heightOffset = checkHeightOffset(metres, name);
    const [x, y, z] = liftOf(bounds, metres);
    Cartesian3.fromElements(bounds.x + x, bounds.y + y, bounds.z + z, this.boundingSphere.center);
  }

  get statistics(): LayerStatistics {
    return {
      nodesVisible: this.#progress.wanted,
      nodesLoaded: this.#drawn,
      nodesFailed: this.#progress.failed,
      pointsDrawn: this.#points,
      budgetReached: this.#selection?.limited ?? false,
      requestsPending: this.#destroyed ? 0 : this.cloud.stream.active,
      gpuBytes: this.#uploads.bytes,
      gpuBuffers: this.#uploads.buffers,
    };
  }

  /**
   * True once the last frame showed all that its view wanted as far as it can be had: nothing is on its way, and
   * the camera has not moved since. Nodes that failed do not keep it from settling, unlike `allNodesLoaded`.
   */
  get settled(): boolean {
    const moved = this.#camera !== undefined && this.#pose !== poseOf(this.#camera);
    const lifted = this.#uploads.heightOffset !== this.#heightOffset;
    return this.#settled && this.#shown === this.show && !moved && !lifted;
  }

  /** Lets nodes that failed be asked for again. */
  retryFailed(): void {
    this.cloud.stream.retryFailed();
  }

  /** Called by Cesium for each frame and pass. */
  update(frameState: FrameState): void {
    if (this.#destroyed) return;
    const { passes, context, mode } = frameState;
    this.#uploads.lift(this.#heightOffset);
    // A lost context takes no commands; what was on the GPU is gone until the page makes a new viewer.
    if (!this.show || mode !== SceneMode.SCENE3D || context._gl.isContextLost()) {
      this.#rest();
      return;
    }
    if (passes.render) this.#refresh(frameState);
    if (passes.render || passes.pick || passes.depth) frameState.commandList.push(...this.#commands);
  }

  isDestroyed(): boolean {
    return this.#destroyed;
  }

  /** Frees all GPU objects, stops loading and, where the layer opened it, closes the data set. */
  destroy(): undefined {
    if (this.#destroyed) return undefined;
    this.#destroyed = true;
    this.#rest();
    this.#unsubscribe();
    this.#uploads.destroy();
    this.#resources?.destroy();
    this.#resources = undefined;
    if (this.#ownsCloud) this.cloud.destroy();
    return undefined;
  }

  #rest(): void {
    this.#shown = this.show;
    if (this.#selection) this.cloud.stream.detach(this);
    this.#selection = undefined;
    this.#commands = [];
    this.#points = 0;
    this.#drawn = 0;
    this.#progress = { wanted: 0, ready: 0, failed: 0, pending: 0 };
    this.#complete = false;
    // Where nothing is to be drawn, nothing is to be waited for.
    this.#settled = true;
    this.#camera = undefined;
  }

  #refresh(frameState: FrameState): void {
    const { context, afterRender } = frameState;
    const { stream } = this.cloud;
    const resources = this.#resourcesFor(context);
    const { maximumScreenSpaceError, pointBudget } = this;
    const view = viewOfFrame(frameState, liftOf(this.cloud.bounds, this.#heightOffset));
    const selection = stream.update(this, view, { maximumScreenSpaceError, pointBudget });
    this.#selection = selection;
    const waiting = this.#uploads.upload(
      context,
      selection.nodes,
      (node) => stream.vertices(node),
      resources.shared(this.#style.color),
    );
    this.#collect(selection.nodes);
    const changed = this.#report(stream.progress(this));
    const done = this.#progress.pending === 0 && waiting === 0;
    const complete = done && this.#progress.failed === 0 && stream.active === 0;
    const finished = complete && !this.#complete;
    this.#complete = complete;
    this.#settled = done;
    this.#shown = true;
    this.#camera = frameState.camera;
    this.#pose = poseOf(frameState.camera);
    // Events go out after the frame, where a listener may change the scene.
    const progress = this.#progress;
    afterRender.push(() => {
      if (changed) this.loadProgress.raiseEvent(progress);
      if (finished) this.allNodesLoaded.raiseEvent();
      return !done;
    });
  }

  #collect(nodes: readonly OctreeNode[]): void {
    this.#commands = [];
    this.#points = 0;
    this.#drawn = 0;
    for (const node of nodes) {
      const drawable = this.#uploads.get(node);
      if (!drawable) continue;
      this.#commands.push(drawable.command);
      this.#points += drawable.count;
      this.#drawn++;
    }
  }

  /** @returns whether the numbers changed */
  #report(now: StreamProgress): boolean {
    const then = this.#progress;
    this.#progress = now;
    return (
      now.wanted !== then.wanted ||
      now.ready !== then.ready ||
      now.failed !== then.failed ||
      now.pending !== then.pending
    );
  }

  #resourcesFor(context: Context): LayerResources {
    if (this.#context !== context) {
      // The primitive was moved to another scene: nothing of the first context can be used in it.
      this.#uploads.destroy();
      this.#resources?.destroy();
      this.#resources = undefined;
      this.#context = context;
    }
    const { cloud } = this;
    const style = () => this.#style;
    this.#resources ??= new LayerResources(context, this, this.#picked, {
      get style() {
        return style();
      },
      get intensityRange() {
        return cloud.intensityRange;
      },
    });
    return this.#resources;
  }
}

/** Where a camera is and looks, in a form that can be compared. */
function poseOf({ positionWC, directionWC, upWC }: Camera): string {
  return `${positionWC} ${directionWC} ${upWC}`;
}
