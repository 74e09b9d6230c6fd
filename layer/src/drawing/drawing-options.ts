import { CLIPS_OPTION, type ClipSet } from "../clips/index.js";
import { CLOUD_OPTIONS } from "../cloud/index.js";
import type { Forced, PointFilter, StyleParts } from "../effects/index.js";
import type { SharedBudget } from "../octree/index.js";
import { type Kinds, number, signal, some } from "../options/index.js";

/** How a layer draws, in any view; all can be changed later. */
export interface DrawingOptions {
  /** How points look. Default: colours of the scan, 2 px. */
  readonly style?: StyleParts | undefined;
  /** Which points are drawn and picked. Default: all. */
  readonly filter?: PointFilter | undefined;
  /** Volumes that cut or highlight; layers of maps and globes may share one set. Default: an empty one. */
  readonly clips?: ClipSet | undefined;
  /** Effects that are on or off whatever the scene calls for. Default: none. */
  readonly forced?: Forced | undefined;
  /** Pixels between neighbouring points above which the next level is drawn. Default: 2. */
  readonly maximumScreenSpaceError?: number | undefined;
  /** Most points drawn at once. Default: 1,000,000; where a {@link budget} is given: as many as that allows. */
  readonly pointBudget?: number | undefined;
  /** Points and bytes that several layers share. Default: none is shared. */
  readonly budget?: SharedBudget | undefined;
}

/** Of these options those that are checked by themselves; style, filter and effects are held against the data set. */
export const DRAWING_KINDS: Kinds<
  Pick<DrawingOptions, "clips" | "maximumScreenSpaceError" | "pointBudget" | "budget">
> = {
  clips: CLIPS_OPTION,
  maximumScreenSpaceError: number(0),
  pointBudget: number(0),
  budget: CLOUD_OPTIONS.budget,
};

/** How a place of the picture is asked for its point. */
export interface PickOptions {
  /** Edge of the square around it in which the nearest point counts, CSS pixels, at most 1000. Default: 9. */
  readonly window?: number | undefined;
  /** Stops it; what is asked for ends with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
}

/** What the options of a pick may be. */
export const PICK_OPTIONS = some<PickOptions>({ window: number(0, 1000), signal });
