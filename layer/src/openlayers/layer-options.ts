import type { Options as LayerOptions } from "ol/layer/Layer.js";
import {
  DRAWING_KINDS,
  type DrawingOptions,
  PICK_OPTIONS,
  type PickOptions,
} from "../drawing/drawing-options.js";
import { kindOf, optionPlace, some } from "../options/index.js";
import type { PointCloudSource } from "./point-cloud-source.js";

/** Options of a layer: those of any layer of OpenLayers, and how points are drawn. */
export interface PointCloudLayerOptions
  extends DrawingOptions,
    Omit<LayerOptions<PointCloudSource>, "render" | "source"> {
  /** The points; without one the layer draws nothing. */
  readonly source?: PointCloudSource | undefined;
}

/** Takes what of the options says how points are drawn. @throws StyleError STYLE_OPTION */
export function drawingOptions(given: PointCloudLayerOptions): {
  readonly drawing: DrawingOptions;
  readonly layer: Omit<LayerOptions<PointCloudSource>, "render">;
} {
  const { style, filter, forced, clips, maximumScreenSpaceError, pointBudget, budget, ...layer } = given;
  const checked = some(DRAWING_KINDS).read(
    { clips, maximumScreenSpaceError, pointBudget, budget },
    optionPlace("options", "PointCloudLayer"),
  );
  return { drawing: { style, filter, forced, ...checked }, layer };
}

/** One of these options, as it is assigned to a layer. @throws StyleError STYLE_OPTION */
export function checkDrawingOption<Name extends keyof typeof DRAWING_KINDS>(
  name: Name,
  given: NonNullable<DrawingOptions[Name]>,
): NonNullable<DrawingOptions[Name]> {
  return DRAWING_KINDS[name].read(given, optionPlace(name, "PointCloudLayer")) as NonNullable<
    DrawingOptions[Name]
  >;
}

const pixelKind = kindOf(
  "[x, y], finite CSS pixels",
  (given): given is readonly number[] =>
    Array.isArray(given) && given.length >= 2 && [given[0], given[1]].every(Number.isFinite),
);

/** Place and options of a pick. @throws StyleError STYLE_OPTION */
export function checkPick(pixel: readonly number[], options: PickOptions, file: string): PickOptions {
  pixelKind.read(pixel, optionPlace("pixel", file));
  return PICK_OPTIONS.read(options, optionPlace("options", file));
}
