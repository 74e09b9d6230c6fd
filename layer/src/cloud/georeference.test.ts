import {
  type Crs,
  ENGINE,
  encodeRecord,
  type GeoreferenceRecord,
  placePoint,
  resolveCrs,
} from "@groma/georef";
import { beforeAll, describe, expect, it } from "vitest";
import { BlobSource, openCopc } from "../sources/index.js";
import { type TinyCopc, tinyCopc } from "../sources/tiny-copc.fixture.js";
import { transformationBytes } from "../workers/transformation.fixture.js";
import { type GeoreferenceOptions, georeferenceOf } from "./georeference.js";

const UTM = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
const resolved = resolveCrs({ file: "a", given: UTM, givenVertical: "ellipsoidal" });
const crs: Crs = {
  ...resolved,
  name: "WGS 84 / UTM zone 32N + Flat height",
  code: "EPSG:32632+9999",
  height: { kind: "geoid", model: "Flat height", epsg: 9999 },
};
/** The box of {@link tinyCopc} in plan. */
const DOMAIN = { minX: 0, minY: 0, maxX: 100, maxY: 100 };
const UNDULATION = 40;

const record: GeoreferenceRecord = {
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

const SIMILARITY = {
  // A place on the equator at longitude 0: x east, y north, z up, in half metres.
  translation: [6378137, 0, 0],
  matrix: [0, 0, 0.5, 0.5, 0, 0, 0, 0.5, 0],
} as const;

let transformation: Uint8Array;

beforeAll(async () => {
  transformation = await transformationBytes(crs, DOMAIN, UNDULATION);
});

function withRecords(georeference: GeoreferenceRecord, third?: Uint8Array): TinyCopc {
  const first = ["groma", 1, encodeRecord(georeference)] as const;
  return { records: third ? [first, ["groma", 3, third]] : [first] };
}

async function open(file: TinyCopc, options: GeoreferenceOptions = {}) {
  const copc = await openCopc(new BlobSource(new Blob([tinyCopc(file).slice()]), "tiny.copc.laz"));
  return georeferenceOf(copc, options);
}

function placed({ truth }: Awaited<ReturnType<typeof open>>, x: number, y: number, z: number): number[] {
  const out = new Float64Array(3);
  placePoint(truth, x, y, z, out);
  return [...out];
}

const distance = (a: readonly number[], b: readonly number[]) =>
  Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

const datumNote = ({ accuracy }: Awaited<ReturnType<typeof open>>) =>
  accuracy.parts.find(({ name }) => name === "datum operation")?.note;

describe("georeferenceOf a file with a transformation", () => {
  it("places by it, geoid included", async () => {
    const georeference = await open(withRecords(record, transformation));
    const ellipsoidal = await open({}, { crs: UTM, vertical: "ellipsoidal" });
    const at = placed(georeference, 30, 70, 5);
    expect(distance(at, placed(ellipsoidal, 30, 70, 5 + UNDULATION))).toBeLessThan(1e-4);
    expect(georeference).toMatchObject({
      ...{ basis: "record", engine: record.engine, operation: record.operation, geoids: ["flat.tif"] },
      sources: { transformation },
    });
    expect(georeference.accuracy.total).toBeCloseTo(0.046, 12);
  });

  it("has no place outside what it was made for", async () => {
    const { truth } = await open(withRecords(record, transformation));
    expect(() => placePoint(truth, 101, 50, 0, new Float64Array(3))).toThrow(
      expect.objectContaining({ code: "PLACE_DOMAIN" }),
    );
  });

  it.each<[string, GeoreferenceOptions]>([
    ["a coordinate system", { crs: UTM, vertical: "ellipsoidal" }],
    ["a height reference", { vertical: "ellipsoidal" }],
  ])("leaves it where the user gives %s, and says so", async (_, options) => {
    const georeference = await open(withRecords(record, transformation), options);
    const ellipsoidal = await open({}, { crs: UTM, vertical: "ellipsoidal" });
    expect(distance(placed(georeference, 30, 70, 5), placed(ellipsoidal, 30, 70, 5))).toBe(0);
    expect(georeference).toMatchObject({
      ...{ basis: "given", engine: ENGINE, operation: undefined, geoids: [] },
      crs: { height: { kind: "ellipsoidal" } },
    });
    expect(georeference.sources.transformation).toBeUndefined();
    expect(datumNote(georeference)).toMatch(/given by the user; the transformation .* is not used/);
  });

  it("keeps the horizontal part and its name where only the height reference is given", async () => {
    const { crs: other } = await open(withRecords(record, transformation), { vertical: "ellipsoidal" });
    expect(other).toMatchObject({
      name: "WGS 84 / UTM zone 32N + ellipsoidal height",
      code: "EPSG:32632",
      proj4: crs.proj4,
      verticalUnit: crs.verticalUnit,
    });
  });

  it("takes the unit of a height system that brings its own", async () => {
    const feet = `VERT_CS["Foot height",VERT_DATUM["Foot datum",2005],UNIT["foot",0.3048],AXIS["Up",UP]]`;
    const epsg = () => ({ name: "Foot height", wkt: feet, kind: "CRS-VERTCRS" });
    const { crs: other, accuracy } = await open(withRecords(record, transformation), {
      vertical: "EPSG:8228",
      epsg,
    });
    expect(other).toMatchObject({ height: { kind: "geoid", epsg: 8228 }, verticalUnit: { size: 0.3048 } });
    expect(accuracy.total).toBeNull();
  });

  it("CRS_UNKNOWN for a code without a table of codes", async () => {
    await expect(open(withRecords(record, transformation), { vertical: "EPSG:5728" })).rejects.toThrow(
      expect.objectContaining({ code: "CRS_UNKNOWN" }),
    );
  });

  it("does without where a tool has lost it, and claims nothing of what it was worth", async () => {
    const georeference = await open(withRecords(record));
    expect(georeference).toMatchObject({ basis: "record", engine: ENGINE, operation: undefined, geoids: [] });
    expect(georeference.accuracy.total).toBeNull();
    expect(datumNote(georeference)).toContain("no longer in the file");
  });

  it("states what float32 costs in nodes that are wider than the tolerance allows", async () => {
    const fit = ({ accuracy }: Awaited<ReturnType<typeof open>>) =>
      accuracy.parts.find(({ name }) => name === "fit")?.metres;
    expect(fit(await open({}, { crs: UTM }))).toBe(0.001);
    expect(fit(await open({}, { crs: UTM, tolerance: 1e-8 }))).toBeGreaterThan(1e-7);
    await expect(open({}, { crs: UTM, tolerance: 0 })).rejects.toThrow(
      expect.objectContaining({ code: "PLACE_TOLERANCE" }),
    );
  });

  it("takes none of it without the record that it belongs to", async () => {
    await expect(open({ records: [["groma", 3, transformation]] })).rejects.toThrow(
      expect.objectContaining({ code: "CRS_MISSING" }),
    );
  });
});

describe("georeferenceOf a file with a transformation that is damaged", () => {
  const changed = (at: number, ...bytes: number[]) => {
    const copy = transformation.slice();
    copy.set(bytes, at);
    return copy;
  };

  it.each<[string, string, () => Uint8Array]>([
    ["RECORD_TRUNCATED", "it is cut", () => transformation.slice(0, -5)],
    ["RECORD_TRUNCATED", "it is cut after its version", () => transformation.slice(0, 5)],
    ["RECORD_VERSION", "it is of a later version", () => changed(4, 2)],
    ["RECORD_INVALID", "it is something else", () => changed(0, 0x7b)],
    ["RECORD_TRUNCATED", "it claims more patches than it has bytes for", () => changed(15, 0xff, 0xff)],
    ["RECORD_INVALID", "it goes on after its end", () => Uint8Array.of(...transformation, 0)],
  ])("%s: %s; opens with the coordinate system given", async (code, _, bytes) => {
    const file = withRecords(record, bytes());
    await expect(open(file)).rejects.toThrow(expect.objectContaining({ code, name: "RecordError" }));
    expect((await open(file, { crs: UTM })).basis).toBe("given");
  });
});

describe("georeferenceOf a file that was placed as a body", () => {
  const body: GeoreferenceRecord = {
    version: 1,
    crs: { ...resolved, name: "no coordinate system" },
    engine: { name: "similarity", version: "0.1.0" },
    similarity: SIMILARITY,
    accuracy: [{ name: "anchor", metres: null, note: "given by the user" }],
  };

  it("places by the similarity", async () => {
    const georeference = await open(withRecords(body));
    expect(placed(georeference, 10, 20, 30)).toEqual([6378152, 5, 10]);
    expect(georeference).toMatchObject({
      engine: { name: "similarity" },
      sources: { similarity: SIMILARITY },
    });
  });

  it("CRS_UNSUPPORTED for another height reference; another coordinate system overrules it", async () => {
    await expect(open(withRecords(body), { vertical: "ellipsoidal" })).rejects.toThrow(
      expect.objectContaining({ code: "CRS_UNSUPPORTED" }),
    );
    const georeference = await open(withRecords(body), { crs: UTM });
    expect([georeference.basis, georeference.engine.name]).toEqual(["given", "proj4js"]);
  });

  it("RECORD_FIELD where the record has no similarity", async () => {
    const { similarity: _, ...rest } = body;
    await expect(open(withRecords(rest))).rejects.toThrow(expect.objectContaining({ code: "RECORD_FIELD" }));
  });
});
