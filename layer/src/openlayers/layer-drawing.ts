import { ClipSet } from "../clips/index.js";
import type { PointCloud } from "../cloud/index.js";
import type { DrawingOptions } from "../drawing/drawing-options.js";
import type { LayerSettings } from "../drawing/frame.js";
import {
  checkFilter,
  checkForced,
  completeStyle,
  defaultStyle,
  type Forced,
  type PointCloudStyle,
  type PointFilter,
  type StyleParts,
} from "../effects/index.js";
import type { SharedBudget } from "../octree/index.js";
import { checkDrawingOption } from "./layer-options.js";

/**
 * How a layer draws. Style, filter and effects are held against a data set as soon as one is known; what was given before
 * waits for it.
 */
export class LayerDrawing {
  /** Grows with each change. */
  revision = 0;
  #cloud: PointCloud | undefined;
  #parts: StyleParts[] = [];
  #style: PointCloudStyle | undefined;
  #filter: PointFilter | undefined;
  #forced: Forced = {};
  readonly #changed: () => void;
  #clips = new ClipSet();
  /** Stops listening to the volumes. */
  #unwatch: () => void = () => undefined;
  #maximumScreenSpaceError = 2;
  #pointBudget: number;
  #budget: SharedBudget | undefined;
  /** Stops listening to the budget. */
  #leaveBudget: () => void = () => undefined;

  /** @param changed called when a volume comes, goes or is another, and when another view has changed the budget's parts */
  constructor(options: DrawingOptions, changed: () => void) {
    this.#changed = changed;
    const { style, filter, forced, clips, maximumScreenSpaceError = 2, pointBudget, budget } = options;
    if (style) this.#parts.push(style);
    this.#filter = filter;
    this.#forced = forced ?? {};
    this.clips = clips;
    this.#maximumScreenSpaceError = maximumScreenSpaceError;
    this.budget = budget;
    this.#pointBudget = pointBudget ?? (budget ? Number.POSITIVE_INFINITY : 1_000_000);
  }

  /**
   * Draws this data set from now on.
   * @throws StyleError for what was given before and cannot be drawn with it; it is left out then
   */
  follow(cloud: PointCloud): void {
    if (cloud === this.#cloud) return;
    this.#cloud = cloud;
    this.#style = defaultStyle(cloud);
    this.revision++;
    const [parts, filter, forced] = [this.#parts, this.#filter, this.#forced];
    this.#parts = [];
    this.#filter = undefined;
    this.#forced = {};
    for (const part of parts) this.style = part;
    this.filter = filter;
    this.forced = forced;
  }

  /** What a frame is drawn by; undefined before a data set is known. */
  get settings(): LayerSettings | undefined {
    const style = this.#style;
    if (!style) return undefined;
    return {
      ...{ style, filter: this.#filter, forced: this.#forced, clips: this.#clips, budget: this.#budget },
      ...{ maximumScreenSpaceError: this.#maximumScreenSpaceError, pointBudget: this.#pointBudget },
    };
  }

  get style(): PointCloudStyle | undefined {
    return this.#style;
  }

  set style(parts: StyleParts) {
    if (this.#cloud && this.#style) this.#style = completeStyle(parts, this.#style, this.#cloud);
    // Another data set is to be drawn alike.
    this.#parts.push(parts);
    this.revision++;
  }

  get filter(): PointFilter | undefined {
    return this.#filter;
  }

  set filter(filter: PointFilter | undefined) {
    this.#filter = filter && this.#cloud ? checkFilter(filter, this.#cloud) : filter;
    this.revision++;
  }

  get forced(): Forced {
    return this.#forced;
  }

  set forced(forced: Forced) {
    this.#forced = checkForced(forced, this.#cloud?.name ?? "PointCloudLayer");
    this.revision++;
  }

  get clips(): ClipSet {
    return this.#clips;
  }

  set clips(clips: ClipSet | undefined) {
    this.#clips = clips === undefined ? new ClipSet() : checkDrawingOption("clips", clips);
    this.#unwatch();
    this.#unwatch = this.#clips.onChange(this.#changed);
    this.revision++;
  }

  get maximumScreenSpaceError(): number {
    return this.#maximumScreenSpaceError;
  }

  set maximumScreenSpaceError(pixels: number) {
    this.#maximumScreenSpaceError = checkDrawingOption("maximumScreenSpaceError", pixels);
    this.revision++;
  }

  get pointBudget(): number {
    return this.#pointBudget;
  }

  set pointBudget(points: number) {
    this.#pointBudget = checkDrawingOption("pointBudget", points);
    this.revision++;
  }

  get budget(): SharedBudget | undefined {
    return this.#budget;
  }

  set budget(budget: SharedBudget | undefined) {
    this.#budget = budget === undefined ? undefined : checkDrawingOption("budget", budget);
    this.#leaveBudget();
    const changed = () => {
      this.revision++;
      this.#changed();
    };
    this.#leaveBudget = this.#budget?.onChange(changed) ?? (() => undefined);
    this.revision++;
  }

  /** Listens to volumes and budget no more. */
  destroy(): void {
    this.#unwatch();
    this.#leaveBudget();
  }
}
