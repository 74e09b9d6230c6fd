import {
  type Crs,
  type DataSetIdentity,
  EGM96,
  EGM96_ACCURACY,
  ENGINE,
  egm96Grid,
  encodeRecord,
  encodeRecordFile,
  type GeoreferenceRecord,
  packEpsg,
  placePoint,
  resolveCrs,
  type VerticalSystem,
} from "@groma/georef";
import { beforeAll, describe, expect, it } from "vitest";
import { SourceError } from "../errors/index.js";
import { BlobSource } from "../sources/bytes/blob-source.js";
import { CopcSource } from "../sources/copc/copc-source.js";
import { type TinyCopc, tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import { transformationBytes } from "../workers/transformation.fixture.js";
import { type GeoreferenceOptions, georeferenceOf } from "./georeference.js";
import type { HeightData } from "./height-data.js";

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

/** Height systems as a page has them, above a geoid that is as high everywhere. */
const GLOBAL_UNDULATION = 45.25;
const system = (code: number, name: string, size = 1, depth = false): VerticalSystem => ({
  ...{ code, name, depth, unit: { name: size === 1 ? "metre" : "foot", size } },
  ...{ area: [-180, -90, 180, 90], partners: [], countries: [] },
});
const heightData: HeightData = {
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
const noHeightData: HeightData = {
  systems: () => Promise.reject(new SourceError(OFFLINE)),
  egm96: () => Promise.reject(new SourceError(OFFLINE)),
};
const OFFLINE = { code: "SOURCE_HEIGHTS", file: "egm96.bin", cause: "it cannot be had", fix: "Look" };

let transformation: Uint8Array;

beforeAll(async () => {
  transformation = await transformationBytes(crs, DOMAIN, UNDULATION);
});

function withRecords(georeference: GeoreferenceRecord, third?: Uint8Array): TinyCopc {
  const first = ["groma", 1, encodeRecord(georeference)] as const;
  return { records: third ? [first, ["groma", 3, third]] : [first] };
}

async function open(file: TinyCopc, options: GeoreferenceOptions = {}) {
  const source = await CopcSource.open(new BlobSource(new Blob([tinyCopc(file).slice()]), "tiny.copc.laz"));
  return georeferenceOf(source, { heightData, ...options });
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

describe("georeferenceOf a file with a georeference that the application gives", () => {
  let of: DataSetIdentity;
  const given = () => encodeRecordFile({ of, record, transformation });

  beforeAll(async () => {
    const blob = new Blob([tinyCopc({}).slice()]);
    const {
      pointCount: points,
      scale,
      offset,
      boundingBox,
    } = await CopcSource.open(new BlobSource(blob, "a"));
    of = { points, scale, offset, ...boundingBox };
  });

  /** A file that declares another system; what is given goes before it. */
  const foreign: TinyCopc = { records: [["LASF_Projection", 2112, new TextEncoder().encode("EPSG:2056")]] };

  it("places by it as if the file carried it, whatever the file declares", async () => {
    const own = await open(withRecords(record, transformation));
    const bytes = given();
    for (const [file, from] of [
      [{}, bytes],
      [foreign, new Blob([bytes.slice()])],
      [withRecords({ ...record, similarity: SIMILARITY }), bytes],
    ] as const) {
      const beside = await open(file, { transformation: from });
      expect(placed(beside, 30, 70, 5)).toEqual(placed(own, 30, 70, 5));
      expect(beside).toMatchObject({
        ...{ basis: "record", engine: record.engine, operation: record.operation, geoids: ["flat.tif"] },
        accuracy: own.accuracy,
      });
    }
  });

  it("leaves it where the application names the system, and keeps its plane where it gives heights", async () => {
    const named = await open({}, { transformation: given(), crs: UTM, vertical: "ellipsoidal" });
    expect([named.basis, named.engine.name]).toEqual(["given", "proj4js"]);
    const heights = await open({}, { transformation: given(), vertical: "ellipsoidal" });
    expect([heights.basis, heights.engine.name, heights.geoids]).toEqual(["given", "PROJ", []]);
  });

  it("RECORD_OTHER for that of another file, RECORD_* for what is none", async () => {
    const other = encodeRecordFile({ of: { ...of, points: of.points + 1 }, record, transformation });
    await expect(open({}, { transformation: other })).rejects.toMatchObject({
      ...{ code: "RECORD_OTHER", file: "tiny.copc.laz" },
    });
    await expect(open({}, { transformation: Uint8Array.of(1) })).rejects.toMatchObject({
      code: "RECORD_JSON",
    });
  });
});

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

  it("leaves it where the user gives a coordinate system, and says so", async () => {
    const georeference = await open(withRecords(record, transformation), {
      crs: UTM,
      vertical: "ellipsoidal",
    });
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

  it.each<[string, string, number, number]>([
    ["ellipsoidal", "WGS 84 / UTM zone 32N + ellipsoidal height", 0, 1],
    ["EPSG:5728", "WGS 84 / UTM zone 32N + LN02 height", GLOBAL_UNDULATION, 1],
    ["EPSG:8228", "WGS 84 / UTM zone 32N + Foot height", GLOBAL_UNDULATION, 0.3048],
  ])("goes its way in plane and changes heights alone for %s", async (vertical, name, lift, unit) => {
    const georeference = await open(withRecords(record, transformation), { vertical });
    const inPlane = await open(withRecords(record, transformation));
    const expected = placed(inPlane, 30, 70, 5 * unit + lift - UNDULATION);
    expect(distance(placed(georeference, 30, 70, 5), expected)).toBeLessThan(1e-6);
    const geoids = lift === 0 ? [] : [EGM96];
    expect(georeference).toMatchObject({ basis: "given", engine: record.engine, geoids, crs: { name } });
    expect(georeference.operation).toMatchObject({ name: record.operation?.name, grids: geoids });
    expect(georeference.operation?.notes.join()).toContain("heights is replaced");
  });

  it("keeps the unit of z that the conversion found declared, and says so", async () => {
    const verticalUnit = { name: "foot", kind: "linear", size: 0.3048, declared: true } as const;
    const feet = { ...record, crs: { ...crs, verticalUnit } };
    for (const file of [withRecords(feet, transformation), withRecords(feet)]) {
      const { crs: other, accuracy } = await open(file, { vertical: "EPSG:5728" });
      expect(other).toMatchObject({ height: { epsg: 5728 }, verticalUnit: { size: 0.3048 } });
      expect(accuracy.parts.map(({ note }) => note).join()).toMatch(
        /z stays in foot, as declared; LN02 height/,
      );
    }
  });

  it("stands as it is where the user gives what it has", async () => {
    const georeference = await open(withRecords(record, transformation), { vertical: "EPSG:9999" });
    expect(georeference).toMatchObject({
      basis: "record",
      geoids: ["flat.tif"],
      operation: record.operation,
    });
    expect(georeference.accuracy.total).toBeCloseTo(0.046, 12);
  });

  it("says what EGM96 is worth in place of another geoid, and what of its own", async () => {
    const part = async (vertical: string) =>
      (await open(withRecords(record, transformation), { vertical })).accuracy.parts.find(
        ({ name }) => name === "height",
      );
    expect(await part("EPSG:5728")).toEqual({
      name: "height",
      metres: EGM96_ACCURACY,
      note: "LN02 height: by EGM96 in place of its own geoid; given by the user",
    });
    expect(await part("EPSG:5773")).toMatchObject({ metres: 0.006 });
  });

  it("does not know what heights are worth where their system is not in use", async () => {
    for (const file of [withRecords(record, transformation), {}]) {
      const crs = "records" in file ? {} : { crs: UTM };
      const { accuracy } = await open(file, { vertical: "EPSG:5709", ...crs });
      const note = expect.stringContaining("NAP height: not in use at this place");
      expect(accuracy.parts).toContainEqual({ name: "height", metres: null, note });
    }
  });

  it("takes the table of the application before its own", async () => {
    const feet = `VERT_CS["Foot height",VERT_DATUM["Foot datum",2005],UNIT["foot",0.3048],AXIS["Up",UP]]`;
    const epsg = () => ({ name: "Foot height", wkt: feet, kind: "CRS-VERTCRS" });
    const { crs: other } = await open(withRecords(record, transformation), { vertical: "EPSG:5728", epsg });
    expect(other).toMatchObject({ height: { kind: "geoid", epsg: 5728 }, verticalUnit: { size: 0.3048 } });
  });

  it.each([
    ["CRS_UNKNOWN", "EPSG:2056", /EPSG:2056 is not a vertical coordinate system/],
    ["CRS_UNKNOWN", "EPSG:1", /EPSG:1 is not a vertical coordinate system/],
    ["CRS_UNKNOWN", "NAP", /"NAP" is not a known height reference/],
    ["CRS_UNKNOWN", "EPSG:2056+5728", /is not a known height reference/],
  ])("%s for %s", async (code, vertical, cause) => {
    for (const file of [withRecords(record, transformation), {}]) {
      await expect(
        open(file, { crs: undefined, vertical, ...("records" in file ? {} : { crs: UTM }) }),
      ).rejects.toThrow(expect.objectContaining({ code, cause: expect.stringMatching(cause) }));
    }
  });

  it("lays given depths downwards, without a geoid and of unknown accuracy", async () => {
    for (const file of [withRecords(record, transformation), {}]) {
      const opened = await open(file, { vertical: "EPSG:5861", ...(!("records" in file) && { crs: UTM }) });
      expect(opened.crs.verticalUnit.size).toBeLessThan(0);
      expect(opened.geoids).toEqual([]);
      expect(opened.accuracy.parts.find(({ name }) => name === "height")).toMatchObject({
        metres: null,
        note: expect.stringMatching(/LAT depth: counts from a level of its own/),
      });
    }
  });

  it("suggests the system that a name may mean", async () => {
    for (const file of [withRecords(record, transformation), {}]) {
      const opened = open(file, { vertical: "LN02", ...(!("records" in file) && { crs: UTM }) });
      await expect(opened).rejects.toThrow(
        expect.objectContaining({
          code: "CRS_UNKNOWN",
          fix: "give its EPSG code: EPSG:5728 (LN02 height); or ellipsoidal",
        }),
      );
    }
  });

  it("SOURCE_HEIGHTS where the data of height systems cannot be loaded", async () => {
    const options = { vertical: "EPSG:5728", heightData: noHeightData };
    await expect(open(withRecords(record, transformation), options)).rejects.toThrow(
      expect.objectContaining({ code: "SOURCE_HEIGHTS" }),
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

describe("georeferenceOf a file without a transformation", () => {
  const VERTICAL = `VERT_CS["LN02 height",VERT_DATUM["Landesnivellement 1902",2005],UNIT["metre",1],AXIS["Up",UP]]`;
  const epsg = () => ({ name: "LN02 height", wkt: VERTICAL, kind: "CRS-VERTCRS" });
  const lift = async (options: GeoreferenceOptions, scale = 1) => {
    const ellipsoidal = placed(await open({}, { crs: UTM, vertical: "ellipsoidal" }), 30, 70, 5 * scale);
    return distance(placed(await open({}, { crs: UTM, ...options }), 30, 70, 5), ellipsoidal);
  };

  it("lifts heights of the system given by EGM96", async () => {
    expect(await lift({ vertical: "EPSG:5728" })).toBeCloseTo(GLOBAL_UNDULATION, 5);
    expect(await lift({ vertical: "EPSG:8228" }, 0.3048)).toBeCloseTo(GLOBAL_UNDULATION, 5);
    expect(await lift({ vertical: "EPSG:5728", epsg })).toBeCloseTo(GLOBAL_UNDULATION, 5);
    const { accuracy, geoids, basis } = await open({}, { crs: UTM, vertical: "EPSG:5728" });
    expect([geoids, basis]).toEqual([[EGM96], "given"]);
    expect(accuracy.parts).toContainEqual(
      expect.objectContaining({ name: "height", metres: EGM96_ACCURACY }),
    );
  });

  it("lifts heights that its own words declare, or draws them as they are and says why", async () => {
    const text = `COMPD_CS["UTM + LN02",PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]],${VERTICAL}]`;
    expect(await lift({ crs: text })).toBeCloseTo(GLOBAL_UNDULATION, 5);
    expect(await lift({ crs: text, heightData: noHeightData })).toBeLessThan(1e-6);
    const { accuracy } = await open({}, { crs: text, heightData: noHeightData });
    expect(accuracy.parts.find(({ name }) => name === "height")).toEqual({
      ...{ name: "height", metres: null },
      note: "LN02 height: drawn without its geoid; it cannot be had",
    });
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

describe("georeferenceOf a file that names codes", () => {
  const METRE = 'UNIT["metre",1],AXIS["E",EAST],AXIS["N",NORTH]';
  const BASE =
    'GEOGCS["ETRS89",DATUM["European_Terrestrial_Reference_System_1989",SPHEROID["GRS 1980",6378137,298.257222101],AUTHORITY["EPSG","6258"]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4258"]]';
  const parameters = (meridian: number) =>
    `PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",${meridian}],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0]`;
  const utm = (zone: number) =>
    `PROJCS["ETRS89 / UTM zone ${zone}N",${BASE},PROJECTION["Transverse_Mercator"],${parameters(6 * zone - 183)},${METRE},AUTHORITY["EPSG","${25800 + zone}"]]`;
  const row = (zone: number) => ({
    ...{ code: 25800 + zone, kind: "CRS-PROJCRS", name: `ETRS89 / UTM zone ${zone}N`, wkt: utm(zone) },
  });
  const epsgTable = async () => packEpsg([row(32), row(33)]);
  const keys = (...pairs: (readonly [number, number])[]) => {
    const words = [1, 1, 0, pairs.length, ...pairs.flatMap(([key, value]) => [key, 0, 1, value])];
    return ["LASF_Projection", 34735, new Uint8Array(Uint16Array.from(words).buffer)] as const;
  };
  const text = (wkt: string) => ["LASF_Projection", 2112, new TextEncoder().encode(wkt)] as const;

  it("looks them up in the table beside the library: GeoTIFF keys, and the option crs", async () => {
    const byKeys = await open({ records: [keys([1024, 1], [3072, 25832])] }, { epsgTable });
    expect(byKeys).toMatchObject({ basis: "file", crs: { code: "EPSG:25832" } });
    const byOption = await open({}, { crs: "EPSG:25832+5728", epsgTable });
    expect(byOption).toMatchObject({ basis: "given", crs: { height: { epsg: 5728 } } });
    const whole = resolveCrs({ file: "a", wkt: utm(32) });
    expect(byKeys.crs.proj4).toBe(whole.proj4);
  });

  it("does not fetch it where no code is asked for, nor where the application has it", async () => {
    const never = () => Promise.reject(new Error("not to be asked for"));
    await open({ records: [text(utm(32))] }, { epsgTable: never });
    await open(
      {},
      { crs: "EPSG:25832", epsg: (code) => (code === 25832 ? row(32) : undefined), epsgTable: never },
    );
  });

  it("says that the table cannot be had where nothing else places the file", async () => {
    const gone = { code: "SOURCE_EPSG", file: "epsg.json", cause: "it cannot be had", fix: "Look" };
    const epsgTable = () => Promise.reject(new SourceError(gone));
    await expect(open({ records: [keys([3072, 25832])] }, { epsgTable })).rejects.toMatchObject({
      code: "SOURCE_EPSG",
    });
    const both = await open({ records: [text(utm(32)), keys([3072, 25832])] }, { epsgTable });
    expect([both.crs.code, datumNote(both)]).toEqual([
      "EPSG:25832",
      expect.stringMatching(/codes could not be looked up: it cannot be had/),
    ]);
  });

  it("takes WKT before keys that contradict it, heights of keys where the WKT has none, and tells both", async () => {
    const apart = await open({ records: [text(utm(32)), keys([3072, 25833])] }, { epsgTable });
    expect([apart.crs.code, datumNote(apart)]).toEqual([
      "EPSG:25832",
      expect.stringMatching(/contradict each other; the WKT is used/),
    ]);
    const heights = keys([3072, 25832], [4096, 8228], [4099, 9002]);
    const feet = await open({ records: [text(utm(32)), heights] }, { epsgTable });
    expect(feet.crs).toMatchObject({ height: { epsg: 8228 }, verticalUnit: { size: 0.3048 } });
    expect(datumNote(feet)).toMatch(/Foot height .*is taken from the GeoTIFF keys/);
  });

  it("keeps declared heights under a given plane", async () => {
    const georeference = await open(withRecords(record), { crs: "EPSG:25832", epsgTable });
    expect(georeference.crs).toMatchObject({ code: "EPSG:25832+9999", height: { epsg: 9999 } });
  });
});
