import { describe, expect, it } from "vitest";
import type { CrsSources, EpsgEntry, GeoTiffKeys } from "./crs.js";
import { resolveCrs, resolveWithNotes } from "./resolve.js";

const ETRS89 =
  'GEOGCS["ETRS89",DATUM["European_Terrestrial_Reference_System_1989",SPHEROID["GRS 1980",6378137,298.257222101],AUTHORITY["EPSG","6258"]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4258"]]';

/** UTM on ETRS89 as WKT 1; `rest` stands for its axes and its code. */
function utm(zone: number, rest = `,AUTHORITY["EPSG","${25800 + zone}"]`): string {
  const parameters = [
    ["latitude_of_origin", 0],
    ["central_meridian", 6 * zone - 183],
    ["scale_factor", 0.9996],
    ["false_easting", 500000],
    ["false_northing", 0],
  ].map(([name, value]) => `PARAMETER["${name}",${value}]`);
  return `PROJCS["ETRS89 / UTM zone ${zone}N",${ETRS89},PROJECTION["Transverse_Mercator"],${parameters.join()},UNIT["metre",1]${rest}]`;
}

function vertical(name: string, code: number, unit: string): string {
  return `VERT_CS["${name}",VERT_DATUM["${name}",2005],UNIT[${unit}],AXIS["Up",UP],AUTHORITY["EPSG","${code}"]]`;
}

const DHHN = vertical("DHHN2016 height", 7837, '"metre",1');
const NAVD_FEET = vertical("NAVD88 height (ftUS)", 6360, '"US survey foot",0.304800609601219');
const compound = (zone: number, heights: string) => `COMPD_CS["both",${utm(zone)},${heights}]`;

const TABLE: ReadonlyMap<number, EpsgEntry> = new Map([
  [25832, { name: "ETRS89 / UTM zone 32N", kind: "CRS-PROJCRS", wkt: utm(32) }],
  [25833, { name: "ETRS89 / UTM zone 33N", kind: "CRS-PROJCRS", wkt: utm(33) }],
  [7837, { name: "DHHN2016 height", kind: "CRS-VERTCRS", wkt: DHHN }],
  [6360, { name: "NAVD88 height (ftUS)", kind: "CRS-VERTCRS", wkt: NAVD_FEET }],
]);

/** Short keys, all of whose values stand in the directory. */
function keys(...pairs: (readonly [number, number])[]): GeoTiffKeys {
  const entries = pairs.flatMap(([key, value]) => [key, 0, 1, value]);
  return {
    directory: Uint16Array.from([1, 1, 0, pairs.length, ...entries]),
    doubles: new Float64Array(),
    ascii: "",
  };
}

const PLANE_KEYS = (code: number) => [[1024, 1] as const, [3072, code] as const, [3076, 9001] as const];
const las = (pointFormat: number, wktBit: boolean) => ({ pointFormat, wktBit });
const resolved = (sources: Omit<CrsSources, "file">) =>
  resolveWithNotes({ file: "scan.las", ...sources }, (code) => TABLE.get(code));
const codes = (sources: Omit<CrsSources, "file">) => resolved(sources).notes.map(({ code }) => code);

