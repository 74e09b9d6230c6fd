import type { Bounds, Grid } from "@groma/georef";
import type { GeoTIFF, GeoTIFFImage } from "geotiff";
import {
  checkedLattice,
  type GridImage,
  type GridKind,
  goesRound,
  type Lattice,
  nest,
  turned,
  unreadable,
} from "./grid-image.js";

const DEGREE = Math.PI / 180;
/** Radians per unit of shifts (Geodetic TIFF grids, UNITTYPE); arc-seconds where nothing is said. */
const ANGLES: ReadonlyMap<string, number> = new Map([
  ["arc-second", DEGREE / 3600],
  ["degree", DEGREE],
  ["radian", 1],
]);
const HEIGHTS = ["geoid_undulation", "vertical_offset", "hydroid_height", "ellipsoidal_height_offset"];
/** Nodes read beyond the bounds on each side. */
const MARGIN = 4;
/** Bits of NewSubfileType: a picture in lower resolution, a mask. */
const NO_GRID = 1 | 4;

/** One band of a file that is used. */
interface Band {
  readonly sample: number;
  readonly unit: number;
  /** −1 where the file counts westwards. */
  readonly sign: number;
  readonly scale: number;
  readonly offset: number;
}

/**
 * Reads the head of a Geodetic TIFF grid (PROJ, "Geodetic TIFF grids (GTG)" specification).
 *
 * @throws ProjError PROJ_GRID when it is none, or is of a kind that PROJ's hgridshift and vgridshift do not take
 */
export async function openGeoTiff(path: string, name: string, kind: GridKind): Promise<GridImage[]> {
  let tiff: GeoTIFF;
  const images: (GridImage & { parent?: string | undefined })[] = [];
  try {
    // Most conversions need no grid, and its reader is a quarter of all that would be loaded.
    const { fromFile } = await import("geotiff");
    tiff = await fromFile(path);
    const count = await tiff.getImageCount();
    let first: GeoTIFFImage | undefined;
    for (let i = 0; i < count; i++) {
      const image = await tiff.getImage(i);
      if (Number(image.fileDirectory.getValue("NewSubfileType") ?? 0) & NO_GRID) continue;
      first ??= image;
      images.push(await gridImage(image, first, name, kind));
    }
  } catch (error) {
    if (error instanceof Error && "code" in error) throw error;
    throw unreadable(
      name,
      `it is no GeoTIFF grid (${error instanceof Error ? error.message : String(error)})`,
    );
  }
  return nest(images);
}

async function gridImage(image: GeoTIFFImage, first: GeoTIFFImage, name: string, kind: GridKind) {
  const metadata = new Map(Object.entries((await image.getGDALMetadata()) ?? {}));
  const lattice = checkedLattice(name, latticeOf(image, name));
  const bands =
    kind === "vertical" ? [await verticalBand(image, first, name)] : await shiftBands(image, first, name);
  const text = (key: string) => {
    const value = metadata.get(key);
    return typeof value === "string" ? value : undefined;
  };
  return {
    ...lattice,
    name: text("grid_name") ?? "",
    parent: text("parent_grid_name"),
    children: [],
    load: (bounds: Bounds) => loadBands(image, lattice, bands, bounds, name),
  };
}

/** South-western node and steps. Where pixels are areas, nodes are their centres. */
function latticeOf(image: GeoTIFFImage, name: string): Lattice {
  const [x, y] = image.getOrigin();
  const [stepX, stepY] = image.getResolution();
  const rotation = image.fileDirectory.getValue("ModelTransformation");
  if (rotation && (Number(rotation[1]) !== 0 || Number(rotation[4]) !== 0))
    throw unreadable(name, "it is rotated");
  if (!(stepX > 0 && stepY < 0)) throw unreadable(name, "its rows do not run from north to south");
  const [columns, rows] = [image.getWidth(), image.getHeight()];
  const half = image.pixelIsArea() ? 0.5 : 0;
  return {
    west: (x + half * stepX) * DEGREE,
    south: (y + (rows - 1 + half) * stepY) * DEGREE,
    stepLongitude: stepX * DEGREE,
    stepLatitude: -stepY * DEGREE,
    columns,
    rows,
  };
}

type Tags = ReadonlyMap<string, unknown>;

/** What is said of each band; grids after the first may leave it to the first. */
async function bandTags(image: GeoTIFFImage, first: GeoTIFFImage): Promise<{ own: Tags; shared: Tags }[]> {
  const tags: { own: Tags; shared: Tags }[] = [];
  for (let sample = 0; sample < image.getSamplesPerPixel(); sample++) {
    const shared = sample < first.getSamplesPerPixel() ? await first.getGDALMetadata(sample) : null;
    const own = await image.getGDALMetadata(sample);
    tags.push({ own: new Map(Object.entries(own ?? {})), shared: new Map(Object.entries(shared ?? {})) });
  }
  return tags;
}

