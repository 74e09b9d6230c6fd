import type { Unit } from "./crs.js";
import { PROJ_DATUMS } from "./datum-table.js";
import { ellipsoidByProjName, type Figure, WGS84_FIGURE } from "./ellipsoids.js";
import type { CrsModel, VerticalModel } from "./model.js";
import { unknown, unsupported } from "./refusal.js";
import { DEGREE, METRE, unitByProjName, unitOf } from "./units.js";
import { WEB_MERCATOR } from "./web-mercator.js";

type Keys = ReadonlyMap<string, string>;

/** Name of the datum of a PROJ string that gives an ellipsoid and nothing else. */
export const NO_DATUM = "not specified";

/** Projections of proj4js that the tests hold against PROJ. */
const PROJECTIONS = [
  ...[
    "longlat",
    "geocent",
    "utm",
    "tmerc",
    "etmerc",
    "lcc",
    "sterea",
    "stere",
    "somerc",
    "omerc",
    "krovak",
    "laea",
  ],
  ...["aea", "merc", "webmerc", "poly", "eqdc", "nzmg"],
];
/** Other names for the same in PROJ strings. */
const ALIASES: ReadonlyMap<string, string> = new Map([
  ["latlong", "longlat"],
  ["latlon", "longlat"],
  ["lonlat", "longlat"],
]);

/** Keys that parametrise a projection, all of them plain numbers: of degrees and minutes proj4js would take the first. */
const PARAMETERS = [
  ...[
    "zone",
    "lat_0",
    "lat_1",
    "lat_2",
    "lat_ts",
    "lon_0",
    "lonc",
    "alpha",
    "gamma",
    "k",
    "k_0",
    "x_0",
    "y_0",
  ],
];
/** Keys without a value that change the projection. */
const FLAGS = ["south", "no_uoff", "no_off"];
/** Keys that say nothing about where a point is. */
const SILENT = ["no_defs", "wktext", "type", "over", "lon_wrap", "title"];
/** Keys that are read here, each in its place. */
const READ = [
  ...[
    "proj",
    "ellps",
    "datum",
    "a",
    "b",
    "rf",
    "f",
    "R",
    "towgs84",
    "pm",
    "units",
    "to_meter",
    "nadgrids",
    "axis",
  ],
  ...["geoidgrids", "vunits", "vto_meter", "geoid_crs"],
];

/** Prime meridians of PROJ by name, degrees (PROJ, prime_meridians in datums.cpp). */
const MERIDIANS: ReadonlyMap<string, number> = new Map([
  ["greenwich", 0],
  ["lisbon", -9.131906111111],
  ["paris", 2.337229166667],
  ["bogota", -74.080916666667],
  ["madrid", -3.687938888889],
  ["rome", 12.452333333333],
  ["bern", 7.439583333333],
  ["jakarta", 106.807719444444],
  ["ferro", -17.666666666667],
  ["brussels", 4.367975],
  ["stockholm", 18.058277777778],
  ["athens", 23.7163375],
  ["oslo", 10.722916666667],
]);

/**
 * Reads a PROJ string. A key that proj4js would pass over in silence is handled here or refused by name.
 * @throws Refusal
 */
export function readProjString(text: string): CrsModel {
  const keys = split(text);
  const name = keys.get("proj") ?? "";
  const projection = ALIASES.get(name) ?? name;
  if (text.includes("proj=pipeline"))
    throw unsupported("a PROJ pipeline is an operation, not a coordinate reference system");
  if (!PROJECTIONS.includes(projection))
    throw unsupported(`the map projection +proj=${name} is not supported`);
  for (const key of keys.keys()) {
    if (![...PARAMETERS, ...FLAGS, ...SILENT, ...READ].includes(key))
      throw unsupported(`+${key} in the PROJ string is not supported`);
  }
  const axis = keys.get("axis");
  if (axis !== undefined && axis !== "enu" && axis !== "neu") {
    throw unsupported(`+axis=${axis} in the PROJ string: only easting and northing are supported`);
  }

  const kind =
    projection === "longlat" ? "geographic" : projection === "geocent" ? "geocentric" : "projected";
  const unit = kind === "geographic" ? DEGREE : (linearUnit(keys, "units", "to_meter") ?? METRE);
  const datum = keys.get("datum");
  const known = datum === undefined ? undefined : PROJ_DATUMS.get(datum);
  if (datum !== undefined && !known) throw unsupported(`+datum=${datum} in the PROJ string is not supported`);
  return {
    name: text.trim(),
    horizontal: {
      ...{ kind, name: text.trim(), unit, directions: [], meridian: meridian(keys) },
      datum: {
        name: known?.name ?? datum ?? NO_DATUM,
        figure: figure(keys, known?.ellps),
        towgs84: shift(keys) ?? known?.towgs84,
        grid: keys.get("nadgrids"),
      },
      projection: kind === "projected" ? projectionText(projection, keys) : undefined,
    },
    vertical: vertical(keys),
  };
}

