import {
  type DataSetIdentity,
  EGM96,
  EGM96_ACCURACY,
  encodeRecordFile,
  type GeoreferenceRecord,
  packEpsg,
  resolveCrs,
} from "@groma/georef";
import { beforeAll, describe, expect, it } from "vitest";
import { SourceError } from "../errors/index.js";
import { BlobSource } from "../sources/bytes/blob-source.js";
import { CopcSource } from "../sources/copc/copc-source.js";
import { type TinyCopc, tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import type { GeoreferenceOptions } from "./georeference-options.js";
import {
  datumNote,
  distance,
  GLOBAL_UNDULATION,
  noHeightData,
  open,
  placed,
  record,
  resolved,
  SIMILARITY,
  transformation,
  UTM,
  withRecords,
} from "./georeferenced.fixture.js";

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
    for (const broken of [Uint8Array.of(1), new Blob([]), new Blob(["{"])]) {
      await expect(open({}, { transformation: broken })).rejects.toMatchObject({ code: "RECORD_JSON" });
    }
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
