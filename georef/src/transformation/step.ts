import type { GridWindow } from "../grid/window.js";

/**
 * The way from source coordinates to ECEF as PROJ goes it, one step after the other. What PROJ computes with grids
 * is applied here with windows of the same grids, bilinearly as PROJ does; what it computes with formulas of the
 * ellipsoid is computed in closed form; the map projection alone is replaced by certified fits.
 *
 * State between the steps: after `projection` longitude, latitude (radians) and z in source units; after `height`
 * z in metres; after `geocentric` ECEF (EPSG:4978, metres).
 */
export type Step = ProjectionStep | ShiftStep | ChoiceStep | GeocentricStep;

/** Leads from longitude, latitude and height to longitude, latitude and height. */
export type ShiftStep = HeightStep | HorizontalShiftStep | VerticalShiftStep | DatumShiftStep;

/** (x, y) in source units → longitude, latitude in radians, by a patchwork of certified fits. z is untouched. */
export interface ProjectionStep {
  readonly kind: "projection";
  readonly patchwork: Patchwork;
}

/** z · metresPerUnit, which is negative where z counts downwards. */
export interface HeightStep {
  readonly kind: "height";
  readonly metresPerUnit: number;
}

/** PROJ's hgridshift: bilinear shift of longitude and latitude, channel 0 of the window to the east, 1 to the north. */
export interface HorizontalShiftStep {
  readonly kind: "horizontalShift";
  /** `inverse` solves for the point whose shifted place is given, iterating as PROJ does. */
  readonly direction: "forward" | "inverse";
  readonly window: GridWindow;
}

/** PROJ's vgridshift: h += multiplier · N(longitude, latitude), N from channel 0 of the window, metres. */
export interface VerticalShiftStep {
  readonly kind: "verticalShift";
  readonly multiplier: number;
  readonly window: GridWindow;
}

/**
 * geodetic → ECEF of `from` → Helmert → geodetic of `to`. `keepHeight` restores the height that came in (PROJ's
 * push and pop of v_3, which every horizontal datum shift of a compound CRS has).
 */
export interface DatumShiftStep {
  readonly kind: "datumShift";
  readonly from: EllipsoidAxes;
  readonly to: EllipsoidAxes;
  /** Linear map of PROJ's helmert step: X' = translation + matrix · X; metres, row-major 3 × 3, scale included. */
  readonly translation: readonly [number, number, number];
  readonly matrix: readonly number[];
  readonly keepHeight: boolean;
}

/**
 * As PROJ chooses for each point: the first way whose area the point lies in, and that has a place for it. Follows the
 * projection.
 */
export interface ChoiceStep {
  readonly kind: "choice";
  readonly ways: readonly Way[];
}

/** One operation of a {@link ChoiceStep}. */
export interface Way {
  /** Where it is for; source units, edges included. */
  readonly area: Rectangle;
  readonly steps: readonly ShiftStep[];
}

/** Longitude, latitude, ellipsoidal height → ECEF. The last step. */
export interface GeocentricStep {
  readonly kind: "geocentric";
  readonly ellipsoid: EllipsoidAxes;
}

/** The figure of an ellipsoid. */
export interface EllipsoidAxes {
  /** Semi-major axis, metres. */
  readonly a: number;
  /** Flattening. */
  readonly f: number;
}

/** Source coordinates in plan, source units. */
export interface Rectangle {
  readonly minX: number;
  readonly minY: number;
  readonly maxX: number;
  readonly maxY: number;
}

/** A quadtree-like set of rectangles, each with its own polynomial; every point of the domain lies in exactly one. */
export interface Patchwork {
  readonly patches: readonly Patch[];
  /** Metres on the ground: no point of the domain is put farther from where the projection has it. */
  readonly bound: number;
  /**
   * Longitude and latitude (radians) of the place that the patches count from, where a pole or the antimeridian lies inside:
   * their values are then longitude and latitude on the sphere of normals, turned so that this place is its 0, 0.
   */
  readonly centre?: readonly [longitude: number, latitude: number] | undefined;
}

/** longitude, latitude = Σ c_kl T_k(u) T_l(v), u and v from −1 to 1 over the rectangle (source units). */
export interface Patch {
  readonly minX: number;
  readonly minY: number;
  readonly maxX: number;
  readonly maxY: number;
  /** Highest degree in u and in v. */
  readonly degree: number;
  /** Radians: (degree + 1)² coefficients of longitude (row-major, k slow), then as many of latitude. */
  readonly coefficients: Float64Array;
}

/** The whole way. */
export interface Transformation {
  readonly steps: readonly Step[];
}