/** The `+towgs84` of a PROJ string as numbers, `+datum` resolved; undefined when there is neither. */
export function shiftOfProjString(text: string): readonly number[] | undefined {
  const keys = split(text);
  return shift(keys) ?? PROJ_DATUMS.get(keys.get("datum") ?? "")?.towgs84;
}

function split(text: string): Keys {
  const keys = new Map<string, string>();
  // Values may hold blanks (grid files do), so words begin at their plus where the text has any.
  for (const word of text.trim().split(text.includes("+") ? /\s+(?=\+)/ : /\s+/)) {
    const [, key, value = ""] = /^\+?([A-Za-z_][\w-]*)\s*(?:=\s*(.*))?$/.exec(word.trim()) ?? [];
    if (key === undefined) throw unknown(`"${word}" in the PROJ string cannot be read`);
    keys.set(key, value);
  }
  return keys;
}

function numeric(keys: Keys, key: string): number | undefined {
  const text = keys.get(key);
  if (text === undefined) return undefined;
  const value = Number(text);
  if (text === "" || !Number.isFinite(value))
    throw unknown(`+${key}=${text} in the PROJ string is no number`);
  return value;
}

function linearUnit(keys: Keys, byName: string, bySize: string): Unit | undefined {
  const size = numeric(keys, bySize);
  if (size !== undefined) return unitOf("unit", "linear", size);
  const name = keys.get(byName);
  if (name === undefined) return undefined;
  const unit = unitByProjName(name);
  if (!unit) throw unsupported(`+${byName}=${name} in the PROJ string is not a unit that is supported`);
  return unit;
}

function figure(keys: Keys, ellipsoidOfDatum: string | undefined): Figure {
  const radius = numeric(keys, "R");
  if (radius !== undefined) return { a: radius, rf: 0 };
  const a = numeric(keys, "a");
  if (a !== undefined) {
    const b = numeric(keys, "b");
    const f = numeric(keys, "f");
    const rf = numeric(keys, "rf") ?? (f ? 1 / f : b === undefined || b === a ? 0 : a / (a - b));
    return { a, rf };
  }
  const name = keys.get("ellps") ?? ellipsoidOfDatum;
  if (name === undefined) return WGS84_FIGURE;
  const found = ellipsoidByProjName(name);
  if (!found) throw unsupported(`+ellps=${name} in the PROJ string is not known`);
  return found;
}

function shift(keys: Keys): readonly number[] | undefined {
  const values = keys.get("towgs84")?.split(",").map(Number);
  if (!values) return undefined;
  if (![3, 7].includes(values.length) || !values.every(Number.isFinite)) {
    throw unknown(`+towgs84=${keys.get("towgs84")} has not three or seven numbers`);
  }
  return values;
}

function meridian(keys: Keys): number {
  const name = keys.get("pm");
  if (name === undefined) return 0;
  const value = MERIDIANS.get(name) ?? Number(name);
  if (!Number.isFinite(value)) throw unsupported(`+pm=${name} in the PROJ string is not known`);
  return value;
}

/** `+geoidgrids` and `+vunits` say what z is; proj4js drops both. */
function vertical(keys: Keys): VerticalModel | undefined {
  const grid = keys.get("geoidgrids");
  const unit = linearUnit(keys, "vunits", "vto_meter");
  if (grid !== undefined) return { name: grid, reference: "geoid", unit };
  return unit && { name: "height", reference: "unknown", unit };
}

function projectionText(projection: string, keys: Keys): string {
  const sphere = keys.get("nadgrids") === "@null" && projection === "merc";
  if (projection === "webmerc" || sphere) return webMercator(keys);
  if (projection === "utm" && !/^([1-9]|[1-5]\d|60)$/.test(keys.get("zone") ?? "")) {
    throw unknown(`+zone=${keys.get("zone")} is no UTM zone`);
  }
  const words = [`+proj=${projection}`];
  for (const key of keys.keys()) {
    if (FLAGS.includes(key)) words.push(`+${key}`);
    else if (PARAMETERS.includes(key)) words.push(`+${key}=${numeric(keys, key)}`);
  }
  return words.join(" ");
}

/** Spherical formulas on geodetic coordinates; anything but the plain form would need another treatment. */
function webMercator(keys: Keys): string {
  const shifted = ["lat_ts", "lon_0", "x_0", "y_0", "lat_0"].some((key) => (numeric(keys, key) ?? 0) !== 0);
  const a = figure(keys, "WGS84").a;
  if (shifted || (numeric(keys, "k") ?? 1) !== 1 || a !== WGS84_FIGURE.a) {
    throw unsupported("a Pseudo-Mercator other than EPSG:3857 is not supported");
  }
  return WEB_MERCATOR;
}
