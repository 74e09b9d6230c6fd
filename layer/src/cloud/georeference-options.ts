import type {
  Crs,
  EpsgLookup,
  GeoreferenceRecord,
  OperationReport,
  PackedEpsg,
  StatedAccuracy,
  Truth,
  TruthSources,
} from "@groma/georef";
import type { SourceLike } from "../sources/open-source.js";
import type { HeightData } from "./height-data.js";

/** What an application says about a data set's coordinates; it goes before what the file says. */
export interface GeoreferenceOptions {
  /** Coordinate system: `EPSG:2056`, `EPSG:2056+5728`, a PROJ string, WKT or PROJJSON. */
  readonly crs?: string | undefined;
  /**
   * Height reference: `EPSG:5728` or `ellipsoidal`. Where the conversion settled the same one it stands as it is. Else
   * heights above a geoid are placed by EGM96 in place of a country's own model, and the accuracy says what that is
   * worth; in plane the conversion's way stays.
   */
  readonly vertical?: string | undefined;
  /** Table of EPSG codes that goes before the one beside this library. Default: none. */
  readonly epsg?: EpsgLookup | undefined;
  /** Where the table of EPSG codes comes from. Default: the file beside this library, fetched when needed. */
  readonly epsgTable?: (() => Promise<PackedEpsg>) | undefined;
  /** Where height systems and the geoid come from. Default: the files beside this library, fetched when needed. */
  readonly heightData?: HeightData | undefined;
  /**
   * A georeference made by `groma georef` for this data set: an address, a file, or its bytes. It goes before what the
   * file says; `crs` and `vertical` go before it as before the file's own. Default: none.
   */
  readonly transformation?: SourceLike | Uint8Array | undefined;
  /** Greatest distance of a drawn point from its exact place, metres. Default: 0.001. */
  readonly tolerance?: number | undefined;
}

/** Where a data set's coordinates lie on the earth, and how sure that is. */
export interface Georeference {
  readonly crs: Crs;
  /** Who named the coordinate system: the application, Groma's own record, or the file's WKT or GeoTIFF keys. */
  readonly basis: "given" | "record" | "file";
  /** What the places come from: PROJ at the conversion, a similarity, or proj4js. */
  readonly engine: GeoreferenceRecord["engine"];
  /** Undefined where the places do not come from a conversion that reported it. */
  readonly operation: OperationReport | undefined;
  /** What the map is made of, for whoever makes it again in a worker. */
  readonly sources: TruthSources;
  /** Source coordinates → ECEF. */
  readonly truth: Truth;
  /** Files of the geoids that heights go through; empty where they are drawn as they are. */
  readonly geoids: readonly string[];
  readonly tolerance: number;
  /**
   * What a drawn position is worth. Of a recorded way it is reckoned when asked for, which takes as long as placing a node.
   * @throws PlacementError PLACE_TOLERANCE
   */
  readonly accuracy: StatedAccuracy;
}
