import type { ByteSink } from "./byte-sink.js";
import { attributeColumns, CoordinateText, type TextColumn } from "./columns.js";
import { type ExportOptions, eachBatch, type PointSelection, spacingOf } from "./selection.js";
import { areInOneSystem, crsOf } from "./systems.js";
import { TextSink } from "./text-sink.js";

/** How CSV is written. */
export interface CsvOptions extends ExportOptions {
  /** Whether a column `crs` names the system of each point's coordinates. Default: where there are several. */
  readonly systems?: boolean | undefined;
}

/** Digits of chainage and offset: a hundredth of a millimetre in metres. */
const ALONG_DIGITS = 5;

/**
 * Writes points as CSV (RFC 4180, UTF-8, lines end in CR LF): x, y and z with every digit of the record, chainage and
 * offset where the selection has a line, then all attributes in full, by their names. An attribute that is called as one of those gets a number (`chainage 2`). Of several data sets the columns
 * are those of the first with points; what another does not have stays empty. Where their
 * coordinates are of several systems, a column `crs` behind those names the system of each point. Where points were left out, the last column
 * says at which spacing.
 *
 * @returns number of points
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what the sink throws
 */
export async function exportCsv(
  selections: readonly PointSelection[],
  sink: ByteSink,
  options: CsvOptions = {},
): Promise<number> {
  const { systems = !areInOneSystem(selections) } = options;
  const text = new TextSink(sink);
  const withLine = selections.some(({ along }) => along !== undefined);
  const spacing = spacingOf(selections);
  const front = ["x", "y", "z", ...(withLine ? ["chainage", "offset"] : []), ...(systems ? ["crs"] : [])];
  const back = spacing > 0 ? ["spacing"] : [];
  const place = new Float64Array(2);
  let names: readonly string[] | undefined;
  const count = await eachBatch(selections, options, async (batch, wanted, selection) => {
    const { origin, along } = selection;
    const system = systems ? `,${quoted(crsOf(selection)?.name ?? "")}` : "";
    const found = attributeColumns(batch, [...front, ...back]);
    if (!names) {
      names = found.map(({ name }) => name);
      text.add(`${[...front, ...names, ...back].map(quoted).join(",")}\r\n`);
    }
    const columns = names.map((name) => found.find((column) => column.name === name));
    const coordinates = new CoordinateText(origin);
    const { xyz } = batch.records;
    for (const point of wanted) {
      const at = 3 * point;
      let row = `${coordinates.of(xyz[at], 0)},${coordinates.of(xyz[at + 1], 1)},${coordinates.of(xyz[at + 2], 2)}`;
      if (withLine) {
        place.fill(Number.NaN);
        const [px, py, pz] = [0, 1, 2].map((axis) => coordinates.value(xyz[at + axis], axis));
        along?.locate(px, py, place, pz);
        row += `,${alongText(place[0])},${alongText(place[1])}`;
      }
      text.add(`${row}${system}${valuesText(columns, batch, point)}${spacing > 0 ? `,${spacing}` : ""}\r\n`);
    }
    await text.rest();
  });
  await text.end();
  return count;
}

function valuesText(
  columns: readonly (TextColumn | undefined)[],
  batch: Parameters<TextColumn["of"]>[0],
  point: number,
): string {
  let values = "";
  for (const column of columns) values += `,${column?.of(batch, point) ?? ""}`;
  return values;
}

function alongText(value: number): string {
  return Number.isNaN(value) ? "" : value.toFixed(ALONG_DIGITS);
}

/** A name that a table program takes as text, whatever a file calls its attributes. */
function quoted(name: string): string {
  const safe = /^[=+\-@\t\r]/.test(name) ? `'${name}` : name;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}
