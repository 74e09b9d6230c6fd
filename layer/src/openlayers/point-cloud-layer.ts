import Layer from "ol/layer/Layer.js";
import type OlLayerRenderer from "ol/renderer/Layer.js";
import type { ClipSet } from "../clips/index.js";
import type { PointCloud, PointRecord } from "../cloud/index.js";
import type { PickOptions } from "../drawing/drawing-options.js";
import { type DrawnStatistics, drawnStatistics } from "../drawing/drawn-statistics.js";
import type { Forced, LedgerRow, PointCloudStyle, PointFilter, StyleParts } from "../effects/index.js";
import { callListener } from "../errors/index.js";
import type { SharedBudget } from "../octree/index.js";
import { LayerDrawing } from "./layer-drawing.js";
import { checkPick, drawingOptions, type PointCloudLayerOptions } from "./layer-options.js";
import { MapRenderer } from "./map-renderer.js";
import { PointCloudErrorEvent, type PointCloudSource } from "./point-cloud-source.js";

/** Numbers about the frame drawn last. */
export interface LayerStatistics extends DrawnStatistics {
  /** Frames in which the canvas was drawn; one of a view that stands still is not. */
  readonly framesDrawn: number;
}

/** A point that was picked on a map, as it is recorded. */
export interface PickResult extends PointRecord {
  readonly cloud: PointCloud;
  /** Where the map shows it, in the world in which it was picked, units of the map's projection. */
  readonly coordinate: readonly [number, number];
}

/** A georeferenced point cloud as a layer of OpenLayers, seen from above, in any projection that proj4 knows. */
export class PointCloudLayer extends Layer<PointCloudSource> {
  readonly #drawing: LayerDrawing;

  /** @throws StyleError STYLE_OPTION */
  constructor(options: PointCloudLayerOptions = {}) {
    const { drawing, layer } = drawingOptions(options);
    super(layer);
    this.#drawing = new LayerDrawing(drawing, () => this.changed());
  }

  /** How points are drawn; undefined until the data set is open. Assigning some of the properties leaves the others. */
  get style(): PointCloudStyle | undefined {
    return this.#drawing.style;
  }

  set style(parts: StyleParts) {
    this.#assign(() => {
      this.#drawing.style = parts;
    });
  }

  /** Which points are drawn and picked; undefined: all. @throws StyleError STYLE_FILTER */
  get filter(): PointFilter | undefined {
    return this.#drawing.filter;
  }

  set filter(filter: PointFilter | undefined) {
    this.#assign(() => {
      this.#drawing.filter = filter;
    });
  }

  /** Effects that are on or off whatever the scene calls for. @throws StyleError STYLE_FORCED */
  get forced(): Forced {
    return this.#drawing.forced;
  }

  set forced(forced: Forced) {
    this.#assign(() => {
      this.#drawing.forced = forced;
    });
  }

  /** Volumes that cut or highlight; assigning undefined gives the layer an empty set. @throws StyleError STYLE_OPTION */
  get clips(): ClipSet {
    return this.#drawing.clips;
  }

  set clips(clips: ClipSet | undefined) {
    this.#assign(() => {
      this.#drawing.clips = clips;
    });
  }

  /** Pixels between neighbouring points above which the next level is drawn. @throws StyleError STYLE_OPTION */
  get maximumScreenSpaceError(): number {
    return this.#drawing.maximumScreenSpaceError;
  }

  set maximumScreenSpaceError(pixels: number) {
    this.#assign(() => {
      this.#drawing.maximumScreenSpaceError = pixels;
    });
  }

  /** Most points drawn at once, from 0 to Infinity. @throws StyleError STYLE_OPTION */
  get pointBudget(): number {
    return this.#drawing.pointBudget;
  }

  set pointBudget(points: number) {
    this.#assign(() => {
      this.#drawing.pointBudget = points;
    });
  }

  /** Points and bytes that this layer shares with others. @throws StyleError STYLE_OPTION */
  get budget(): SharedBudget | undefined {
    return this.#drawing.budget;
  }

  set budget(budget: SharedBudget | undefined) {
    this.#assign(() => {
      const before = this.#drawing.budget;
      this.#drawing.budget = budget;
      if (before !== budget) before?.gpu.report(this, 0);
    });
  }

  /** Every effect that the last frame could have had. */
  get ledger(): readonly LedgerRow[] {
    const placed = this.#renderer?.placed;
    return placed?.frames.ledger(placed.renderer.content.material?.plan.active) ?? [];
  }

  get statistics(): LayerStatistics {
    const placed = this.#renderer?.placed;
    return {
      ...drawnStatistics(placed?.frames, placed?.renderer),
      framesDrawn: placed?.renderer.framesDrawn ?? 0,
    };
  }

  /**
   * The point that the map shows nearest to a place, as it is recorded in the file.
   * @param pixel CSS pixels from the upper left of the map
   * @returns undefined where there is no point
   * @throws StyleError STYLE_OPTION
   * @throws SourceError, DecodeError where the record cannot be read again; the signal's reason when aborted; an AbortError when
   *   the layer or its source is disposed of
   */
  async pick(pixel: readonly number[], given: PickOptions = {}): Promise<PickResult | undefined> {
    this.#mustLast();
    const { window = 9, signal } = checkPick(
      pixel,
      given,
      this.getSource()?.cloud?.name ?? "PointCloudLayer",
    );
    const found = await this.#renderer?.pick([...pixel], window, signal);
    this.#mustLast();
    return found;
  }

  /** Lets what failed be asked for again: nodes, and points that could not be placed for the map. */
  retryFailed(): void {
    this.#renderer?.retryFailed();
  }

  protected override createRenderer(): OlLayerRenderer<Layer> {
    return new MapRenderer(this, this.#drawing, (error) =>
      callListener(() => this.dispatchEvent(new PointCloudErrorEvent(error))),
    );
  }

  override disposeInternal(): void {
    this.#drawing.destroy();
    super.disposeInternal();
  }

  override unrender(): void {
    super.unrender();
    this.#renderer?.rest();
  }

  #mustLast(): void {
    if (this.disposed) throw new DOMException("The layer was disposed of.", "AbortError");
  }

  get #renderer(): MapRenderer | undefined {
    return this.hasRenderer() ? (this.getRenderer() as MapRenderer) : undefined;
  }

  #assign(change: () => void): void {
    change();
    this.changed();
  }
}
