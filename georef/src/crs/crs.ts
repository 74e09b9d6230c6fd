/**
 * What a height is measured from. `ellipsoidal` heights are above the ellipsoid of WGS 84, or, where `ellipsoid` is `own`, above
 * that of the CRS's own datum, which lies elsewhere: a CRS of three dimensions. `geoid` heights are gravity-related ("above sea level"): `model` is the name
 * of the vertical CRS or of the geoid grid that was named, `epsg` the code of the vertical CRS if known. `doubt` says what
 * a text declares of its heights and what is not applied, or not read alike by others.
 */
export type HeightReference =
  | { readonly kind: "ellipsoidal"; readonly ellipsoid?: "own"; readonly doubt?: string }
  | { readonly kind: "geoid"; readonly model: string; readonly epsg?: number; readonly doubt?: string }
  | { readonly kind: "unknown" };

/** A unit of measure; `size` is in metres (linear) or radians (angular) per unit. */
export interface Unit {
  readonly name: string;
  readonly kind: "linear" | "angular";
  readonly size: number;
}

/** The way from the CRS's own datum to WGS 84, as it is written into `Crs.proj4`. */
export interface DatumOperation {
  /** Name of the operation with its EPSG code where it has one, in words where nothing is known. */
  readonly operation: string;
  /**
   * Metres: as its publisher states it; where one operation stands for a whole datum, no less than its distance from
   * those for parts of the datum's area. `null` when nobody has stated an accuracy.
   */
  readonly accuracy: number | null;
  /** EPSG code of the datum whose one operation this is; absent for a shift that the CRS itself names. */
  readonly datum?: number;
}

/**
 * A coordinate reference system of a scan, resolved: horizontal and vertical part apart, in a form that has one
 * meaning. Source coordinates are (x, y, z) as in LAS: x easting or longitude, y northing or latitude, whatever
 * axis order the authority of the CRS prescribes. For geocentric CRSs they are X, Y, Z.
 */
export interface Crs {
  readonly name: string;
  /** `EPSG:2056`, or `EPSG:2056+5728` where the heights have a code too; absent when the plane has none. */
  readonly code?: string;
  /**
   * Horizontal part as a PROJ string that proj4js and PROJ read alike: ellipsoid by numbers, datum shift
   * explicit (`+towgs84`, position vector rotations in arc-seconds), no grids, no axis order, no vertical part.
   */
  readonly proj4: string;
  /** The text that was read, when it was WKT. */
  readonly wkt?: string;
  readonly horizontalUnit: Unit;
  /**
   * Unit of z, its size negative where z counts downwards (depths); when the source declares none it is the horizontal
   * linear unit (metre for angles).
   */
  readonly verticalUnit: Unit & { readonly declared: boolean };
  readonly height: HeightReference;
  /** Absent only in records of other writers. */
  readonly datum?: DatumOperation;
}

/** Contents of the three GeoTIFF VLRs of a LAS file (`LASF_Projection`, record ids 34735, 34736, 34737). */
export interface GeoTiffKeys {
  readonly directory: Uint16Array;
  readonly doubles: Float64Array;
  readonly ascii: string;
}

/** Everything that may say what CRS a file has, the user's word first. */
export interface CrsSources {
  /** Name of the file, for error messages. */
  readonly file: string;
  /** Given by the user: `EPSG:2056`, `EPSG:2056+5728`, a PROJ string, WKT or PROJJSON. */
  readonly given?: string | undefined;
  /** Height reference given by the user: `EPSG:5728` or `ellipsoidal`. */
  readonly givenVertical?: string | undefined;
  /** The WKT VLR of the file. */
  readonly wkt?: string | undefined;
  readonly geoTiff?: GeoTiffKeys | undefined;
  /** What the header of a LAS file says of which of the two is in force; without it the WKT is. */
  readonly las?: LasDeclaration | undefined;
  /** Heights of an earlier conversion, which a given CRS without any keeps. */
  readonly recordedHeights?: Pick<Crs, "height" | "verticalUnit"> | undefined;
}

/** Point data record format, and bit 4 of the global encoding ("WKT"; LAS 1.4 R15, 2.4). */
export interface LasDeclaration {
  readonly pointFormat: number;
  readonly wktBit: boolean;
}

/** What a user has to know of how a CRS was found. */
export interface CrsNote {
  /** CRS_CONTRADICTION, CRS_OTHER_FORM, CRS_HEIGHTS_FROM_OTHER_FORM, CRS_HEIGHTS_KEPT,
   * CRS_HEIGHT_UNIT. */
  readonly code: string;
  readonly text: string;
}

/** A CRS, where it comes from, and what has to be known of that. */
export interface ResolvedCrs {
  readonly crs: Crs;
  readonly basis: "given" | "WKT" | "GeoTIFF keys";
  readonly notes: readonly CrsNote[];
}

/** One row of an EPSG table: PROJ string or WKT, and the kind (`CRS-PROJCRS`, `CRS-VERTCRS` …). */
export interface EpsgEntry {
  readonly name: string;
  readonly proj4?: string | undefined;
  readonly wkt?: string | undefined;
  readonly kind: string;
  /** North, west, south, east in degrees: the rectangle around its area of use. */
  readonly bbox?: readonly number[] | undefined;
  /** Its area of use in words. */
  readonly area?: string | undefined;
}

/** Looks an EPSG code up in a table that the caller brings (this package carries none). */
export type EpsgLookup = (code: number) => EpsgEntry | undefined;
