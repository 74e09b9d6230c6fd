import { MeasureError } from "../../../errors/index.js";
import { MEASUREMENT_KINDS, type Measurement, type MeasurementKind } from "../measurement/measurement.js";
import { volumeSettingsOf } from "../measurement/volume-settings.js";
import { datasetAmong, whyNotAmong } from "../vertex/dataset.js";
import {
  type MeasuredCloud,
  placeVertex,
  recordVertex,
  sourceVertex,
  type Vertex,
} from "../vertex/vertex.js";
import { FORMAT, VERSION } from "./document.js";

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
 * @throws MeasureError MEASURE_FILE where it is no GeoJSON, MEASURE_VERSION where a later version of this project wrote it
 */
export function readMeasurements(
  text: string,
  clouds: readonly MeasuredCloud[] = [],
  file = "measurements",
): ReadMeasurements {
  const root = parsed(text, file);
  checkVersion(root.groma, file);
  const features = root.type === "Feature" ? [root] : root.features;
  if (!Array.isArray(features) || (root.type !== "FeatureCollection" && root.type !== "Feature")) {
    throw refused(file, "it is no feature or feature collection of GeoJSON");
  }
  const notes = new Set<string>();
  const reader = new Reader(clouds, notes);
  const measurements = features.flatMap((feature, i) => {
    const found = isObject(feature) && reader.feature(feature, i);
    if (!found)
      notes.add(`feature ${i + 1} is left out: ${found === undefined ? UNFIT : "it is no feature"}`);
    return found || [];
  });
  return { measurements, notes: [...notes] };
}

const UNFIT = "its geometry is none that can be measured, or its vertices are not as many as its kind needs";

function parsed(text: string, file: string): Record<string, unknown> {
  if (text.length > LONGEST) throw refused(file, "it is longer than any file of measurements");
  let root: unknown;
  try {
    root = JSON.parse(text);
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

function refused(file: string, cause: string): MeasureError {
  return new MeasureError({
    code: "MEASURE_FILE",
    file,
    cause,
    fix: "choose a file of measurements, or any GeoJSON with points, lines or polygons",
  });
}

class Reader {
  constructor(
    readonly clouds: readonly MeasuredCloud[],
    readonly notes: Set<string>,
  ) {}

  /** @returns undefined where nothing can be measured of it */
  feature({ id, geometry, properties, groma }: Record<string, unknown>, at: number): Measurement | undefined {
    const saved = isObject(groma) && Array.isArray(groma.vertices) ? groma.vertices : undefined;
    const found = isObject(geometry) ? fromGeometry(geometry) : undefined;
    const kind = isObject(groma) && isKind(groma.kind) ? groma.kind : found?.kind;
    const vertices = saved
      ? saved.map((one) => this.vertex(one))
      : found?.positions.map((one) => this.place(one));
    if (!kind || !vertices?.every((vertex) => vertex !== undefined)) return undefined;
    const { least, most, title } = MEASUREMENT_KINDS[kind];
    if (vertices.length < least || vertices.length > most) return undefined;
    const named = isObject(properties) && typeof properties.name === "string" ? properties.name : undefined;
    const own = isObject(groma) ? groma.volume : undefined;
    const volume = own === undefined ? undefined : volumeSettingsOf(own);
    if (own !== undefined && !volume) {
      this.notes.add(
        `feature ${at + 1}: what its volume is measured against is not known here; its lowest vertex is taken`,
      );
    }
    if (!saved) this.notes.add("vertices of other programs are places, no records of a scan");
    return {
      id: typeof id === "string" || typeof id === "number" ? String(id) : `feature-${at + 1}`,
      ...{ kind, vertices, name: named ?? `${title} ${at + 1}` },
      ...(volume && { volume }),
    };
  }

  vertex(saved: unknown): Vertex | undefined {
    if (!isObject(saved)) return undefined;
    const { dataset, identity, node, index, integers, source, place } = saved;
    const there = this.place(place);
    if (!there || typeof dataset !== "string") return there;
    const named = { dataset, ...(typeof identity === "string" && { identity }) };
    const cloud = datasetAmong(this.clouds, named);
    const recorded = isTriple(integers) && typeof node === "string" && Number.isInteger(index);
    const record = recorded && { ...named, node, index: Number(index), integers };
    if (!cloud) {
      this.notes.add(`${whyNotAmong(this.clouds, named)}: its vertices stand at their saved places`);
      return { ...there, ...(record && { record }), ...(isTriple(source) && { source }) };
    }
    if (!isTriple(source)) return there;
    // Its place as the data set has it now; the record stays what it was.
    return record ? recordVertex(cloud, { ...record, source }) : sourceVertex(cloud, source);
  }

  place(position: unknown): Vertex | undefined {
    if (!Array.isArray(position)) return undefined;
    const [longitude, latitude, height = 0] = position;
    if (![longitude, latitude, height].every(Number.isFinite) || Math.abs(latitude) > 90) return undefined;
    return placeVertex((longitude * Math.PI) / 180, (latitude * Math.PI) / 180, height);
  }
}

/** Positions of a geometry of another program, and what is measured of them. */
function fromGeometry({
  type,
  coordinates,
}: Record<string, unknown>):
  | { readonly kind: MeasurementKind; readonly positions: readonly unknown[] }
  | undefined {
  if (!Array.isArray(coordinates)) return undefined;
  if (type === "Point") return { kind: "point", positions: [coordinates] };
  if (type === "LineString") {
    return { kind: coordinates.length === 2 ? "distance" : "polyline", positions: coordinates };
  }
  const [ring] = coordinates;
  // Holes would have to be taken off the area.
  if (type !== "Polygon" || coordinates.length !== 1 || !Array.isArray(ring)) return undefined;
  return { kind: "area", positions: ring.slice(0, -1) };
}

function isKind(value: unknown): value is MeasurementKind {
  return typeof value === "string" && Object.hasOwn(MEASUREMENT_KINDS, value);
}

function isTriple(value: unknown): value is [number, number, number] {
  return Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
