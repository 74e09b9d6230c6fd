import type { LinearMap } from "./helmert.js";
import type { StepText } from "./step-text.js";

/** What makes an ellipsoid in a PROJ step (`ellps`, `a`, `rf` …). */
export type EllipsoidText = ReadonlyMap<string, string>;

/** A step as the pipeline has it, before grids are cut and the projection is fitted. */
export type PlannedStep =
  | { readonly kind: "height"; readonly metresPerUnit: number }
  | {
      readonly kind: "horizontalShift";
      readonly direction: "forward" | "inverse";
      readonly grids: readonly GridName[];
      /** Number of the pipeline's steps that come before, for finding out where points are by then. */
      readonly before: number;
    }
  | {
      readonly kind: "verticalShift";
      readonly multiplier: number;
      readonly grids: readonly GridName[];
      readonly before: number;
    }
  /** PROJ's geogoffset: arc-seconds added to longitude and latitude. */
  | { readonly kind: "horizontalOffset"; readonly longitude: number; readonly latitude: number }
  /** The same for heights, metres. */
  | { readonly kind: "verticalOffset"; readonly metres: number }
  | {
      readonly kind: "datumShift";
      readonly from: EllipsoidText;
      readonly to: EllipsoidText;
      readonly map: LinearMap;
      readonly keepHeight: boolean;
    }
  /**
   * Steps from `before` up to `after` that have no form of their own here: from longitude, latitude (radians) and height to
   * the same, taken as PROJ gives them on a raster.
   */
  | {
      readonly kind: "sampled";
      readonly before: number;
      readonly after: number;
      /** Where they go through space: what they do at one place stands for most of what they do at all. */
      readonly space?: {
        readonly from: EllipsoidText;
        readonly to: EllipsoidText;
        readonly keepHeight: boolean;
      };
    }
  | { readonly kind: "geocentric"; readonly ellipsoid: EllipsoidText };

/** One of the grids that a step names; PROJ goes on to the next where an optional one (`@name`) is missing. */
export interface GridName {
  readonly name: string;
  readonly optional: boolean;
}

/** A PROJ pipeline from a source CRS to EPSG:4978, understood. */
export interface Plan {
  /** All steps, x as easting or longitude whatever the authority's order of axes is. */
  readonly pipeline: readonly StepText[];
  /** How many of them lead from source coordinates to longitude, latitude in radians. */
  readonly projection: number;
  /** What follows. */
  readonly steps: readonly PlannedStep[];
  /** Metres per unit of z by the pipeline's own account. */
  readonly metresPerUnit: number;
  /** A step changes with time, and no epoch of the coordinates is known. */
  readonly undated: boolean;
}
