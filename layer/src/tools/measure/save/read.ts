import { MeasureError } from "../../../errors/index.js";
import { MEASUREMENT_KINDS, type Measurement, type MeasurementKind } from "../measurement/measurement.js";
import { noteOf } from "../measurement/note.js";
import { isObject, volumeSettingsOf } from "../measurement/volume-settings.js";
import type { MeasuredCloud, Vertex } from "../vertex/vertex.js";
import { FORMAT, VERSION } from "./document.js";
import { figuresIn } from "./foreign.js";
import { placeOf, SavedVertices } from "./saved-vertices.js";

/** What a file of measurements holds. */
export interface ReadMeasurements {
  readonly measurements: readonly Measurement[];
  /** What has to be known of them, in English: vertices without records, data sets that are not open, features left out. */
  readonly notes: readonly string[];
}

/** Longest file that is read, characters: a million vertices. */
const LONGEST = 300_000_000;

/**
 * Reads GeoJSON: what {@link measurementsToGeoJson} wrote, to the integer; and points, lines and polygons of any other
 * writer, whose vertices are places and no records.
 *
 * @param clouds data sets that are open: vertices on their records have their places and what these are worth
 * @param file name for messages
 * @throws MeasureError MEASURE_FILE where it is no GeoJSON in longitude and latitude, MEASURE_VERSION where a later version
 *   of this project wrote it
 */
export function readMeasurements(
  text: string,
  clouds: readonly MeasuredCloud[] = [],
  file = "measurements",
): ReadMeasurements {
  const root = parsed(text, file);
  checkVersion(root.groma, file);
  checkSystem(root.crs, file);
  const features = featuresOf(root, file);
  const notes = new Set<string>();
  const saved = isObject(root.groma) ? root.groma.datasets : undefined;
  const reader = new Reader(new SavedVertices(clouds, saved, notes), notes);
  const measurements = features.flatMap((feature, i) => {
    const found = isObject(feature) ? reader.feature(feature, i) : "it is no feature";
    if (typeof found !== "string") return found;
    notes.add(`feature ${i + 1} is left out: ${found}`);
    return [];
  });
  return { measurements, notes: [...notes] };
}

function featuresOf(root: Readonly<Record<string, unknown>>, file: string): readonly unknown[] {
  if (root.type === "Feature") return [root];
  if (root.type === "FeatureCollection" && Array.isArray(root.features)) return root.features;
  // A geometry alone is GeoJSON too (RFC 7946, 2).
  if (Array.isArray(root.coordinates)) return [{ geometry: root }];
  if (root.type === "GeometryCollection" && Array.isArray(root.geometries)) {
    return root.geometries.map((geometry) => ({ geometry }));
  }
  throw refused(file, "it is no feature or feature collection of GeoJSON");
}

function parsed(text: string, file: string): Record<string, unknown> {
  if (text.length > LONGEST) throw refused(file, "it is longer than any file of measurements");
  let root: unknown;
  try {
    root = JSON.parse(text.replace(/^\uFEFF/, ""));
  } catch {
    throw refused(file, "it is no JSON");
  }
  if (!isObject(root)) throw refused(file, "it is no GeoJSON");
  return root;
}

function checkVersion(groma: unknown, file: string): void {
  if (groma === undefined) return;
  if (!isObject(groma) || groma.format !== FORMAT)
    throw refused(file, "its member groma is none of measurements");
  if (groma.version === VERSION) return;
  throw new MeasureError({
    code: "MEASURE_VERSION",
    file,
    cause: `it has version ${JSON.stringify(groma.version)?.slice(0, 20)} of the format; this program reads version ${VERSION}`,
    fix: "open it with the version of the program that wrote it, or with a later one",
  });
}

/** Coordinates in another system than that of RFC 7946, as GeoJSON of 2008 could name it. */
function checkSystem(crs: unknown, file: string): void {
  const name = isObject(crs) && isObject(crs.properties) ? crs.properties.name : undefined;
  if (typeof name !== "string" || /(CRS84h?|EPSG:{1,2}(4326|4979))$/i.test(name)) return;
  throw new MeasureError({
    code: "MEASURE_FILE",
    file,
    cause: `its coordinates are in ${name.slice(0, 80)}, not in longitude and latitude of WGS 84`,
    fix: "save it as GeoJSON of RFC 7946, in EPSG:4326",
  });
}