function tag({ own, shared }: { own: Tags; shared: Tags }, key: string): string {
  const value = own.get(key) ?? shared.get(key);
  return typeof value === "string" ? value.trim() : "";
}

async function verticalBand(image: GeoTIFFImage, first: GeoTIFFImage, name: string): Promise<Band> {
  const tags = await bandTags(image, first);
  const found = tags.findIndex((band) => HEIGHTS.includes(tag(band, "DESCRIPTION")));
  if (found < 0 && tags.some((band) => tag(band, "DESCRIPTION") !== "")) {
    throw unreadable(name, "none of its bands holds heights");
  }
  const sample = Math.max(0, found);
  const unit = tag(tags[sample], "UNITTYPE");
  if (unit !== "" && unit !== "metre") throw unreadable(name, `its heights are in ${unit}`);
  return { sample, unit: 1, sign: 1, ...scaling(tags[sample]) };
}

/** Longitude first. */
async function shiftBands(image: GeoTIFFImage, first: GeoTIFFImage, name: string): Promise<Band[]> {
  const tags = await bandTags(image, first);
  const described = tags.some((band) => tag(band, "DESCRIPTION") !== "");
  const bands = [
    { description: "longitude_offset", otherwise: 1 },
    { description: "latitude_offset", otherwise: 0 },
  ].map(({ description, otherwise }) => {
    const found = tags.findIndex((band) => tag(band, "DESCRIPTION") === description);
    const sample = found < 0 && !described ? otherwise : found;
    if (!tags[sample]) throw unreadable(name, `it has no band "${description}"`);
    const unit = ANGLES.get(tag(tags[sample], "UNITTYPE") || "arc-second");
    if (unit === undefined) throw unreadable(name, `its shifts are in ${tag(tags[sample], "UNITTYPE")}`);
    const west = description === "longitude_offset" && tag(tags[sample], "positive_value") === "west";
    return { sample, unit, sign: west ? -1 : 1, ...scaling(tags[sample]) };
  });
  if (bands[0].unit !== bands[1].unit) throw unreadable(name, "its two shifts are in different units");
  return bands;
}

function scaling(band: { own: Tags; shared: Tags }): { scale: number; offset: number } {
  const number = (key: string, otherwise: number) => Number(tag(band, key) || otherwise);
  return { scale: number("SCALE", 1), offset: number("OFFSET", 0) };
}

/** The nodes of the bounds with a margin; the rows of a grid round the earth are read whole. */
async function loadBands(
  image: GeoTIFFImage,
  lattice: Lattice,
  bands: readonly Band[],
  bounds: Bounds,
  name: string,
): Promise<Grid> {
  const { columns, rows } = lattice;
  const { west, east, south, north } = turned(lattice, bounds);
  const clip = (value: number, limit: number) => Math.max(0, Math.min(limit, value));
  const row0 = clip(Math.floor((south - lattice.south) / lattice.stepLatitude) - MARGIN, rows);
  const row1 = clip(Math.ceil((north - lattice.south) / lattice.stepLatitude) + MARGIN, rows);
  const round = goesRound(lattice);
  const column0 = round
    ? 0
    : clip(Math.floor((west - lattice.west) / lattice.stepLongitude) - MARGIN, columns);
  const column1 = round
    ? columns
    : clip(Math.ceil((east - lattice.west) / lattice.stepLongitude) + MARGIN, columns);
  const empty = row1 <= row0 || column1 <= column0;
  const rasters = empty
    ? []
    : await image.readRasters({
        samples: bands.map(({ sample }) => sample),
        window: [column0, rows - row1, column1, rows - row0],
        interleave: false,
      });
  if (!empty && rasters.length !== bands.length) throw unreadable(name, "its bands cannot be read");

  const declared = image.getGDALNoData();
  const noData = declared === null ? undefined : Math.fround(declared);
  const width = column1 - column0;
  return {
    grid: name,
    ...lattice,
    channels: bands.length,
    unit: bands[0].unit,
    ...(noData === undefined ? {} : { noData }),
    value(channel, row, column) {
      if (row < row0 || row >= row1 || column < column0 || column >= column1) return Number.NaN;
      // Rows of the file run from the north.
      const raw = Math.fround(rasters[channel][(row1 - 1 - row) * width + column - column0]);
      if (raw === noData) return raw;
      const { sign, scale, offset } = bands[channel];
      return sign * Math.fround(raw * scale + offset);
    },
  };
}
