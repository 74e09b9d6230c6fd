import { EGM96, EGM96_ACCURACY, ENGINE, placePoint } from "@groma/georef";
import { describe, expect, it } from "vitest";
import {
  crs,
  datumNote,
  distance,
  GLOBAL_UNDULATION,
  noHeightData,
  open,
  placed,
  record,
  transformation,
  UNDULATION,
  UTM,
  withRecords,
} from "./georeferenced.fixture.js";

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
