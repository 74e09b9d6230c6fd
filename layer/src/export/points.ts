import { ecefToGeodetic } from "@groma/georef";
import { CLIPS_OPTION, type ClipSet } from "../clips/index.js";
import type { PointFilter } from "../effects/index.js";
import {
  flag,
  type Kind,
  kindOf,
  list,
  number,
  oneOf,
  optionPlace,
  signal,
  some,
  whole,
} from "../options/index.js";
import type { PointOrigin } from "../query/index.js";
import type { ByteSink } from "./byte-sink.js";
import { exportCsv } from "./csv.js";
import { exportDxf } from "./dxf.js";
import { exportGeoJson } from "./geojson.js";
import { knownOf } from "./known.js";
import { exportLas } from "./las.js";
import { exportLaz, type LazOptions } from "./laz.js";
import { narrowed } from "./narrowed.js";
import { noPlace } from "./passing.js";
import type { PointSelection } from "./selection.js";

/** Formats that points are exported in. */
export type PointFormat = "las" | "laz" | "csv" | "geojson" | "dxf";

/** What points are exported of: a data set, or a part of one, such as a `Profile`. */
export type ExportedPoints = PointOrigin | PointSelection;

/** Which points are exported, and how. */
export interface PointExportOptions extends LazOptions {
  /** Default: `las`. */
  readonly format?: PointFormat | undefined;
  /** Volumes that cut, such as `layer.clips`; what only highlights changes nothing. Default: none. */
  readonly clips?: ClipSet | undefined;
  /** What passes, such as `layer.filter`. Default: everything. */
  readonly filter?: PointFilter | undefined;
  /** Classes that are wanted. Default: all, or those of the selection. */
  readonly classes?: readonly number[] | undefined;
  /** Distance between neighbouring points that suffices, metres; the file then names it. Default: 0, every point. */
  readonly spacing?: number | undefined;
  /** DXF: whether points are laid along the straightened line of a profile. Default: `space`. */
  readonly layout?: "space" | "straightened" | undefined;
}

const WRITERS = {
  las: exportLas,
  laz: exportLaz,
  csv: exportCsv,
  geojson: exportGeoJson,
  dxf: exportDxf,
} as const;

/** Checked against the data set, which knows its attributes. */
const FILTER: Kind<PointFilter> = { valid: "a filter", read: (given) => given as PointFilter };

const PROGRESS = kindOf(
  "a function",
  (given): given is NonNullable<PointExportOptions["onProgress"]> => typeof given === "function",
);

const LEFT_OUT = kindOf(
  "a function",
  (given): given is NonNullable<PointExportOptions["onLeftOut"]> => typeof given === "function",
);

const COMPRESSOR = kindOf(
  "a function",
  (given): given is NonNullable<PointExportOptions["createCompressor"]> => typeof given === "function",
);

const OPTIONS = some<PointExportOptions>({
  ...{ format: oneOf("las", "laz", "csv", "geojson", "dxf"), layout: oneOf("space", "straightened") },
  ...{ clips: CLIPS_OPTION, filter: FILTER, classes: list(whole(0, 255)), spacing: number(0) },
  ...{ chainage: flag, signal, onProgress: PROGRESS, onLeftOut: LEFT_OUT, createCompressor: COMPRESSOR },
});

/**
 * Writes points complete, each once, with all that is recorded of them: of a whole data set, of a profile, or of what clips and
 * a filter leave of either; to the file that `groma clip` or `groma profile` writes of the same.
 *
 * @param from a `PointCloud`, a `Profile`, or several of one kind of records
 * @param sink gets the file, part by part; what was written before a failure is no file
 * @returns number of points
 * @throws StyleError STYLE_OPTION, STYLE_FILTER, STYLE_CLIP before anything is read
 * @throws FormatError EXPORT_NO_PLACE where clips of the globe, or longitudes and latitudes, are asked for of points without a
 *   place; EXPORT_NO_LAS, EXPORT_NO_LAZ, EXPORT_MIXED
 * @throws SourceError, FormatError, DecodeError, PlacementError; the signal's reason when aborted; what the sink throws
 */
export async function exportPoints(
  from: ExportedPoints | readonly ExportedPoints[],
  sink: ByteSink,
  options: PointExportOptions = {},
): Promise<number> {
  const given: readonly ExportedPoints[] = Array.isArray(from) ? from : [from as ExportedPoints];
  const named = given.map(selectionOf);
  const place = optionPlace("options", named[0]?.origin.name ?? "");
  const { format = "las", clips, filter, classes, spacing, ...rest } = OPTIONS.read(options, place);
  const selections: PointSelection[] = [];
  for (const selection of named) {
    const { origin } = selection;
    if (format === "geojson" && !geodeticOf(selection))
      throw noPlace(origin.name, "longitudes and latitudes");
    const wanted = {
      ...{ origin, volume: selection.volume, along: selection.along, filter: selection.filter },
      geodetic: geodeticOf(selection),
      classes: classes ? new Set(classes) : selection.classes,
      spacing: spacing ?? selection.spacing,
    };
    selections.push(await narrowed(wanted, { clips, filter }, knownOf(origin), rest.signal));
  }
  return WRITERS[format](selections, sink, rest);
}

function selectionOf(from: ExportedPoints): PointSelection {
  return "origin" in from ? from : { origin: from };
}

function geodeticOf({ origin, geodetic }: PointSelection): PointSelection["geodetic"] {
  const { space } = knownOf(origin);
  if (geodetic || !space) return geodetic;
  return (x, y, z, out) => {
    space.place(x, y, z, out);
    ecefToGeodetic(out[0], out[1], out[2], out);
    out[0] *= 180 / Math.PI;
    out[1] *= 180 / Math.PI;
  };
}
