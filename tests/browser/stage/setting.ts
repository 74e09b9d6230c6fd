import type { Clip, PointCloudLayerOptions } from "@groma/layer/cesium";

/** How a stage is set. */
export interface StageOptions {
  /** CSS pixels. Default: 256 × 192. */
  readonly width?: number;
  readonly height?: number;
  /** Drawing-buffer pixels per CSS pixel. Default: 1. */
  readonly pixelRatio?: number;
  /** Default: true. */
  readonly logDepth?: boolean;
  /** Default: 1. */
  readonly msaa?: number;
  /** Default: false. */
  readonly hdr?: boolean;
  /** Whether there is a globe; a plain one. Default: false. */
  readonly globe?: boolean;
  /** Default: true. */
  readonly scene3DOnly?: boolean;
  /** Default: false. */
  readonly requestRenderMode?: boolean;
}

/** Options of a layer as they cross from a test to the page. */
export interface LayerOptions extends Omit<PointCloudLayerOptions, "clips" | "budget"> {
  /** Of the cloud, metres. */
  readonly tolerance?: number;
  readonly clips?: readonly Clip[];
}

/** From where a place is looked at: degrees and metres. */
export interface Pose {
  /** Source coordinates; default: the middle of the scans of `clouds.py`. */
  readonly at?: readonly [number, number, number];
  readonly heading?: number;
  readonly pitch?: number;
  readonly range: number;
}

/** Where the scans of `clouds.py` lie. */
export const MIDDLE: readonly [number, number, number] = [500_000, 5_200_000, 500];
