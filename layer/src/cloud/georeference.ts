import { decodeRecord, recordedTruth } from "@groma/georef";
import type { PointSource } from "../sources/contract/point-source.js";
import type { OpenOptions } from "../sources/open-source.js";
import type { Georeference, GeoreferenceOptions } from "./georeference-options.js";
import { packagedModule } from "./packaged-file.js";
import { recorded, similarityOf } from "./recorded-georeference.js";

/**
 * Settles the coordinate system of a data set. Only where its record does not say where it is, or the application says
 * otherwise, is the code fetched that knows coordinate systems and projections.
 * @throws CrsError CRS_MISSING, CRS_UNKNOWN, CRS_UNSUPPORTED
 * @throws RecordError where the file's georeference record or its transformation is damaged
 * @throws SourceError SOURCE_HEIGHTS, SOURCE_EPSG where a height reference or a code needs data which cannot be had;
 *   SOURCE_MODULE where that code cannot be had
 */
export async function georeferenceOf(
  given: PointSource,
  options: GeoreferenceOptions & OpenOptions,
): Promise<Georeference> {
  const { transformation: own, crs: named, vertical } = options;
  const source =
    own === undefined
      ? given
      : await packagedModule(() => import("./given-record.js")).then((it) =>
          it.withGivenRecord(given, own, options),
        );
  const { georeference: bytes, transformation } = source.crs;
  const record = bytes && decodeRecord(bytes, source.name);
  if (record && named === undefined && vertical === undefined) {
    const truth = recordedTruth(
      { similarity: similarityOf(record, source.name), transformation },
      source.name,
    );
    if (truth) return recorded(record, truth, source, options);
  }
  const { derivedGeoreference } = await packagedModule(() => import("./derived-georeference.js"));
  return derivedGeoreference(record, source, options);
}
