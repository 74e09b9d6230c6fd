import { MeasureError } from "../../../errors/index.js";
import {
  MEASUREMENT_KINDS,
  type Measurement,
  type NamedValue,
  valuesOf,
} from "../measurement/measurement.js";
import { datasetNameOf, type MeasuredCloud, type Vertex } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import {
  FORMAT,
  type MeasurementCollection,
  type MeasurementFeature,
  type SavedDataset,
  type SavedVertex,
  VERSION,
} from "./document.js";
import { geometryOf, positionOf } from "./geometry.js";

/** How measurements are saved. */
export interface SaveOptions extends WorthOptions {
  /** Values of a measurement, those that were read among them: `tool.valuesOf`. Default: those that need no reading. */
  readonly valuesOf?: ((measurement: Measurement) => readonly NamedValue[]) | undefined;
}

/**
 * Measurements as GeoJSON: geometries in WGS 84 for any GIS; the records, the coordinate systems and what the values are
 * worth as foreign members (schema: `@groma/layer/measurements.schema.json`). One whose vertices have no value is saved
 * all the same, without values.
 */
export function measurementsToGeoJson(
  measurements: readonly Measurement[],
  options: SaveOptions = {},
): MeasurementCollection {
  const datasets = new Map<string, SavedDataset>();
  for (const { vertices } of measurements) {
    for (const { cloud } of vertices) {
      if (cloud) datasets.set(JSON.stringify([cloud.name, cloud.identity]), savedDataset(cloud));
    }
  }
  return {
    type: "FeatureCollection",
    groma: { format: FORMAT, version: VERSION, datasets: [...datasets.values()] },
    features: measurements.map((measurement) => featureOf(measurement, options)),
  };
}

function featureOf(measurement: Measurement, options: SaveOptions): MeasurementFeature {
  const { id, kind, name, vertices, volume, note } = measurement;
  const values = knownValues(measurement, options);
  const columns = values.flatMap(({ name: title, quantity: { value, unit, uncertainty } }) => [
    [`${title}_${ASCII[unit]}`, value],
    [`${title}_${ASCII[unit]}_uncertainty95`, uncertainty],
  ]);
  return {
    type: "Feature",
    id,
    geometry: geometryOf(vertices, MEASUREMENT_KINDS[kind].shape),
    properties: { name, kind, ...(note && { text: note.text }), ...Object.fromEntries(columns) },
    groma: {
      kind,
      ...(volume && { volume }),
      ...(note && { note }),
      vertices: vertices.map(savedVertex),
      values: values.map(
        ({ name: title, quantity: { value, unit, uncertainty, atLeast, coverage, parts } }) => ({
          ...{ name: title, value, unit, uncertainty, atLeast, coverage, parts },
        }),
      ),
    },
  };
}

/** Units in names of columns, which database files of a GIS want in ASCII. */
const ASCII = { m: "m", "m²": "m2", "m³": "m3", rad: "rad", "1": "ratio" } as const;

/** Values of a measurement, none where its vertices have none. */
export function knownValues(measurement: Measurement, options: SaveOptions): readonly NamedValue[] {
  try {
    return options.valuesOf?.(measurement) ?? valuesOf(measurement, options);
  } catch (thrown) {
    if (thrown instanceof MeasureError) return [];
    throw thrown;
  }
}

function savedDataset({ name, identity, crs, scale }: MeasuredCloud): SavedDataset {
  const { code, wkt, proj4, height } = crs;
  const names = { name: crs.name, ...(code !== undefined && { code }), ...(wkt !== undefined && { wkt }) };
  return { name, ...(identity !== undefined && { identity }), crs: { ...names, proj4 }, height, scale };
}

function savedVertex(vertex: Vertex): SavedVertex {
  const { source, record } = vertex;
  const named = datasetNameOf(vertex);
  const { dataset, identity } = named ?? { dataset: undefined, identity: undefined };
  return {
    place: positionOf(vertex),
    ...(dataset !== undefined && { dataset }),
    ...(identity !== undefined && { identity }),
    ...(named && source && { source: [source[0], source[1], source[2]] }),
    ...(record && { node: record.node, index: record.index, integers: record.integers }),
  };
}