describe("WKT and GeoTIFF keys that contradict each other", () => {
  const sources = { wkt: utm(32), geoTiff: keys(...PLANE_KEYS(25833)) };

  it.each([
    ["the WKT bit of the header is set", las(1, true), "WKT", "EPSG:25832"],
    ["the WKT bit of the header is not set", las(1, false), "GeoTIFF keys", "EPSG:25833"],
    ["point format 6 requires", las(6, false), "WKT", "EPSG:25832"],
    ["used", undefined, "WKT", "EPSG:25832"],
  ] as const)("are settled, which is told: %s", (why, header, basis, code) => {
    const { crs, notes, ...rest } = resolved({ ...sources, las: header });
    expect([rest.basis, crs.code, crs.wkt === undefined]).toEqual([basis, code, basis !== "WKT"]);
    expect(notes).toMatchObject([{ code: "CRS_CONTRADICTION" }]);
    expect(notes[0].text.endsWith(why)).toBe(true);
    expect(notes[0].text).toMatch(/zone 32N.*zone 33N|zone 33N.*zone 32N/);
  });

  it("are not those that mean the same", () => {
    expect(codes({ wkt: utm(32), geoTiff: keys(...PLANE_KEYS(25832)), las: las(1, true) })).toEqual([]);
    expect(codes({ wkt: utm(32, ""), geoTiff: keys(...PLANE_KEYS(25832)), las: las(1, true) })).toEqual([]);
  });

  it("differ in the unit of x and y, or in the heights", () => {
    const feet = keys([1024, 1], [3072, 25832], [3076, 9003]);
    expect(codes({ wkt: utm(32), geoTiff: feet })).toEqual(["CRS_CONTRADICTION"]);
    const other = keys(...PLANE_KEYS(25832), [4096, 6360]);
    const { crs, notes } = resolved({ wkt: compound(32, DHHN), geoTiff: other });
    expect(notes).toMatchObject([{ code: "CRS_CONTRADICTION" }]);
    expect(crs.height).toMatchObject({ epsg: 7837 });
  });
});

describe("the declaration that the header announces", () => {
  it.each([
    [
      "keys alone, format 7",
      { geoTiff: keys(...PLANE_KEYS(25832)), las: las(7, false) },
      /format 7 requires/,
    ],
    ["keys alone, bit set", { geoTiff: keys(...PLANE_KEYS(25832)), las: las(1, true) }, /announces WKT/],
    ["WKT alone, bit not set", { wkt: utm(32), las: las(1, false) }, /announces GeoTIFF keys/],
  ] as const)("is absent, and the other one is used: %s", (_, sources, text) => {
    const { crs, notes } = resolved(sources);
    expect(crs.code).toBe("EPSG:25832");
    expect(notes).toMatchObject([{ code: "CRS_OTHER_FORM", text: expect.stringMatching(text) }]);
  });

  it("is there, and nothing is said", () => {
    expect(codes({ geoTiff: keys(...PLANE_KEYS(25832)), las: las(1, false) })).toEqual([]);
    expect(codes({ wkt: utm(32), las: las(6, true) })).toEqual([]);
    expect(codes({ wkt: utm(32), las: las(6, false) })).toEqual([]);
  });

  it("cannot be read, and the other one is used", () => {
    const { crs, notes } = resolved({ wkt: utm(32), geoTiff: keys([3072, 9999]), las: las(1, false) });
    expect(crs.code).toBe("EPSG:25832");
    expect(notes).toMatchObject([{ code: "CRS_OTHER_FORM", text: expect.stringContaining("EPSG:9999") }]);
  });

  it("cannot be read, nor can the other one: its own fault is told", () => {
    const sources = { wkt: "NONSENSE", geoTiff: keys([3072, 1]), las: las(1, false) };
    expect(() => resolved(sources)).toThrow(/^CRS_UNKNOWN: scan\.las: EPSG:1 /);
  });
});

