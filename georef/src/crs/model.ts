import type { HeightReference, Unit } from "./crs.js";
import type { Figure } from "./ellipsoids.js";

/** A geodetic datum as a CRS text describes it. */
export interface DatumModel {
  readonly name: string;
  readonly code?: number | undefined;
  readonly figure: Figure;
  /** Shift that the text itself names, as `+towgs84` (metres, arc-seconds, ppm; position vector). */
  readonly towgs84?: readonly number[] | undefined;
  /** Name of the grid file that the text asks for in place of a shift. */
  readonly grid?: string | undefined;
}

/** Parameters of map projections, by what they mean; angles in degrees, lengths in metres. */
export type ParameterId =
  | "latitudeOrigin"
  | "longitudeOrigin"
  | "standardParallel1"
  | "standardParallel2"
  | "standardParallel"
  | "scale"
  | "falseEasting"
  | "falseNorthing"
  | "azimuth"
  | "gridAngle"
  | "pseudoParallel"
  | "xScale"
  | "yScale"
  | "planeRotation"
  | "auxiliarySphere";

/** A map projection as a CRS text describes it. */
export interface ConversionModel {
  readonly method: string;
  readonly methodCode?: number | undefined;
  readonly parameters: ReadonlyMap<ParameterId, number>;
}

/** Horizontal part of a CRS, the same for every notation. */
export interface HorizontalModel {
  readonly kind: "geographic" | "projected" | "geocentric";
  readonly name: string;
  readonly code?: number | undefined;
  readonly datum: DatumModel;
  /** EPSG code of the geographic CRS underneath. */
  readonly baseCode?: number | undefined;
  /** Longitude of the prime meridian from Greenwich, degrees. */
  readonly meridian: number;
  readonly unit: Unit;
  readonly conversion?: ConversionModel | undefined;
  /** The projection in PROJ's own words, in place of `conversion`, when the source is a PROJ string. */
  readonly projection?: string | undefined;
  /** Directions of the axes, lower case, as far as the text gives them. */
  readonly directions: readonly string[];
  /** PROJ string that the text carries for what its notation cannot say (GDAL's `EXTENSION["PROJ4"]`). */
  readonly projString?: string | undefined;
  /** Unit of ellipsoidal heights, for CRSs of three dimensions. */
  readonly heightUnit?: Unit | undefined;
}

/** Vertical part of a CRS. */
export interface VerticalModel {
  readonly name: string;
  readonly code?: number | undefined;
  /** Absent when the text names none; of depths its size is negative. */
  readonly unit?: Unit | undefined;
  readonly reference: HeightReference["kind"];
  /** Ellipsoidal heights above the ellipsoid of the CRS's own datum, and not that of WGS 84. */
  readonly ellipsoid?: "own" | undefined;
  /** Name of the geodetic datum that ESRI's texts give for ellipsoidal heights. */
  readonly datum?: string | undefined;
  /** What the text declares of its heights and what is not applied, or not read alike by others. */
  readonly doubt?: string | undefined;
}

/** What a CRS text says. */
export interface CrsModel {
  readonly name: string;
  /** EPSG code of the whole, for compound CRSs. */
  readonly code?: number | undefined;
  readonly horizontal: HorizontalModel;
  readonly vertical?: VerticalModel | undefined;
}
