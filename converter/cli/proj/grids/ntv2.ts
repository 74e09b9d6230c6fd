import { readFile } from "node:fs/promises";
import { checkedLattice, type GridImage, nest, unreadable } from "./grid-image.js";

const ARC_SECOND = Math.PI / 648_000;
/** Bytes of a record, and records of the two kinds of header. */
const RECORD = 16;
const RECORDS = 11;

/**
 * Reads an NTv2 grid of shifts (Geodetic Survey of Canada, NTv2 developer's guide): arc-seconds, longitude counted
 * westwards, nodes from the south-east to the west, row by row. Either byte order.
 *
 * @throws ProjError PROJ_GRID
 */
export async function openNtv2(path: string, name: string): Promise<GridImage[]> {
  const bytes = await readFile(path);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const header = RECORD * RECORDS;
  if (bytes.length < 2 * header) throw unreadable(name, "it ends too early");
  const little = view.getInt32(8, true) === RECORDS;
  if (!little && view.getInt32(8, false) !== RECORDS) throw unreadable(name, "it is no NTv2 grid");
  const text = (offset: number) => bytes.toString("latin1", offset, offset + 8).trim();
  const unit = text(RECORD * 3 + 8);
  if (unit !== "SECONDS") throw unreadable(name, `its shifts are in "${unit}"`);

  const images: (GridImage & { parent: string })[] = [];
  const count = view.getInt32(RECORD * 2 + 8, little);
  let at = header;
  for (let i = 0; i < count; i++) {
    if (at + header > bytes.length) throw unreadable(name, "it ends too early");
    const seconds = (record: number) => view.getFloat64(at + RECORD * record + 8, little);
    const [south, north, east, west, stepLatitude, stepLongitude] = [4, 5, 6, 7, 8, 9].map(seconds);
    const columns = Math.round((west - east) / stepLongitude) + 1;
    const rows = Math.round((north - south) / stepLatitude) + 1;
    const lattice = checkedLattice(name, {
      west: -west * ARC_SECOND,
      south: south * ARC_SECOND,
      stepLongitude: stepLongitude * ARC_SECOND,
      stepLatitude: stepLatitude * ARC_SECOND,
      columns,
      rows,
    });
    const nodes = at + header;
    at = nodes + RECORD * rows * columns;
    if (view.getInt32(nodes - RECORD + 8, little) !== rows * columns || at > bytes.length) {
      throw unreadable(name, "its number of nodes does not fit its bounds");
    }
    const value = (channel: number, row: number, column: number) => {
      const node = nodes + RECORD * (row * columns + columns - 1 - column);
      return channel === 0 ? -view.getFloat32(node + 4, little) : view.getFloat32(node, little);
    };
    const grid = { grid: name, ...lattice, channels: 2, unit: ARC_SECOND, value };
    const own = nodes - header;
    images.push({
      ...lattice,
      name: text(own + 8),
      parent: text(own + RECORD + 8),
      children: [],
      load: async () => grid,
    });
  }
  return nest(images);
}