describe("heights that only one of the two declares", () => {
  const feet = keys(...PLANE_KEYS(25832), [4096, 6360], [4099, 9003]);

  it("are used where the WKT is silent, with their unit, and told", () => {
    const { crs, notes } = resolved({ wkt: utm(32), geoTiff: feet, las: las(6, true) });
    expect(crs).toMatchObject({
      code: "EPSG:25832+6360",
      height: { kind: "geoid", epsg: 6360 },
      verticalUnit: { size: 1200 / 3937, declared: true },
    });
    expect(notes).toMatchObject([
      { code: "CRS_HEIGHTS_FROM_OTHER_FORM", text: expect.stringMatching(/NAVD88.*survey foot/) },
    ]);
  });

  it("are used where the keys are silent", () => {
    const sources = { wkt: compound(32, DHHN), geoTiff: keys(...PLANE_KEYS(25832)), las: las(1, false) };
    const { crs, basis, notes } = resolved(sources);
    expect([basis, crs.code]).toEqual(["GeoTIFF keys", "EPSG:25832+7837"]);
    expect(notes).toMatchObject([{ code: "CRS_HEIGHTS_FROM_OTHER_FORM" }]);
  });

  it("may be a unit alone", () => {
    const unit = keys(...PLANE_KEYS(25832), [4099, 9003]);
    const { crs } = resolved({ wkt: utm(32), geoTiff: unit, las: las(6, true) });
    expect(crs.height).toEqual({ kind: "unknown" });
    expect(crs.verticalUnit).toMatchObject({ size: 1200 / 3937, declared: true });
  });

  it.each([
    ["missing", keys([4099, 9003])],
    ["missing but for the kind of model", keys([1024, 1], [4099, 9003])],
    ["unknown", keys([1024, 1], [3072, 9999], [4099, 9003])],
  ] as const)("are used where the plane of the keys is %s", (_, geoTiff) => {
    for (const bit of [true, false]) {
      const { crs, basis, notes } = resolved({ wkt: utm(32), geoTiff, las: las(1, bit) });
      expect([basis, crs.code]).toEqual(["WKT", "EPSG:25832"]);
      expect(crs.verticalUnit).toMatchObject({ size: 1200 / 3937, declared: true });
      expect(notes.at(-1)).toMatchObject({
        ...{ code: "CRS_HEIGHTS_FROM_OTHER_FORM", text: expect.stringMatching(/survey foot/) },
      });
    }
    const other = resolved({ wkt: compound(32, DHHN), geoTiff, las: las(1, true) });
    expect(other.crs.verticalUnit.size).toBe(1);
    expect(other.notes).toMatchObject([
      { code: "CRS_CONTRADICTION", text: expect.stringMatching(/z in metre.*keys \(.*survey foot/) },
    ]);
    expect(resolved({ given: "EPSG:25833", geoTiff }).crs.verticalUnit.size).toBe(1200 / 3937);
    expect(() => resolved({ geoTiff: keys([4099, 9003]) })).toThrow(/^CRS_MISSING/);
  });

  it("are not taken from a declaration of another plane", () => {
    const { crs, notes } = resolved({
      ...{ wkt: utm(33), geoTiff: feet, las: las(6, true) },
    });
    expect(crs.height).toEqual({ kind: "unknown" });
    expect(notes).toMatchObject([{ code: "CRS_CONTRADICTION", text: expect.stringMatching(/survey foot/) }]);
  });
});

describe("a given CRS without heights", () => {
  it("keeps those of the file, and tells it", () => {
    const { crs, basis, notes } = resolved({ given: "EPSG:25833", wkt: compound(32, DHHN) });
    expect([basis, crs.code]).toEqual(["given", "EPSG:25833+7837"]);
    expect(notes).toMatchObject([{ code: "CRS_HEIGHTS_KEPT", text: expect.stringMatching(/DHHN2016/) }]);
  });

  it("keeps those of an earlier conversion", () => {
    const recordedHeights = resolved({ wkt: compound(32, NAVD_FEET) }).crs;
    const { crs } = resolved({ given: "EPSG:25833", recordedHeights });
    expect(crs.code).toBe("EPSG:25833+6360");
    expect(crs.verticalUnit.size).toBe(1200 / 3937);
  });

  it("gives way to heights that are given with it", () => {
    const { crs, notes } = resolved({
      ...{ given: "EPSG:25833", givenVertical: "ellipsoidal", wkt: compound(32, DHHN) },
    });
    expect([crs.height.kind, notes]).toEqual(["ellipsoidal", []]);
    expect(resolved({ given: "EPSG:25833+6360", wkt: compound(32, DHHN) }).crs.code).toBe("EPSG:25833+6360");
  });

  it("stands by itself where the file cannot be read", () => {
    expect(resolved({ given: "EPSG:25833", wkt: "NONSENSE" }).crs.height).toEqual({ kind: "unknown" });
  });
});

it("a vertical datum that is called unknown is a unit and nothing else", () => {
  const wkt = compound(32, 'VERT_CS["unknown",VERT_DATUM["unknown",2005],UNIT["foot",0.3048]]');
  const crs = resolveCrs({ file: "scan.las", wkt });
  expect([crs.height, crs.verticalUnit.size]).toEqual([{ kind: "unknown" }, 0.3048]);
});
