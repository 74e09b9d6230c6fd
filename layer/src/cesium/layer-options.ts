import { type Cartesian3, RequestErrorEvent, Resource, TrustedServers } from "cesium";
import { CLOUD_OPTIONS, type PointCloud, type PointCloudOptions, type PointRecord } from "../cloud/index.js";
import {
  DRAWING_KINDS,
  type DrawingOptions,
  PICK_OPTIONS,
  type PickOptions,
} from "../drawing/drawing-options.js";
import { flag, type Kind, type Kinds, kindOf, optionPlace, some } from "../options/index.js";
import type { HttpOptions, SourceLike } from "../sources/index.js";

/** Options of a layer; all but `id` can be changed later. */
export interface PointCloudLayerOptions extends DrawingOptions {
  /** Default: true. */
  readonly show?: boolean | undefined;
  /** Metres above their places at which points are drawn, for looks only. Default: 0. */
  readonly heightOffset?: number | undefined;
  /** What `scene.pick` returns as `id`. Default: the cloud's name. */
  readonly id?: unknown;
}

/** Held against the data set, once that is open, by whoever it is handed to. */
const checkedLater: Kind<never> = kindOf("anything", (_given): _given is never => true);

/** What each option of a layer may be. */
const LAYER_OPTIONS: Kinds<PointCloudLayerOptions> = {
  ...DRAWING_KINDS,
  show: flag,
  style: checkedLater,
  heightOffset: checkedLater,
  filter: checkedLater,
  forced: checkedLater,
  id: checkedLater,
};

/** Options of a layer and of the data set that it opens. */
type OpeningOptions = PointCloudLayerOptions & PointCloudOptions;

/** The options, and of them those that say how the data set is opened. @throws StyleError STYLE_OPTION */
export function checkOpeningOptions(given: OpeningOptions): {
  readonly options: OpeningOptions;
  readonly opening: PointCloudOptions;
} {
  const kinds: Kinds<OpeningOptions> = { ...CLOUD_OPTIONS, ...LAYER_OPTIONS };
  const options = some(kinds).read(given, optionPlace("options", "PointCloudLayer.fromUrl"));
  const opening = Object.entries(options).filter(([name]) => Object.hasOwn(CLOUD_OPTIONS, name));
  return { options, opening: Object.fromEntries(opening) };
}

/** Options of a layer of a data set that is open. @throws StyleError STYLE_OPTION */
export function checkLayerOptions(given: PointCloudLayerOptions, file: string): PointCloudLayerOptions {
  return some(LAYER_OPTIONS).read(given, optionPlace("options", file));
}

/** One of these options, as it is assigned to a layer. @throws StyleError STYLE_OPTION */
export function checkLayerOption<Name extends keyof PointCloudLayerOptions>(
  name: Name,
  given: NonNullable<PointCloudLayerOptions[Name]>,
  file: string,
): NonNullable<PointCloudLayerOptions[Name]> {
  // A kind reads undefined as little as any other value that is none of it.
  return LAYER_OPTIONS[name].read(given, optionPlace(name, file)) as NonNullable<
    PointCloudLayerOptions[Name]
  >;
}

/** A place of the canvas: CSS pixels from the upper left, as a `Cartesian2` has them. */
export interface WindowPosition {
  readonly x: number;
  readonly y: number;
}

const windowPosition = kindOf(
  "finite numbers x and y, CSS pixels",
  (given): given is WindowPosition =>
    typeof given === "object" &&
    given !== null &&
    [(given as WindowPosition).x, (given as WindowPosition).y].every(Number.isFinite),
);

/** Place and options of a pick. @throws StyleError STYLE_OPTION */
export function checkPick(position: WindowPosition, options: PickOptions, file: string): PickOptions {
  windowPosition.read(position, optionPlace("windowPosition", file));
  return PICK_OPTIONS.read(options, optionPlace("options", file));
}

/** A point that was picked, as it is recorded. */
export interface PickResult<Layer> extends PointRecord {
  readonly layer: Layer;
  readonly cloud: PointCloud;
  /** Place of the record, ECEF (EPSG:4978), metres; without the layer's height offset. */
  readonly position: Cartesian3;
}

/** What a layer can be made from: as a cloud, and Cesium's `Resource` besides. */
export type LayerSource = SourceLike | Resource;

/** A source and the options under which it is asked. */
export interface ResolvedSource {
  readonly from: SourceLike;
  readonly http: Pick<HttpOptions, "headers" | "credentials">;
}

/**
 * Takes a `Resource` apart: address with query and proxy, headers, and credentials where the server is one of
 * Cesium's `TrustedServers`. Where it has a `retryCallback`, that is called when the server refuses access (401, 403),
 * and address and headers are read again. Anything else is left as it is.
 */
export function resolveSource(source: LayerSource): ResolvedSource {
  if (!(source instanceof Resource)) return { from: source, http: {} };
  const url = source.getUrlComponent(true, true);
  const address = new URL(url, globalThis.location?.href).href;
  const credentials = TrustedServers.contains(address) && { credentials: "include" as const };
  const { retryCallback } = source;
  if (!retryCallback) return { from: url, http: { headers: headersOf(source), ...credentials } };
  return {
    from: async ({ reason, status }) => {
      if (reason === "denied") await retryCallback(source, new RequestErrorEvent(status));
      return source.getUrlComponent(true, true);
    },
    // Asked for after the address, so that they are what the callback has left.
    http: { headers: () => headersOf(source), ...credentials },
  };
}

function headersOf({ headers }: Resource): Record<string, string> {
  const entries = Object.entries(headers ?? {}).map(([name, value]) => [name, String(value)]);
  return Object.fromEntries(entries);
}
