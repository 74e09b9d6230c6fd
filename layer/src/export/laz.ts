import type { ByteSink } from "./byte-sink.js";
import { LazWorker, type PointCompressor } from "./compressor/laz-worker.js";
import { type LasOptions, writeLas } from "./las.js";
import { LazBody } from "./laz-body.js";
import type { PointSelection } from "./selection.js";

/** How LAZ is written. */
export interface LazOptions extends LasOptions {
  /** Makes what compresses. Default: a worker of the page, with `laz.worker.js` and `groma-laz.wasm` of this package. */
  readonly createCompressor?: (() => PointCompressor) | undefined;
}

/**
 * Writes points as LAZ, LAS 1.4 compressed by LASzip in chunks of 50,000 points: what {@link exportLas} writes, compressed by the
 * code of the converter's core, so that page and command line write the same bytes.
 *
 * @returns number of points
 * @throws FormatError EXPORT_NO_LAZ where the compressor cannot be had; all that {@link exportLas} throws
 */
export async function exportLaz(
  selections: readonly PointSelection[],
  sink: ByteSink,
  { createCompressor = () => new LazWorker(), ...options }: LazOptions = {},
): Promise<number> {
  const compressor = createCompressor();
  try {
    return await writeLas(selections, sink, options, (layout) => LazBody.begin(sink, compressor, layout));
  } finally {
    compressor.close();
  }
}
