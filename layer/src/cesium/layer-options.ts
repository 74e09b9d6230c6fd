import { type Cartesian3, RequestErrorEvent, Resource, TrustedServers } from "cesium";
import type { ClipSet } from "../clips/index.js";
import type { PointCloud, PointRecord } from "../cloud/index.js";
import type { GpuMilliseconds } from "../drawing/frame.js";
import type { GpuCounts } from "../drawing/gpu.js";
import type { Forced, PointFilter, StyleParts } from "../effects/index.js";
import type { SharedBudget } from "../octree/index.js";
import type { HttpOptions, SourceLike } from "../sources/index.js";

/** How a layer draws; all can be changed later. */
export interface PointCloudLayerOptions {
  /** Default: true. */
  readonly show?: boolean | undefined;
  readonly style?: StyleParts | undefined;
  /** Pixels between neighbouring points above which the next level is drawn. Default: 2. */
  readonly maximumScreenSpaceError?: number | undefined;
  /** Most points drawn at once. Default: 1,000,000; where a {@link budget} is given: as many as that allows. */
  readonly pointBudget?: number | undefined;
  /** Points and bytes that several layers share. Default: none is shared. */
  readonly budget?: SharedBudget | undefined;
  /** Metres above their places at which points are drawn, for looks only. Default: 0. */
  readonly heightOffset?: number | undefined;
  /** Volumes that cut or highlight; several layers may share one set. Default: an empty one. */
  readonly clips?: ClipSet | undefined;
  /** Which points are drawn and picked. Default: all. */
  readonly filter?: PointFilter | undefined;
  /** Effects that are on or off whatever the scene calls for. Default: none. */
  readonly forced?: Forced | undefined;
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
  /** Bytes of buffers and textures on the GPU. */
  readonly gpuBytes: number;
  /** GPU objects alive, by kind; all 0 after `destroy()`. */
  readonly gpuObjects: GpuCounts;
  /** GPU milliseconds of the points and of the pass over the picture; undefined where the browser does not say. */
  readonly gpuMilliseconds: GpuMilliseconds;
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
