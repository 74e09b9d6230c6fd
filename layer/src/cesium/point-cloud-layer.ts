import type { Vector } from "@groma/georef";
import { BoundingSphere, Cartesian3, DeveloperError, Event } from "cesium";
import { ClipSet } from "../clips/index.js";
import { POINT_CLOUD, PointCloud, type PointCloudOptions, type StreamProgress } from "../cloud/index.js";
import type { PickOptions } from "../drawing/drawing-options.js";
import { checkHeightOffset, liftOf } from "../drawing/height-offset.js";
import {
  checkFilter,
  checkForced,
  completeStyle,
  defaultStyle,
  type Forced,
  type LedgerRow,
  type PointCloudStyle,
  type PointFilter,
  type StyleParts,
} from "../effects/index.js";
import type { SharedBudget } from "../octree/index.js";
import { optionPlace } from "../options/index.js";
import type { FrameState } from "./engine/cesium-private.js";
import {
  checkLayerOption,
  checkLayerOptions,
  checkOpeningOptions,
  checkPick,
  type LayerSource,
  type PickResult,
  type PointCloudLayerOptions,
  resolveSource,
  type WindowPosition,
} from "./layer-options.js";
import type { LayerStatistics } from "./layer-statistics.js";
import { SceneDrawing } from "./scene-drawing.js";

/**
 * A georeferenced point cloud for `viewer.scene.primitives`.
 *
 * Each node is drawn with an own matrix node frame → ECEF, which Cesium multiplies with the view in float64:
 * no coordinate of the earth's size ever becomes a float32. Drawn in 3D only, not in 2D and Columbus view.
 */
export class PointCloudLayer {
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
  readonly #drawing: SceneDrawing;
  readonly #unsubscribe: () => void;
  #show = true;
  #maximumScreenSpaceError = 2;
  #pointBudget = 1_000_000;
  #budget: SharedBudget | undefined;
  #clips = new ClipSet();
  #style: PointCloudStyle;
  #filter: PointFilter | undefined;
  #forced: Forced = {};
  #heightOffset = 0;
  #destroyed = false;

