import { BoundingSphere, type Camera, Cartesian3, Event, SceneMode } from "cesium";
import { ClipSet } from "../clips/index.js";
import { PointCloud, type PointCloudOptions, type StreamProgress } from "../cloud/index.js";
import { ClipAnswers } from "../drawing/clip-answers.js";
import { Completion } from "../drawing/completion.js";
import { CostMeter } from "../drawing/cost-meter.js";
import { FrameAllowance } from "../drawing/frame-allowance.js";
import { FrameFailures } from "../drawing/frame-failures.js";
import { checkHeightOffset, liftOf } from "../drawing/height-offset.js";
import {
  asksForSilhouettes,
  type CloudPlacing,
  checkFilter,
  cloudPlacing,
  completeStyle,
  defaultStyle,
  type EffectName,
  type Forced,
  type LedgerRow,
  type PointCloudStyle,
  type PointFilter,
  placingFacts,
  planEffects,
  type StyleParts,
} from "../effects/index.js";
import type { NodeBounds, OctreeNode, Selection, SharedBudget } from "../octree/index.js";
import type { Context, FrameState } from "./engine/cesium-private.js";
import { ContextWatch } from "./engine/context-watch.js";
import { NO_OBJECTS } from "./engine/gpu-objects.js";
import { viewOfFrame } from "./frame-view.js";
import {
  type LayerSource,
  type LayerStatistics,
  type PickResult,
  type PointCloudLayerOptions,
  resolveSource,
} from "./layer-options.js";
import { LayerRenderer, type PickOptions } from "./layer-renderer.js";
import { sceneFacts } from "./scene-facts.js";

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
  /** Points and bytes that this layer shares with others. */
  budget: SharedBudget | undefined;
  /** Effects that are on or off whatever the scene calls for. */
  forced: Forced;
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

  /**
   * Raised with what kept a frame, or volumes, from being drawn: once, and again only when a frame was whole in between.
   * The layer goes on with the former volumes, or shows nothing until it can.
   */
  readonly error = new Event<(error: Error) => void>();

  readonly #ownsCloud: boolean;
  readonly #picked: object;
  readonly #placing: CloudPlacing;
  readonly #unsubscribe: () => void;
  readonly #completion = new Completion();
  readonly #costs = new CostMeter();
  readonly #clips = new ClipAnswers();
  readonly #watch = new ContextWatch(() => this.#release());
  readonly #failures = new FrameFailures();
  #clipSet: ClipSet;
  #style: PointCloudStyle;
  #filter: PointFilter | undefined;
  #heightOffset = 0;
  #renderer: LayerRenderer | undefined;
  #selection: Selection | undefined;
  #ledger: readonly LedgerRow[] = [];
  /** Effects that the last frame called for. */
  #active: ReadonlySet<EffectName> = new Set();
  #frameStart = 0;
  /** Parts of a frame that have run before. */
  readonly #begun = new Set<string>();
  #warned = false;
  #destroyed = false;

  /** @param ownsCloud whether `destroy()` destroys the cloud too; a cloud that several views share stays */
  private constructor(cloud: PointCloud, options: PointCloudLayerOptions, ownsCloud: boolean) {
    this.cloud = cloud;
    this.#placing = cloudPlacing(cloud);
    this.#ownsCloud = ownsCloud;
    this.show = options.show ?? true;
    this.maximumScreenSpaceError = options.maximumScreenSpaceError ?? 2;
    this.budget = options.budget;
    this.pointBudget = options.pointBudget ?? (options.budget ? Number.POSITIVE_INFINITY : 1_000_000);
    this.#clipSet = options.clips ?? new ClipSet();
    this.filter = options.filter;
    this.forced = options.forced ?? {};
    this.#style = defaultStyle(cloud.hasColour);
    this.style = options.style ?? {};
    this.#picked = { primitive: this, id: options.id ?? cloud.name };
    this.boundingSphere = new BoundingSphere(new Cartesian3(), cloud.bounds.radius);
    this.heightOffset = options.heightOffset ?? 0;
    this.#unsubscribe = cloud.stream.subscribe({
      nodeLoaded: (node) => this.nodeLoaded.raiseEvent(node.name),
      nodeFailed: (node, error) => this.nodeFailed.raiseEvent(node.name, error),
      nodeEvicted: (node) => this.#renderer?.free(node),
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

  set style(parts: StyleParts) {
    const { attributes, name } = this.cloud;
    this.#style = completeStyle(parts, this.#style, { attributes, file: name });
  }

  /** Which points are drawn and picked; undefined: all. @throws StyleError STYLE_FILTER */
  get filter(): PointFilter | undefined {
    return this.#filter;
  }

  set filter(filter: PointFilter | undefined) {
    const { attributes, name } = this.cloud;
    this.#filter = filter && checkFilter(filter, { attributes, file: name });
  }

  /** Volumes that cut or highlight; assigning undefined gives the layer an empty set of its own. */
  get clips(): ClipSet {
    return this.#clipSet;
  }

  set clips(clips: ClipSet | undefined) {
    this.#clipSet = clips ?? new ClipSet();
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

  /**
   * Every effect that the last frame could have had: how much it would change, what that is held against, whether it
   * ran and why, and what it costs as far as frames with and without it were seen.
   */
  get ledger(): readonly LedgerRow[] {
    return this.#costs.complete({
      active: this.#renderer?.plan?.active ?? new Set<EffectName>(),
      ledger: this.#ledger,
    });
  }

  get statistics(): LayerStatistics {
    const renderer = this.#renderer;
    const nodes = renderer?.nodes ?? [];
    return {
      nodesVisible: this.#completion.progress.wanted,
      nodesLoaded: nodes.length,
      nodesFailed: this.#completion.progress.failed,
      pointsDrawn: nodes.reduce((sum, { count }) => sum + count, 0),
      budgetReached: this.#selection?.limited ?? false,
      requestsPending: this.#destroyed ? 0 : this.cloud.stream.active,
      gpuBytes: renderer?.objects.bytes ?? 0,
      gpuObjects: renderer?.objects.counts ?? NO_OBJECTS,
      gpuMilliseconds: renderer?.gpuMilliseconds ?? { points: undefined, picture: undefined },
    };
  }

  /**
   * True once the last frame showed all that its view wanted as far as it can be had: nothing is on its way, and
   * the camera has not moved since. Nodes that failed do not keep it from settling, unlike `allNodesLoaded`.
   */
  get settled(): boolean {
    const lifted = this.#renderer !== undefined && this.#renderer.heightOffset !== this.#heightOffset;
    const restyled = this.#renderer?.style !== undefined && this.#renderer.style !== this.#style;
    return this.#completion.settled(this.show) && !lifted && !restyled;
  }

  /**
   * The point drawn nearest to a place of the canvas, as it is recorded in the file. Found among what the last frame
   * drew, by the points' size and shape and what clips and filter leave; other primitives and the globe are not looked
   * at. Waits for the GPU without stopping it; picks may overlap, and `scene.pick` is not touched.
   * @param windowPosition CSS pixels from the upper left, as `scene.pick` takes it
   * @returns undefined where there is no point
   * @throws SourceError, DecodeError where the record cannot be read again; the signal's reason when aborted
   */
  async pick(
    windowPosition: { readonly x: number; readonly y: number },
    options: PickOptions = {},
  ): Promise<PickResult<this> | undefined> {
    const found = await this.#renderer?.pick(windowPosition, options);
    if (!found || this.#destroyed) return undefined;
    const { cloud } = this;
    const record = await cloud.readPoint(found.drawn.node, found.index, { signal: options.signal });
    return { ...record, layer: this, cloud, position: cloud.place(...record.source) };
  }

  /** Lets nodes that failed be asked for again. */
  retryFailed(): void {
    this.cloud.stream.retryFailed();
  }

  /** Called by Cesium for each frame and pass. Never throws, which would end Cesium's render loop. */
  update(frameState: FrameState): void {
    if (this.#destroyed) return;
    try {
      this.#draw(frameState);
    } catch (thrown) {
      this.#tell(thrown, frameState);
      this.#rest();
    }
  }

  #draw(frameState: FrameState): void {
    const { passes, context, mode } = frameState;
    this.#renderer?.lift(this.#heightOffset);
    const flat = mode === SceneMode.SCENE2D || mode === SceneMode.COLUMBUS_VIEW;
    if (flat && this.show) this.#warnOfFlatView();
    // A lost context takes no commands.
    if (!this.show || mode !== SceneMode.SCENE3D || context._gl.isContextLost()) {
      this.#rest();
      return;
    }
    if (passes.render) this.#render(frameState);
    else if (passes.pick || passes.depth) this.#renderer?.repeat(frameState);
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
    this.#release();
    this.#watch.destroy();
    if (this.#ownsCloud) this.cloud.destroy();
    return undefined;
  }

  /** Frees all that is on the GPU. */
  #release(): void {
    this.#renderer?.destroy();
    this.#renderer = undefined;
    this.budget?.gpu.report(this, 0);
  }

  #rest(): void {
    if (this.#selection) this.cloud.stream.detach(this);
    this.#selection = undefined;
    this.#renderer?.rest();
    this.#clips.rest();
    this.#completion.rest(this.show);
  }

  #render(frameState: FrameState): void {
    const { context, afterRender } = frameState;
    const { stream } = this.cloud;
    const { maximumScreenSpaceError, pointBudget, budget, clips } = this;
    const view = viewOfFrame(frameState, liftOf(this.cloud.bounds, this.#heightOffset));
    const allowance = new FrameAllowance();
    const answers = this.#clips;
    answers.follow(clips, this.cloud, allowance);
    this.#tell(answers.takeFailure(), frameState);
    if (answers.blocked) {
      this.#rest();
      return;
    }
    const rejects = (bounds: NodeBounds) => answers.rejects(bounds, allowance);
    const options = { maximumScreenSpaceError, pointBudget, budget, rejects };
    const selection = stream.update(this, view, options);
    this.#selection = selection;
    if (this.#endsWith("selection", frameState)) return;
    const renderer = this.#rendererFor(context);
    const verticesOf = (node: OctreeNode) => stream.vertices(node);
    const facts = sceneFacts(frameState, selection, verticesOf, {
      attributes: this.cloud.attributes,
      clips: answers.volumes?.cutting ?? 0,
      highlights: answers.volumes?.highlighting ?? 0,
      filter: this.filter,
      silhouettes: renderer.silhouettes,
      placing: placingFacts(
        this.#placing,
        selection.nodes.flatMap((node) => verticesOf(node) ?? []),
      ),
    });
    if (this.#endsWith("facts", frameState)) return;
    // Weighted sums need colours finer than bytes.
    const forced = context.colorBufferHalfFloat ? this.forced : { ...this.forced, splats: false };
    const plan = planEffects(this.#style, facts, forced, this.#active);
    this.#active = plan.active;
    this.#ledger = plan.ledger;
    if (this.#endsWith("plan", frameState)) return;
    const { cloud, style } = this;
    const request = { selection, cloud, plan, style, facts, clips: answers, allowance };
    const waiting = renderer.render(frameState, request);
    const probing = renderer.probe(asksForSilhouettes(style, forced), request);
    if (budget) renderer.keepWithin(budget.gpu, this);
    this.#measure(renderer);
    const progress = stream.progress(this);
    const { changed, finished, done } = this.#completion.note({
      progress,
      drawn: waiting === 0 && !answers.pending && !probing && (budget?.balanced ?? true),
      idle: stream.active === 0,
      pose: poseOf(frameState.camera),
    });
    if (done) this.#failures.clear();
    // Events go out after the frame, where a listener may change the scene.
    afterRender.push(() => {
      if (changed) raise(this.loadProgress, progress);
      if (finished) raise(this.allNodesLoaded);
      return !done;
    });
  }

  /** Raises what failed as an event after the frame, unless it is known. */
  #tell(thrown: unknown, { afterRender }: FrameState): void {
    const error = this.#failures.note(thrown, this.cloud.name);
    if (!error) return;
    afterRender.push(() => {
      raise(this.error, error);
      return false;
    });
  }

  /**
   * True the first time that a part of a frame has run, which takes many times as long as any later one: with it the
   * frame ends. Nothing stands yet that would go missing.
   */
  #endsWith(part: "selection" | "facts" | "plan", { afterRender }: FrameState): boolean {
    if (this.#begun.has(part)) return false;
    this.#begun.add(part);
    afterRender.push(() => true);
    return true;
  }

  /** Notes what the frame cost: as the GPU says, else from frame to frame while they follow each other. */
  #measure({
    plan,
    nodes,
    measuresGpu,
    gpuMilliseconds: { points: drawing, picture = 0 },
  }: LayerRenderer): void {
    const now = performance.now();
    const interval = now - this.#frameStart;
    this.#frameStart = now;
    if (!plan) return;
    const points = nodes.reduce((sum, { count }) => sum + count, 0);
    if (drawing !== undefined) {
      this.#costs.note({ plan, points, milliseconds: drawing + picture, by: "timer query" });
    } else if (!measuresGpu && interval < LONGEST_FRAME) {
      this.#costs.note({ plan, points, milliseconds: interval, by: "frame difference" });
    }
  }

  #rendererFor(context: Context): LayerRenderer {
    if (this.#renderer && this.#renderer.objects.context !== context) {
      // The primitive was moved to another scene: nothing of the first context can be used in it.
      this.#release();
    }
    this.#watch.follow(context);
    if (!this.#renderer) {
      this.#renderer = new LayerRenderer(context, this, this.#picked, this.#watch.losses);
      this.#renderer.lift(this.#heightOffset);
    }
    return this.#renderer;
  }

  #warnOfFlatView(): void {
    if (this.#warned) return;
    this.#warned = true;
    console.warn(`${this.cloud.name}: point clouds are drawn in 3D only, not in 2D and Columbus view`);
  }
}

/** Raises an event within Cesium's render loop, which an error of a listener must not end. */
function raise<Arguments extends unknown[]>(
  event: Event<(...values: Arguments) => void>,
  ...values: Arguments
): void {
  try {
    event.raiseEvent(...values);
  } catch (thrown) {
    reportError(thrown);
  }
}

/** Where a camera is and looks at the time of asking. */
function poseOf(camera: Camera): () => string {
  return () => `${camera.positionWC} ${camera.directionWC} ${camera.upWC}`;
}

/** Milliseconds; what lies further apart are frames on demand, whose distance says nothing. */
const LONGEST_FRAME = 1000;
