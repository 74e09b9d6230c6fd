import type { Options as LayerOptions } from "ol/layer/Layer.js";
import { CLIPS_OPTION, type ClipSet } from "../clips/index.js";
import { CLOUD_OPTIONS } from "../cloud/index.js";
import type { Forced, PointFilter, StyleParts } from "../effects/index.js";
import type { SharedBudget } from "../octree/index.js";
import { type Kinds, number, optionPlace, some } from "../options/index.js";
import type { PointCloudSource } from "./point-cloud-source.js";

/** How a layer draws; all but the options of OpenLayers' own layers can be changed by assigning to the layer. */
export interface DrawingOptions {
  /** How points look, as on the globe. Default: colours of the scan, 2 px. */
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

/** Options of a layer: those of any layer of OpenLayers, and how points are drawn. */
export interface PointCloudLayerOptions
  extends DrawingOptions,
    Omit<LayerOptions<PointCloudSource>, "render" | "source"> {
  readonly source?: PointCloudSource | undefined;
}

/** What numbers and objects of a layer may be; style, filter and effects are held against the data set. */
const KINDS: Kinds<Pick<DrawingOptions, "clips" | "maximumScreenSpaceError" | "pointBudget" | "budget">> = {
  clips: CLIPS_OPTION,
  maximumScreenSpaceError: number(0),
  pointBudget: number(0),
  budget: CLOUD_OPTIONS.budget,
};

/** Takes what of the options says how points are drawn. @throws StyleError STYLE_OPTION */
export function drawingOptions(given: PointCloudLayerOptions): {
  readonly drawing: DrawingOptions;
  readonly layer: Omit<LayerOptions<PointCloudSource>, "render">;
} {
  const { style, filter, forced, clips, maximumScreenSpaceError, pointBudget, budget, ...layer } = given;
  const checked = some(KINDS).read(
    { clips, maximumScreenSpaceError, pointBudget, budget },
    optionPlace("options", "PointCloudLayer"),
  );
  return { drawing: { style, filter, forced, ...checked }, layer };
}

/** One of these options, as it is assigned to a layer. @throws StyleError STYLE_OPTION */
export function checkDrawingOption<Name extends keyof typeof KINDS>(
  name: Name,
  given: NonNullable<DrawingOptions[Name]>,
): NonNullable<DrawingOptions[Name]> {
  return KINDS[name].read(given, optionPlace(name, "PointCloudLayer")) as NonNullable<DrawingOptions[Name]>;
}
