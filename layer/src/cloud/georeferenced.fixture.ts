import {
  type Crs,
  egm96Grid,
  encodeRecord,
  type GeoreferenceRecord,
  placePoint,
  resolveCrs,
  type VerticalSystem,
} from "@groma/georef";
import { SourceError } from "../errors/index.js";
import { BlobSource } from "../sources/bytes/blob-source.js";
import { CopcSource } from "../sources/copc/copc-source.js";
import { type TinyCopc, tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import { transformationBytes } from "../workers/transformation.fixture.js";
import { georeferenceOf } from "./georeference.js";
import type { GeoreferenceOptions } from "./georeference-options.js";
import type { HeightData } from "./height-data.js";

export const UTM = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
export const resolved = resolveCrs({ file: "a", given: UTM, givenVertical: "ellipsoidal" });
export const crs: Crs = {
  ...resolved,
  name: "WGS 84 / UTM zone 32N + Flat height",
  code: "EPSG:32632+9999",
  height: { kind: "geoid", model: "Flat height", epsg: 9999 },
};
/** The box of {@link tinyCopc} in plan. */
export const DOMAIN = { minX: 0, minY: 0, maxX: 100, maxY: 100 };
export const UNDULATION = 40;

export const record: GeoreferenceRecord = {
  version: 1,
  crs,
  engine: { name: "PROJ", version: "9.5.0" },
  operation: {
    name: "Inverse of UTM zone 32N + Flat to WGS 84",
    accuracy: 0.03,
    ballpark: false,
    grids: ["flat.tif"],
    lacking: [],
    worstDifference: 1e-6,
    notes: [],
  },
  accuracy: [
    { name: "quantisation", metres: 0.005 },
    { name: "fit", metres: 0.001 },
    { name: "datum operation", metres: 0.03, note: "as published" },
    { name: "height", metres: 0.01, note: "geoid flat.tif" },
  ],
};

export const SIMILARITY = {
  // A place on the equator at longitude 0: x east, y north, z up, in half metres.
  translation: [6378137, 0, 0],
  matrix: [0, 0, 0.5, 0.5, 0, 0, 0, 0.5, 0],
} as const;

/** Height systems as a page has them, above a geoid that is as high everywhere. */
export const GLOBAL_UNDULATION = 45.25;
export const system = (code: number, name: string, size = 1, depth = false): VerticalSystem => ({
  ...{ code, name, depth, unit: { name: size === 1 ? "metre" : "foot", size } },
  ...{ area: [-180, -90, 180, 90], partners: [], countries: [] },
});
export const heightData: HeightData = {
  systems: async () => [
    system(5728, "LN02 height"),
    system(8228, "Foot height", 0.3048),
    system(5861, "LAT depth", 1, true),
    system(5773, "EGM96 height"),
    system(9999, "Flat height"),
    { ...system(5709, "NAP height"), area: [3, 50, 7, 54] },
  ],
  egm96: async () => egm96Grid(() => GLOBAL_UNDULATION),
};
/** Data that cannot be had. */
export const noHeightData: HeightData = {
  systems: () => Promise.reject(new SourceError(OFFLINE)),
  egm96: () => Promise.reject(new SourceError(OFFLINE)),
};
export const OFFLINE = { code: "SOURCE_HEIGHTS", file: "egm96.bin", cause: "it cannot be had", fix: "Look" };

export const transformation = await transformationBytes(crs, DOMAIN, UNDULATION);

export function withRecords(georeference: GeoreferenceRecord, third?: Uint8Array): TinyCopc {
  const first = ["groma", 1, encodeRecord(georeference)] as const;
  return { records: third ? [first, ["groma", 3, third]] : [first] };
}

export async function open(file: TinyCopc, options: GeoreferenceOptions = {}) {
  const source = await CopcSource.open(new BlobSource(new Blob([tinyCopc(file).slice()]), "tiny.copc.laz"));
  return georeferenceOf(source, { heightData, ...options });
}

export function placed(
  { truth }: Awaited<ReturnType<typeof open>>,
  x: number,
  y: number,
  z: number,
): number[] {
  const out = new Float64Array(3);
  placePoint(truth, x, y, z, out);
  return [...out];
}

export const distance = (a: readonly number[], b: readonly number[]) =>
  Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

export const datumNote = ({ accuracy }: Awaited<ReturnType<typeof open>>) =>
  accuracy.parts.find(({ name }) => name === "datum operation")?.note;
