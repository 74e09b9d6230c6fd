import { CrsError } from "@groma/georef";
import {
  PointCloudLayer,
  type PointCloudLayerOptions,
  type PointCloudOptions,
  type ServerWait,
} from "@groma/layer/cesium";

/** How a cloud is opened and drawn. */
export interface OpenOptions
  extends PointCloudLayerOptions,
    Pick<PointCloudOptions, "crs" | "vertical" | "transformation"> {
  /** Coordinate system for a cloud that names none. Never used in place of one that the file names. */
  readonly crsIfMissing?: string | undefined;
}

/** What is told of an opening, and how it is given up. */
export interface OpeningEvents {
  /** Told while its server is waited for; undefined: it answers. */
  readonly onWait: (wait: ServerWait | undefined) => void;
  readonly signal: AbortSignal;
}

/** Opens a cloud as a layer. @throws GromaError where it cannot be opened; the signal's reason */
export async function openLayer(
  from: string | File,
  { crsIfMissing, ...options }: OpenOptions,
  events: OpeningEvents,
): Promise<PointCloudLayer> {
  try {
    return await PointCloudLayer.fromUrl(from, { ...options, ...events });
  } catch (thrown) {
    const missing = thrown instanceof CrsError && thrown.code === "CRS_MISSING";
    if (!missing || !crsIfMissing) throw thrown;
    return await PointCloudLayer.fromUrl(from, { ...options, crs: crsIfMissing, ...events });
  }
}
