import { requireFields, requireKind } from "../errors/arguments.js";
import { RecordError } from "../errors/errors.js";
import { type Bounds, cutWindow, type Grid } from "../grid/window.js";
import { ByteReader, ByteWriter } from "../transformation/bytes.js";
import { readGridValues, writeGridValues } from "../transformation/grid-values.js";
import type { VerticalShiftStep } from "../transformation/step.js";
import { undulationOf } from "./undulation.js";

/** Name of the global geoid model where it is applied in place of a country's own. */
export const EGM96 = "EGM96";

/** Between the nodes of EGM96, radians: a quarter of a degree. */
const STEP = Math.PI / 720;
const COLUMNS = 1440;
const ROWS = 721;

/**
 * The geoid model EGM96 (NGA, 15' × 15') as a grid round the earth, its nodes rounded to a centimetre.
 *
 * @param value undulation at a node, metres: rows from the south pole, columns from 180° west
 */
export function egm96Grid(value: (row: number, column: number) => number): Grid {
  return {
    grid: EGM96,
    west: -Math.PI,
    south: -Math.PI / 2,
    stepLongitude: STEP,
    stepLatitude: STEP,
    columns: COLUMNS,
    rows: ROWS,
    channels: 1,
    unit: 1,
    value: (_channel, row, column) => Math.fround(Math.round(100 * value(row, column)) / 100),
  };
}

/** Rows that are stored together: a place needs one or two such bands, decoded in about a millisecond. */
const BAND_ROWS = 8;
const BANDS = Math.ceil(ROWS / BAND_ROWS);
const MAGIC = [0x47, 0x45, 0x47, 0x4d];
const VERSION = 1;

const rowsOf = (band: number) => Math.min(BAND_ROWS, ROWS - band * BAND_ROWS);
const shapeOf = (band: number) => ({ columns: COLUMNS, rows: rowsOf(band), channels: 1 });

/**
 * EGM96 as a file of about a megabyte: `GEGM`, u8 version, a u32 length per band of 8 rows, then the bands, stored
 * as the values of a window are (docs/transformation.md).
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function encodeEgm96(grid: Grid): Uint8Array {
  requireFields(grid, { value: "function" }, "encodeEgm96: grid");
  const { value } = grid;
  const bands = Array.from({ length: BANDS }, (_, band) => {
    const values = Float32Array.from({ length: COLUMNS * rowsOf(band) }, (_, i) =>
      value(0, band * BAND_ROWS + Math.floor(i / COLUMNS), i % COLUMNS),
    );
    const writer = new ByteWriter();
    writeGridValues(writer, values, shapeOf(band));
    return writer.finish();
  });
  const writer = new ByteWriter();
  for (const byte of MAGIC) writer.u8(byte);
  writer.u8(VERSION);
  for (const { length } of bands) writer.u32(length);
  for (const bytes of bands) writer.raw(bytes);
  return writer.finish();
}

/**
 * The grid that {@link encodeEgm96} wrote; bands are decoded when they are first asked for.
 *
 * @param file name for error messages
 * @throws RecordError RECORD_INVALID, RECORD_VERSION, RECORD_TRUNCATED; of a band when it is first asked for
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function decodeEgm96(bytes: Uint8Array, file: string): Grid {
  requireKind(bytes, "bytes", "decodeEgm96: bytes");
  const header = new ByteReader(bytes, file);
  header.check(
    MAGIC.every((byte) => header.u8() === byte),
    "a geoid that does not start as one",
  );
  const version = header.u8();
  if (version !== VERSION) throw unknownVersion(file, version);
  const ends = new Float64Array(BANDS);
  for (let band = 0; band < BANDS; band++) ends[band] = (band > 0 ? ends[band - 1] : 0) + header.u32();
  header.require(ends[BANDS - 1]);
  const start = bytes.length - header.remaining;
  const decoded: (Float32Array | undefined)[] = [];
  const bandOf = (band: number): Float32Array => {
    const from = start + (band > 0 ? ends[band - 1] : 0);
    const reader = new ByteReader(bytes.subarray(from, start + ends[band]), file);
    return readGridValues(reader, shapeOf(band));
  };
  return egm96Grid((row, column) => {
    const band = Math.floor(row / BAND_ROWS);
    decoded[band] ??= bandOf(band);
    return decoded[band][(row - band * BAND_ROWS) * COLUMNS + column];
  });
}

function unknownVersion(file: string, version: number): RecordError {
  return new RecordError({
    code: "RECORD_VERSION",
    file,
    cause: `its geoid is of version ${version}, known is ${VERSION}`,
    fix: "put the files of one version of Groma together",
  });
}

/** The step that makes ellipsoidal heights of heights above EGM96. */
export function egm96Step(egm96: Grid, bounds: Bounds): VerticalShiftStep {
  return { kind: "verticalShift", multiplier: 1, window: cutWindow(egm96, bounds) };
}

/** Height of EGM96 above the ellipsoid, metres. @param longitude radians, any turn @param latitude radians */
export function egm96Undulation(egm96: Grid, longitude: number, latitude: number): number {
  if (!Number.isFinite(longitude + latitude)) return Number.NaN;
  const place = { west: longitude, south: latitude, east: longitude, north: latitude };
  return undulationOf(cutWindow(egm96, place))(longitude, latitude);
}