function refused(file: string, cause: string): MeasureError {
  return new MeasureError({
    code: "MEASURE_FILE",
    file,
    cause,
    fix: "choose a file of measurements, or any GeoJSON with points, lines or polygons",
  });
}

class Reader {
  readonly #vertices: SavedVertices;
  readonly #notes: Set<string>;

  constructor(vertices: SavedVertices, notes: Set<string>) {
    this.#vertices = vertices;
    this.#notes = notes;
  }

  /** @returns what was measured, or why nothing was */
  feature(feature: Readonly<Record<string, unknown>>, at: number): readonly Measurement[] | string {
    const { groma } = feature;
    const own = isObject(groma) && Array.isArray(groma.vertices);
    return own ? this.#own(feature, groma, at) : this.#foreign(feature, at);
  }

  #own(
    feature: Readonly<Record<string, unknown>>,
    { kind, vertices, volume: settings, note: said }: Readonly<Record<string, unknown>>,
    at: number,
  ): readonly Measurement[] | string {
    if (!isKind(kind)) return `it is of a kind that is not known here: ${JSON.stringify(kind)?.slice(0, 40)}`;
    const found = (vertices as readonly unknown[]).map((one) => this.#vertices.vertex(one));
    if (!found.every((vertex) => vertex !== undefined)) return NO_PLACE;
    const { least, most, title } = MEASUREMENT_KINDS[kind];
    if (found.length < least || found.length > most) return "its vertices are not as many as its kind needs";
    const volume = settings === undefined ? undefined : volumeSettingsOf(settings);
    if (settings !== undefined && !volume) {
      this.#notes.add(
        `feature ${at + 1}: what its volume is measured against is not known here; its lowest vertex is taken`,
      );
    }
    const note = said === undefined ? undefined : noteOf(said);
    if (said !== undefined && !note)
      this.#notes.add(`feature ${at + 1}: its note is no text and is left out`);
    const name = nameOf(feature) ?? `${title} ${at + 1}`;
    const id = idOf(feature, at);
    return [{ id, kind, vertices: found, name, ...(volume && { volume }), ...(note && { note }) }];
  }

  #foreign(feature: Readonly<Record<string, unknown>>, at: number): readonly Measurement[] | string {
    const { geometry, properties } = feature;
    if (!isObject(geometry)) return "it has no geometry";
    const named = isObject(properties) && isKind(properties.kind) ? properties.kind : undefined;
    const figures = figuresIn(geometry, named);
    if (typeof figures === "string") return figures;
    const measurements: Measurement[] = [];
    for (const [i, { kind, positions }] of figures.entries()) {
      const vertices = positions.map(placeOf);
      if (!vertices.every((vertex): vertex is Vertex => vertex !== undefined)) return NO_PLACE;
      const part = figures.length > 1 ? `, part ${i + 1}` : "";
      const name = (nameOf(feature) ?? `${MEASUREMENT_KINDS[kind].title} ${at + 1}`) + part;
      measurements.push({ id: idOf(feature, at) + part, kind, vertices, name });
    }
    this.#notes.add("vertices of other programs are places, no records of a scan");
    return measurements;
  }
}

const NO_PLACE =
  "its coordinates are no longitudes and latitudes of WGS 84 in degrees, with heights in metres if any";

function nameOf({ properties }: Readonly<Record<string, unknown>>): string | undefined {
  return isObject(properties) && typeof properties.name === "string" ? properties.name : undefined;
}

function idOf({ id }: Readonly<Record<string, unknown>>, at: number): string {
  return typeof id === "string" || typeof id === "number" ? String(id) : `feature-${at + 1}`;
}

function isKind(value: unknown): value is MeasurementKind {
  return typeof value === "string" && Object.hasOwn(MEASUREMENT_KINDS, value);
}
