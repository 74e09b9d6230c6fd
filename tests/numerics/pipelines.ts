import {
  type Bounds,
  cutWindow,
  ellipsoid,
  fitPatchwork,
  type Grid,
  type ProjectionSampler,
  type Rectangle,
  type Step,
  type Transformation,
  WGS84,
} from "@groma/georef";
import { fromFile } from "geotiff";
import { BESSEL, samplerOf } from "../../georef/src/transformation/sampler.fixture.js";
import { data } from "../project.js";

const GRS80 = ellipsoid(6378137, 1 / 298.257222101);
const ARC_SECOND = Math.PI / 648000;

/** The pipelines that PROJ 9.5 gives for three compound CRSs, as far as the grids of the data folder go. */
export const PIPELINES = {
  "EPSG:7415": {
    projection:
      "+proj=sterea +lat_0=52.1561605555556 +lon_0=5.38763888888889 +k=0.9999079 +x_0=155000 +y_0=463000 +ellps=bessel",
    horizontal: "nl_nsgi_rdtrans2018.tif",
    vertical: "nl_nsgi_nlgeo2018.tif",
    truth: "grid_rd_nap.json",
  },
  "EPSG:2056+5728": {
    projection:
      "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +k_0=1 +x_0=2600000 +y_0=1200000 +ellps=bessel",
    horizontal: undefined,
    vertical: "ch_swisstopo_chgeo2004_ETRS89_LN02.tif",
    truth: "grid_lv95_ln02.json",
  },
  "EPSG:21781+5728": {
    projection:
      "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +k_0=1 +x_0=600000 +y_0=200000 +ellps=bessel",
    horizontal: undefined,
    vertical: "ch_swisstopo_chgeo2004_ETRS89_LN02.tif",
    truth: "grid_lv03_ln02.json",
  },
} as const;

export type PipelineName = keyof typeof PIPELINES;

/** The files that a pipeline needs, and why its tests are skipped if one is not there. */
export function missingFor(name: PipelineName): string | undefined {
  const { horizontal, vertical, truth } = PIPELINES[name];
  const files = [`grids/${vertical}`, `truth/${truth}`, ...(horizontal ? [`grids/${horizontal}`] : [])];
  return files.map((file) => data(file).missing).find((missing) => missing !== undefined);
}

/** A grid file with PixelIsPoint rows from the north: heights in metres, or shifts (latitude first) in arc seconds. */
export async function openGrid(name: string): Promise<Grid> {
  const file = await fromFile(data(`grids/${name}`).path);
  // A nested grid stands after its parent and is the finer one.
  const image = await file.getImage((await file.getImageCount()) - 1);
  const rasters = (await image.readRasters()) as unknown as Float32Array[];
  const horizontal = image.getSamplesPerPixel() > 1;
  const bands = horizontal ? [rasters[1], rasters[0]] : [rasters[0]];
  const [columns, rows] = [image.getWidth(), image.getHeight()];
  const [west, north] = image.getOrigin();
  const [stepLongitude, stepLatitude] = image.getResolution().map((step) => (Math.abs(step) * Math.PI) / 180);
  return {
    grid: name,
    west: (west * Math.PI) / 180,
    south: (north * Math.PI) / 180 - (rows - 1) * stepLatitude,
    stepLongitude,
    stepLatitude,
    columns,
    rows,
    channels: bands.length,
    unit: horizontal ? ARC_SECOND : 1,
    value: (channel, row, column) => bands[channel][(rows - 1 - row) * columns + column],
  };
}

/** The pipeline of a compound CRS over a rectangle of source coordinates, windows cut. */
export async function pipeline(name: PipelineName, domain: Rectangle): Promise<Transformation> {
  const { projection, horizontal, vertical } = PIPELINES[name];
  const sample = samplerOf(projection);
  const patchwork = await fitPatchwork(sample, domain, undefined, BESSEL, name);
  const bounds = await boundsOf(sample, domain);
  const shift: Step = horizontal
    ? { kind: "horizontalShift", direction: "forward", window: cutWindow(await openGrid(horizontal), bounds) }
    : {
        kind: "datumShift",
        from: BESSEL,
        to: GRS80,
        translation: [674.374, 15.056, 405.346],
        matrix: [1, 0, 0, 0, 1, 0, 0, 0, 1],
        keepHeight: true,
      };
  return {
    steps: [
      { kind: "projection", patchwork },
      shift,
      { kind: "verticalShift", multiplier: 1, window: cutWindow(await openGrid(vertical), bounds) },
      { kind: "geocentric", ellipsoid: WGS84 },
    ],
  };
}

/** Geodetic bounds of a rectangle, wide enough for a datum shift of 300 m. */
async function boundsOf(sample: ProjectionSampler, { minX, minY, maxX, maxY }: Rectangle): Promise<Bounds> {
  const points: number[] = [];
  for (let i = 0; i <= 10; i++) {
    for (let j = 0; j <= 10; j++) {
      points.push(minX + ((maxX - minX) * i) / 10, minY + ((maxY - minY) * j) / 10);
    }
  }
  const places = await sample(Float64Array.from(points));
  const longitudes = places.filter((_, i) => i % 2 === 0);
  const latitudes = places.filter((_, i) => i % 2 === 1);
  return {
    west: Math.min(...longitudes) - 1e-4,
    south: Math.min(...latitudes) - 1e-4,
    east: Math.max(...longitudes) + 1e-4,
    north: Math.max(...latitudes) + 1e-4,
  };
}
