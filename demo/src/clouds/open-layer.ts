import { CrsError, GromaError } from "@groma/georef";
import {
  PointCloudLayer,
  type PointCloudLayerOptions,
  type PointCloudOptions,
  type ServerWait,
} from "@groma/layer/cesium";
import { type Indexed, type IndexProgress, indexFile } from "../indexing/index-file.js";

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
  /** Told while a file without an octree is given one. */
  readonly onIndexing: (progress: IndexProgress) => void;
  /** Told when it has one. */
  readonly onIndexed: (indexed: Indexed) => void;
  readonly signal: AbortSignal;
}

/**
 * Opens a cloud as a layer. A file of the reader's disk that has no octree gets one first.
 * @throws GromaError where it cannot be opened; the signal's reason
 */
export function openLayer(
  from: string | File,
  options: OpenOptions,
  events: OpeningEvents,
): Promise<PointCloudLayer> {
  return openOrIndex(from, (one) => openIndexed(one, options, events), events);
}

/**
 * Opens a cloud, and indexes it before where it is a file of the reader's disk that has no octree.
 * @throws what `open` does; IndexError; the signal's reason
 */
export async function openOrIndex<Opened>(
  from: string | File,
  open: (from: string | File) => Promise<Opened>,
  { onIndexing: onProgress, onIndexed, signal }: Omit<OpeningEvents, "onWait">,
): Promise<Opened> {
  try {
    return await open(from);
  } catch (thrown) {
    const lacksOctree = thrown instanceof GromaError && thrown.code === "FORMAT_NOT_COPC";
    if (!lacksOctree || typeof from === "string") throw thrown;
    const indexed = await indexFile(from, { onProgress, signal });
    onIndexed(indexed);
    return await open(indexed.copc);
  }
}

function openIndexed(
  from: string | File,
  { crsIfMissing, ...options }: OpenOptions,
  { onWait, signal }: OpeningEvents,
): Promise<PointCloudLayer> {
  const events = { onWait, signal };
  return openPlaced(
    (crs) => PointCloudLayer.fromUrl(from, { ...options, ...(crs && { crs }), ...events }),
    crsIfMissing,
  );
}

/**
 * Opens a cloud, with the coordinate system that the reader gave where it names none itself.
 * @param open is given that system, or undefined
 * @throws what `open` does
 */
export async function openPlaced<Opened>(
  open: (crs: string | undefined) => Promise<Opened>,
  crsIfMissing: string | undefined,
): Promise<Opened> {
  try {
    return await open(undefined);
  } catch (thrown) {
    const missing = thrown instanceof CrsError && thrown.code === "CRS_MISSING";
    if (!missing || !crsIfMissing) throw thrown;
    return await open(crsIfMissing);
  }
}