  /** @param ownsCloud whether `destroy()` destroys the cloud too; a cloud that several views share stays */
  private constructor(cloud: PointCloud, options: PointCloudLayerOptions, ownsCloud: boolean) {
    this.cloud = cloud;
    this.#drawing = new SceneDrawing(this, { primitive: this, id: options.id ?? cloud.name });
    this.#ownsCloud = ownsCloud;
    this.show = options.show ?? true;
    this.maximumScreenSpaceError = options.maximumScreenSpaceError ?? 2;
    this.budget = options.budget;
    this.pointBudget = options.pointBudget ?? (options.budget ? Number.POSITIVE_INFINITY : 1_000_000);
    this.clips = options.clips;
    this.filter = options.filter;
    this.forced = options.forced ?? {};
    this.#style = defaultStyle(cloud);
    this.style = options.style ?? {};
    this.boundingSphere = new BoundingSphere(new Cartesian3(), cloud.bounds.radius);
    this.heightOffset = options.heightOffset ?? 0;
    this.#unsubscribe = cloud.stream.subscribe({
      nodeLoaded: (node) => this.nodeLoaded.raiseEvent(node.name),
      nodeFailed: (node, error) => this.nodeFailed.raiseEvent(node.name, error),
      nodeEvicted: (node) => this.#drawing.free(node),
    });
    // On their way while the layer waits for its first frame.
    if (this.#show) {
      cloud.stream.loadRoot();
      this.#drawing.rehearse();
    }
  }

  /**
   * Opens a data set and makes a layer of it, which owns it.
   * @throws SourceError, FormatError, CrsError, PlacementError, RecordError, StyleError
   */
  static async fromUrl(
    source: LayerSource,
    given: PointCloudLayerOptions & PointCloudOptions = {},
  ): Promise<PointCloudLayer> {
    const { options, opening } = checkOpeningOptions(given);
    const { from, http } = resolveSource(source);
    const cloud = await PointCloud.open(from, { ...http, ...opening }, options.show ?? true);
    try {
      return new PointCloudLayer(cloud, options, true);
    } catch (thrown) {
      cloud.destroy();
      throw thrown;
    }
  }

  /**
   * A layer of a data set that is open already, and that stays open when the layer is destroyed.
   * @throws StyleError
   */
  static fromCloud(cloud: PointCloud, options: PointCloudLayerOptions = {}): PointCloudLayer {
    POINT_CLOUD.read(cloud, optionPlace("cloud", "PointCloudLayer.fromCloud"));
    return new PointCloudLayer(cloud, checkLayerOptions(options, cloud.name), false);
  }

  /** Whether the layer is drawn; a hidden layer loads nothing. @throws StyleError STYLE_OPTION */
  get show(): boolean {
    return this.#show;
  }

  set show(show: boolean) {
    this.#mustExist();
    this.#show = this.#checked("show", show);
  }

  /**
   * Pixels between neighbouring points above which the next level is drawn, from 0 on.
   * @throws StyleError STYLE_OPTION
   */
  get maximumScreenSpaceError(): number {
    return this.#maximumScreenSpaceError;
  }

  set maximumScreenSpaceError(pixels: number) {
    this.#mustExist();
    this.#maximumScreenSpaceError = this.#checked("maximumScreenSpaceError", pixels);
  }

  /** Most points drawn at once, from 0 to Infinity. @throws StyleError STYLE_OPTION */
  get pointBudget(): number {
    return this.#pointBudget;
  }

  set pointBudget(points: number) {
    this.#mustExist();
    this.#pointBudget = this.#checked("pointBudget", points);
  }

  /** Points and bytes that this layer shares with others. @throws StyleError STYLE_OPTION */
  get budget(): SharedBudget | undefined {
    return this.#budget;
  }

  set budget(budget: SharedBudget | undefined) {
    this.#mustExist();
    const next = budget === undefined ? undefined : this.#checked("budget", budget);
    if (next !== this.#budget) this.#budget?.gpu.report(this, 0);
    this.#budget = next;
    this.#drawing.watch(this.#budget);
  }

  /** How points are drawn. Assigning some of the properties leaves the others as they are. @throws StyleError */
  get style(): PointCloudStyle {
    return this.#style;
  }

  set style(parts: StyleParts) {
    this.#mustExist();
    this.#style = completeStyle(parts, this.#style, this.cloud);
  }

  /** Which points are drawn and picked; undefined: all. @throws StyleError STYLE_FILTER */
  get filter(): PointFilter | undefined {
    return this.#filter;
  }

  set filter(filter: PointFilter | undefined) {
    this.#mustExist();
    this.#filter = filter && checkFilter(filter, this.cloud);
  }

  /**
   * Volumes that cut or highlight; assigning undefined gives the layer an empty set of its own.
   * @throws StyleError STYLE_OPTION
   */
  get clips(): ClipSet {
    return this.#clips;
  }

  set clips(clips: ClipSet | undefined) {
    this.#mustExist();
    this.#clips = clips === undefined ? new ClipSet() : this.#checked("clips", clips);
  }

  /** Effects that are on or off whatever the scene calls for. @throws StyleError STYLE_FORCED */
  get forced(): Forced {
    return this.#forced;
  }

  set forced(forced: Forced) {
    this.#mustExist();
    this.#forced = checkForced(forced, this.cloud.name);
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
    this.#mustExist();
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
    return this.#drawing.ledger;
  }

  get statistics(): LayerStatistics {
    return this.#drawing.statistics(this.#destroyed ? 0 : this.cloud.stream.active);
  }

  /**
   * True once the last frame showed all that its view wanted as far as it can be had: nothing is on its way, and
   * the camera has not moved since. Nodes that failed do not keep it from settling, unlike `allNodesLoaded`.
   */
  get settled(): boolean {
    return this.#drawing.settled;
  }

  /**
   * The point drawn nearest to a place of the canvas, as it is recorded in the file. Found among what the last frame
   * drew, by the points' size and shape and what clips and filter leave; other primitives and the globe are not looked
   * at. Waits for the GPU without stopping it; picks may overlap, and `scene.pick` is not touched.
   * @param windowPosition CSS pixels from the upper left, as `scene.pick` takes it
   * @returns undefined where there is no point
   * @throws SourceError, DecodeError where the record cannot be read again; the signal's reason when aborted
   * @throws StyleError STYLE_OPTION; DeveloperError after `destroy()`; an AbortError when it is called meanwhile
   */
  async pick(windowPosition: WindowPosition, given: PickOptions = {}): Promise<PickResult<this> | undefined> {
    this.#mustExist();
    const options = checkPick(windowPosition, given, this.cloud.name);
    const found = await this.#drawing.pick(windowPosition, options);
    this.#mustLast();
    if (!found) return undefined;
    const { cloud } = this;
    const record = await cloud.readPoint(found.drawn.node, found.index, { signal: options.signal });
    this.#mustLast();
    const [x, y, z] = cloud.place(...record.source);
    return { ...record, layer: this, cloud, position: new Cartesian3(x, y, z) };
  }

  /**
   * Where that point is drawn, ECEF, metres, with the layer's height offset: nothing is read from the file, so it serves what
   * follows the pointer.
   * @throws as {@link pick}
   */
  async pickPosition(
    windowPosition: WindowPosition,
    given: PickOptions = {},
  ): Promise<Cartesian3 | undefined> {
    this.#mustExist();
    const options = checkPick(windowPosition, given, this.cloud.name);
    const position = await this.#drawing.pickPosition(windowPosition, options);
    this.#mustLast();
    return position;
  }

  /** Where points drawn lately lie within some metres of a place: x, y, z of each, ECEF. @internal */
  drawnNear(place: Vector, radius: number): readonly number[] {
    return this.#drawing.near(place, radius);
  }

  /** Lets nodes that failed be asked for again. */
  retryFailed(): void {
    this.#mustExist();
    this.cloud.stream.retryFailed();
    // Only a frame asks for what its view wants.
    this.#drawing.redraw();
  }

  /** Called by Cesium for each frame and pass. Never throws, which would end Cesium's render loop. @internal */
  update(frameState: FrameState): void {
    if (!this.#destroyed) this.#drawing.draw(frameState);
  }

  isDestroyed(): boolean {
    return this.#destroyed;
  }

  /**
   * Frees all GPU objects, stops loading and, where the layer opened it, closes the data set. Called again it does
   * nothing, since a collection that held the layer may have destroyed it; any other use then throws a DeveloperError.
   */
  destroy(): undefined {
    if (this.#destroyed) return undefined;
    this.#destroyed = true;
    this.#drawing.destroy();
    this.#unsubscribe();
    if (this.#ownsCloud) this.cloud.destroy();
    return undefined;
  }

  #checked<Name extends keyof PointCloudLayerOptions>(
    name: Name,
    value: NonNullable<PointCloudLayerOptions[Name]>,
  ): NonNullable<PointCloudLayerOptions[Name]> {
    return checkLayerOption(name, value, this.cloud.name);
  }

  /** @throws DeveloperError after `destroy()`, in the words of Cesium's own objects */
  #mustExist(): void {
    if (this.#destroyed) throw new DeveloperError("This object was destroyed, i.e., destroy() was called.");
  }

  /** @throws an AbortError where the layer was destroyed while something was on its way */
  #mustLast(): void {
    if (this.#destroyed) throw new DOMException("The layer was destroyed.", "AbortError");
  }
}
