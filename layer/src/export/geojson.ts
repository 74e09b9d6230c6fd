import type { ByteSink } from "./byte-sink.js";
import { attributeColumns, CoordinateText } from "./columns.js";
import { type ExportOptions, eachBatch, type PointSelection, spacingOf } from "./selection.js";
import { TextSink } from "./text-sink.js";

/** Digits of longitude and latitude: a hundredth of a millimetre. */
const ANGLE_DIGITS = 10;
const HEIGHT_DIGITS = 5;

/**
 * Writes points as a GeoJSON FeatureCollection of Points (RFC 7946), one feature a line: longitude, latitude and height
 * where every selection tells them, else source coordinates, which the file then says of itself (`coordinates`; and
 * `spacing` where points were left out), with all attributes as properties; of those
 * in full, integers beyond float64 as text. Chainage and offset come first where the selection has a line; an
 * attribute of that name gets a number (`chainage 2`).
 *
 * @returns number of points
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what the sink throws
 */
export async function exportGeoJson(
  selections: readonly PointSelection[],
  sink: ByteSink,
  options: ExportOptions = {},
): Promise<number> {
  const text = new TextSink(sink);
  // RFC 7946 knows no other coordinates than WGS 84: whoever reads these must know that they are none.
  const placed = selections.every(({ geodetic }) => geodetic !== undefined);
  const what = placed ? "" : `"coordinates":"source",`;
  const spacing = spacingOf(selections);
  const thinned = spacing > 0 ? `"spacing":${spacing},` : "";
  text.add(`{"type":"FeatureCollection",${what}${thinned}"features":[`);
  const own = selections.some(({ along }) => along !== undefined) ? ["chainage", "offset"] : [];
  const place = new Float64Array(3);
  let separator = "\n";
  const count = await eachBatch(selections, options, async (batch, wanted, { origin, along, geodetic }) => {
    const columns = attributeColumns(batch, own).map((column) => ({
      column,
      key: JSON.stringify(column.name),
    }));
    const coordinates = new CoordinateText(origin);
    const { xyz } = batch.records;
    for (const point of wanted) {
      const at = 3 * point;
      const [x, y, z] = [0, 1, 2].map((axis) => coordinates.value(xyz[at + axis], axis));
      let position: string;
      if (placed && geodetic) {
        geodetic(x, y, z, place);
        const angles = `${place[0].toFixed(ANGLE_DIGITS)},${place[1].toFixed(ANGLE_DIGITS)}`;
        position = `${angles},${place[2].toFixed(HEIGHT_DIGITS)}`;
      } else {
        position = [0, 1, 2].map((axis) => coordinates.of(xyz[at + axis], axis)).join(",");
      }
      const properties: string[] = [];
      if (along) {
        along.locate(x, y, place, z);
        properties.push(`"chainage":${number(place[0])}`, `"offset":${number(place[1])}`);
      }
      for (const { column, key } of columns) {
        const value = column.of(batch, point);
        properties.push(`${key}:${jsonValue(value)}`);
      }
      const geometry = `{"type":"Point","coordinates":[${position}]}`;
      text.add(
        `${separator}{"type":"Feature","geometry":${geometry},"properties":{${properties.join(",")}}}`,
      );
      separator = ",\n";
    }
    await text.rest();
  });
  text.add("\n]}\n");
  await text.end();
  return count;
}

/** JSON of a value that stands as text: a number where float64 holds it. */
function jsonValue(text: string): string {
  if (text === "") return "null";
  return /^-?\d+$/.test(text) && !Number.isSafeInteger(Number(text)) ? `"${text}"` : text;
}

function number(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toFixed(5))) : "null";
}
