import { readFile } from "node:fs/promises";
import { checkedLattice, type GridImage, unreadable } from "./grid-image.js";

const DEGREE = Math.PI / 180;
const HEADER = 40;
/** What GTX files have where nothing is known; PROJ takes everything beyond 1000 m for it too. */
const NO_DATA = Math.fround(-88.8888);
const HEIGHT_MAX = 1000;

/**
 * Reads a GTX grid of heights (NOAA VDatum): big-endian south, west, steps (degrees, float64), rows, columns (int32),
 * then float32 metres from the south-west, row by row.
 *
 * @throws ProjError PROJ_GRID
 */
export async function openGtx(path: string, name: string): Promise<GridImage[]> {
  const bytes = await readFile(path);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < HEADER) throw unreadable(name, "it is no GTX grid");
  const degrees = (offset: number) => view.getFloat64(offset) * DEGREE;
  const lattice = checkedLattice(name, {
    south: degrees(0),
    west: degrees(8),
    stepLatitude: degrees(16),
    stepLongitude: degrees(24),
    rows: view.getInt32(32),
    columns: view.getInt32(36),
  });
  const { rows, columns } = lattice;
  if (bytes.length < HEADER + 4 * rows * columns) throw unreadable(name, "it ends too early");
  const value = (_channel: number, row: number, column: number) => {
    const height = view.getFloat32(HEADER + 4 * (row * columns + column));
    return Math.abs(height) <= HEIGHT_MAX ? height : NO_DATA;
  };
  const grid = { grid: name, ...lattice, channels: 1, unit: 1, noData: NO_DATA, value };
  return [{ ...lattice, name: "", children: [], load: async () => grid }];
}
