import type { Crs } from "@groma/georef";
import type { MeasurementKind } from "../measurement/measurement.js";
import type { Note } from "../measurement/note.js";
import type { VolumeSettings } from "../measurement/volume-settings.js";
import type { UncertaintyPart } from "../worth/quantity.js";
import type { Geometry, Position } from "./geometry.js";

/** Of the foreign member `groma`; a reader refuses any other. */
export const FORMAT = "measurements";
export const VERSION = 1;

/** A data set that vertices stand on, as far as its records can be told by it. */
export interface SavedDataset {
  readonly name: string;
  /** What tells its points from those of others of the same name. */
  readonly identity?: string;
  readonly crs: {
    readonly name: string;
    readonly code?: string;
    readonly wkt?: string;
    readonly proj4: string;
  };
  /** What its heights are measured from. */
  readonly height: Crs["height"];
  /** Source units per step of the integers. */
  readonly scale: readonly [number, number, number];
}

/** A vertex as it is saved: the record that it stands on, or the place alone. */
export interface SavedVertex {
  /** Longitude and latitude of WGS 84 in degrees, height above the ellipsoid in metres. */
  readonly place: Position;
  readonly dataset?: string;
  readonly identity?: string;
  /** x, y, z in the units of the data set's coordinate system. */
  readonly source?: readonly [number, number, number];
  readonly node?: string;
  readonly index?: number;
  /** The record's own integers. */
  readonly integers?: readonly [number, number, number];
}

/** A value as it is saved, with what it is worth; in its unit. */
export interface SavedValue {
  readonly name: string;
  readonly value: number;
  readonly unit: string;
  readonly uncertainty: number | null;
  readonly atLeast: number;
  readonly coverage: number;
  readonly parts: readonly UncertaintyPart[];
}

/** One measurement as a GeoJSON feature. */
export interface MeasurementFeature {
  readonly type: "Feature";
  readonly id: string;
  readonly geometry: Geometry;
  /** What any GIS shows as attributes: values in the unit that is in the name. */
  readonly properties: Readonly<Record<string, string | number | null>>;
  readonly groma: {
    readonly kind: MeasurementKind;
    /** How a volume is measured. */
    readonly volume?: VolumeSettings;
    /** What an annotation says. */
    readonly note?: Note;
    readonly vertices: readonly SavedVertex[];
    readonly values: readonly SavedValue[];
  };
}

/** Several measurements as a GeoJSON feature collection (RFC 7946). */
export interface MeasurementCollection {
  readonly type: "FeatureCollection";
  readonly groma: {
    readonly format: typeof FORMAT;
    readonly version: typeof VERSION;
    readonly datasets: readonly SavedDataset[];
  };
  readonly features: readonly MeasurementFeature[];
}
