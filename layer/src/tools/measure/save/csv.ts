import type { Measurement } from "../measurement/measurement.js";
import { datasetNameOf } from "../vertex/vertex.js";
import { knownValues, type SaveOptions } from "./write.js";

const COLUMNS = "measurement,kind,value_name,value,unit,uncertainty95,at_least,unknown_parts,id";
const VERTEX_COLUMNS =
  "measurement,kind,vertex,longitude_deg,latitude_deg,height_m,dataset,node,record,x_integer,y_integer,z_integer,x,y,z,dataset_identity,id";

/** A row for each value of each measurement, SI and radians (RFC 4180). An uncertainty that is unknown is empty. */
export function valuesToCsv(measurements: readonly Measurement[], options: SaveOptions = {}): string {
  const rows = measurements.flatMap((measurement) =>
    knownValues(measurement, options).map(
      ({ name, quantity: { value, unit, uncertainty, atLeast, parts } }) => {
        const unknown = parts.flatMap((part) => (part.standard === null ? part.name : [])).join("; ");
        return [
          measurement.name,
          measurement.kind,
          name,
          value,
          unit,
          uncertainty,
          atLeast,
          unknown,
          measurement.id,
        ];
      },
    ),
  );
  return table(COLUMNS, rows);
}

/** A row for each vertex of each measurement, with the record that it stands on. */
export function verticesToCsv(measurements: readonly Measurement[]): string {
  const rows = measurements.flatMap(({ id, name, kind, vertices }) =>
    vertices.map((vertex, i) => {
      const { longitude, latitude, height, record, source } = vertex;
      const named = datasetNameOf(vertex);
      return [
        ...[name, kind, i + 1, (longitude * 180) / Math.PI, (latitude * 180) / Math.PI, height],
        ...[named?.dataset, record?.node, record?.index],
        ...(record?.integers ?? EMPTY),
        ...(source ?? EMPTY),
        ...[named?.identity, id],
      ];
    }),
  );
  return table(VERTEX_COLUMNS, rows);
}

const EMPTY = [undefined, undefined, undefined];

function table(columns: string, rows: readonly (readonly (string | number | null | undefined)[])[]): string {
  return [columns, ...rows.map((row) => row.map(field).join(","))].map((row) => `${row}\r\n`).join("");
}

function field(value: string | number | null | undefined): string {
  if (value === null || value === undefined) return "";
  if (typeof value === "number") return String(value);
  // A name that a spreadsheet would take for a formula is kept a name.
  const text = /^[=+\-@\t\r]/.test(value) ? `'${value}` : value;
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
