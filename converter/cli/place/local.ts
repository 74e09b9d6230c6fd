import {
  type AccuracyPart,
  anchorSimilarity,
  type Crs,
  type FittedSimilarity,
  fitSimilarity,
  localCrs,
  type Similarity,
} from "@groma/georef";
import { OptionError } from "../given/option-error.js";
import { readRows } from "../given/rows.js";

const DEGREE = Math.PI / 180;

/** What the user says of where a data set without a coordinate reference system is. */
export interface GivenPlace {
  /** `lon,lat,height,heading[,scale]`: degrees, metres, degrees clockwise from north, metres per source unit. */
  readonly anchor?: string | undefined;
  /** `x,y,z`: the point of the source that stands at the anchor; its origin by default. */
  readonly anchorAt?: string | undefined;
  /** File of control points. */
  readonly control?: string | undefined;
}

/** A data set that is put on the globe as a rigid body with one scale. */
export interface LocalPlace {
  readonly basis: "anchor" | "control points" | "Groma's record";
  readonly crs: Crs;
  readonly similarity: Similarity;
  /** The point of the source that stands at the anchor. */
  readonly at?: readonly [number, number, number];
  /** How well the control points fit. */
  readonly fitted?: FittedSimilarity;
  /** As an earlier conversion stated it. */
  readonly accuracy?: readonly AccuracyPart[];
}

/** Whether the user has said where the data set is. */
export function isPlaced({ anchor, anchorAt, control }: GivenPlace): boolean {
  return anchor !== undefined || anchorAt !== undefined || control !== undefined;
}

/**
 * The place that the user gave.
 *
 * @throws OptionError OPTION_ANCHOR, OPTION_ANCHOR_AT
 * @throws RowsError, ControlError CONTROL_*
 */
export async function localPlace({ anchor, anchorAt, control }: GivenPlace): Promise<LocalPlace> {
  if (control !== undefined) return controlled(control);
  if (anchor === undefined) throw wrong("anchor", "--anchor-at requires --anchor");
  return anchored(anchor, anchorAt);
}

function anchored(text: string, atText: string | undefined): LocalPlace {
  const [longitude, latitude, height, heading, scale = 1] = numbers("anchor", text, 4, 5);
  const [x, y, z] = atText === undefined ? [0, 0, 0] : numbers("anchor-at", atText, 3, 3);
  if (!(Math.abs(latitude) <= 90)) {
    throw wrong("anchor", `latitude must be between −90 and 90, and is ${latitude}`);
  }
  if (!(Math.abs(longitude) <= 360)) {
    throw wrong("anchor", `longitude must be between −360 and 360, and is ${longitude}`);
  }
  // As far as units are units for the georeference record.
  if (!(scale > 0)) throw wrong("anchor", `the scale must be greater than 0, and is ${scale}`);
  if (!(scale > 1e-9 && scale < 3e8)) throw wrong("anchor", `${scale} metres per unit is no unit of a scan`);
  const similarity = anchorSimilarity({
    ...{ longitude: longitude * DEGREE, latitude: latitude * DEGREE, height },
    ...{ heading: heading * DEGREE, scale, at: [x, y, z] },
  });
  const name = `local coordinates, anchored at longitude ${longitude}°, latitude ${latitude}°`;
  return { basis: "anchor", crs: localCrs(name, scale), similarity, at: [x, y, z] };
}

async function controlled(file: string): Promise<LocalPlace> {
  const columns = "x y z longitude latitude height";
  const rows = await readRows(file, { kind: "CONTROL", columns, fewest: 6, most: 6 });
  const points = rows.map(({ values: [x, y, z, longitude, latitude, height] }) => ({
    source: [x, y, z] as const,
    geodetic: [longitude * DEGREE, latitude * DEGREE, height] as const,
  }));
  const fitted = fitSimilarity(points, file);
  const name = `local coordinates, placed by ${points.length} control points`;
  return {
    ...{ basis: "control points", crs: localCrs(name, fitted.scale) },
    ...{ similarity: fitted.similarity, fitted },
  };
}

const NAMES = { anchor: ["lon", "lat", "height", "heading", "scale"], "anchor-at": ["x", "y", "z"] } as const;

function numbers(option: "anchor" | "anchor-at", text: string, fewest: number, most: number): number[] {
  const words = text.split(",").map((word) => word.trim());
  const names = NAMES[option];
  const bad = words.find((word) => word === "" || !Number.isFinite(Number(word)));
  if (bad !== undefined) throw wrong(option, `"${bad}" is not a number`);
  if (words.length < fewest) {
    const missing = names.slice(words.length, fewest);
    const are = missing.length === 1 ? "is" : "are";
    throw wrong(option, `needs ${names.slice(0, fewest).join()}: ${missing.join(", ")} ${are} missing`);
  }
  if (words.length > most) {
    const expected = fewest === most ? fewest : `${fewest} or ${most}`;
    throw wrong(option, `expected ${expected} numbers, found ${words.length}; use a decimal point`);
  }
  return words.map(Number);
}

function wrong(option: "anchor" | "anchor-at", cause: string): OptionError {
  const form =
    option === "anchor"
      ? "lon,lat,height,heading or lon,lat,height,heading,scale: degrees, metres, degrees clockwise from north"
      : "x,y,z in source coordinates";
  const code = `OPTION_${option.toUpperCase().replace("-", "_")}`;
  return new OptionError({ code, file: `--${option}`, cause, fix: `give it as ${form}` });
}
