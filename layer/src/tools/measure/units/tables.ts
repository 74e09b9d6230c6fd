/** A unit: how it is written, and how many of the SI unit it has. */
export interface UnitEntry {
  readonly symbol: string;
  readonly size: number;
}

/** The international foot, exactly (1959). */
const FOOT = 0.3048;
/** The US survey foot, exactly 1200/3937 m (Mendenhall order, 1893); 2 ppm longer than the international one. */
const US_SURVEY_FOOT = 1200 / 3937;
const MILE = 5280 * FOOT;

/** Units of length, with their size in metres. */
export const LENGTHS = {
  metres: { symbol: "m", size: 1 },
  kilometres: { symbol: "km", size: 1000 },
  centimetres: { symbol: "cm", size: 0.01 },
  millimetres: { symbol: "mm", size: 0.001 },
  feet: { symbol: "ft", size: FOOT },
  usSurveyFeet: { symbol: "ftUS", size: US_SURVEY_FOOT },
  inches: { symbol: "in", size: FOOT / 12 },
  yards: { symbol: "yd", size: 3 * FOOT },
  miles: { symbol: "mi", size: MILE },
  nauticalMiles: { symbol: "nmi", size: 1852 },
} as const satisfies Record<string, UnitEntry>;

/** Units of area, with their size in square metres. */
export const AREAS = {
  squareMetres: { symbol: "m²", size: 1 },
  hectares: { symbol: "ha", size: 10_000 },
  squareKilometres: { symbol: "km²", size: 1e6 },
  squareFeet: { symbol: "ft²", size: FOOT ** 2 },
  squareUsSurveyFeet: { symbol: "ftUS²", size: US_SURVEY_FOOT ** 2 },
  squareYards: { symbol: "yd²", size: 9 * FOOT ** 2 },
  /** International acre: 43,560 square feet. */
  acres: { symbol: "ac", size: 43_560 * FOOT ** 2 },
  usSurveyAcres: { symbol: "acUS", size: 43_560 * US_SURVEY_FOOT ** 2 },
  squareMiles: { symbol: "mi²", size: MILE ** 2 },
} as const satisfies Record<string, UnitEntry>;

/** Units of volume, with their size in cubic metres. */
export const VOLUMES = {
  cubicMetres: { symbol: "m³", size: 1 },
  litres: { symbol: "l", size: 0.001 },
  cubicFeet: { symbol: "ft³", size: FOOT ** 3 },
  cubicUsSurveyFeet: { symbol: "ftUS³", size: US_SURVEY_FOOT ** 3 },
  cubicYards: { symbol: "yd³", size: 27 * FOOT ** 3 },
  acreFeet: { symbol: "ac⋅ft", size: 43_560 * FOOT ** 3 },
} as const satisfies Record<string, UnitEntry>;

/** Units of angle, with their size in radians. */
export const ANGLES = {
  degrees: { symbol: "°", size: Math.PI / 180 },
  gon: { symbol: "gon", size: Math.PI / 200 },
  radians: { symbol: "rad", size: 1 },
} as const satisfies Record<string, UnitEntry>;

/** Names of units of length. */
export type LengthUnit = keyof typeof LENGTHS;
/** Names of units of area. */
export type AreaUnit = keyof typeof AREAS;
/** Names of units of volume. */
export type VolumeUnit = keyof typeof VOLUMES;
/** `dms`: degrees, minutes and seconds. */
export type AngleUnit = keyof typeof ANGLES | "dms";
/**
 * Angles against the level; `percent`: metres of rise per hundred metres of level way; `grade`: per metre; `ratio`: level
 * metres per metre of rise, as 1 : 20.
 */
export type SlopeUnit = AngleUnit | "percent" | "grade" | "ratio";
