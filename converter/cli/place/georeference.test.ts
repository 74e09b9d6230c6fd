import { describe, expect, it } from "vitest";
import { findProj } from "../proj/program/find.js";
import { commonGeoreference } from "./common-georeference.js";
import { epsg } from "./epsg.js";
import { type Given, georeference, type Named } from "./georeference.js";
import { outputWkt } from "./output-wkt.js";

const tile = (file: string, more: Partial<Named> = {}): Named => ({
  ...{
    file,
    pointFormat: 6,
    wktBit: true,
    wkt: epsg(28992)!.wkt!,
    min: [155000, 463000, 0],
    max: [155100, 463100, 9],
  },
  ...more,
});

describe("--vertical in words", () => {
  const fixFor = (vertical: string, scan = tile("scan.las")) =>
    georeference(scan, { vertical }).then(
      () => "accepted",
      ({ code, fix }: { code: string; fix: string }) => `${code} ${fix}`,
    );

  it("is answered with the system of that name", async () => {
    expect(await fixFor("NAP")).toBe(
      "CRS_UNKNOWN give its EPSG code: EPSG:5709 (NAP height); or ellipsoidal",
    );
  });

  it("is answered with those in use there, where no name is like it", async () => {
    expect(await fixFor("sea level")).toMatch(
      /^CRS_UNKNOWN give an EPSG code, of those in use there: EPSG:5709 /,
    );
  });

  it("leaves the answer to a system that is wrong itself alone", async () => {
    const wrong = georeference(tile("scan.las"), { crs: "2056", vertical: "NAP" });
    await expect(wrong).rejects.toMatchObject({ code: "CRS_UNKNOWN", fix: "give EPSG:2056" });
  });

  it("is answered without a place too", async () => {
    const { min: _min, max: _max, ...unplaced } = tile("scan.las");
    expect(await fixFor("DHHN2016", unplaced)).toMatch(/EPSG:7837/);
    expect(await fixFor("sea level", unplaced)).toMatch(/such as EPSG:5728/);
  });
});

it("--vertical is no word for a scan that an anchor or control points place", async () => {
  const refusal = (given: Given) => georeference(tile("scan.las"), { vertical: "EPSG:5709", ...given });
  await expect(refusal({ anchor: "5,52,0,0", crs: "none" })).rejects.toMatchObject({
    ...{ code: "CRS_TWICE", cause: expect.stringMatching(/^--vertical cannot be used with --anchor,/) },
  });
  await expect(refusal({ control: "points.txt" })).rejects.toMatchObject({
    cause: expect.stringMatching(/^--vertical cannot be used with --control,/),
  });
});

it("a height reference that is given beside what the file declares is told as such", async () => {
  const given = async (more: Given) => (await georeference(tile("scan.las"), more)).heightGiven;
  expect(await given({ vertical: "EPSG:5709" })).toBe(true);
  expect(await given({ vertical: "EPSG:5709", crs: "EPSG:28992" })).toBe(false);
  expect(await given({})).toBe(false);
});

const proj = await findProj();
const absent = proj ? "" : " (skipped: PROJ is not installed)";

describe.skipIf(!proj)(`what only PROJ understands${absent}`, () => {
  const bare = { file: "scan.las" };
  const keys = (...entries: number[]) => ({
    directory: [1, 1, 0, entries.length / 4, ...entries],
    ...{ doubles: [], ascii: "" },
  });

  it.each([
    ["a code", bare, { crs: "EPSG:29701" }, "EPSG:29701", "given"],
    ["a code newer than the table", bare, { crs: "EPSG:10739" }, "EPSG:10739", "given"],
    ["a code with --vertical", bare, { crs: "EPSG:2385", vertical: "EPSG:5737" }, "EPSG:2385+5737", "given"],
    ["GeoTIFF keys", { ...bare, geoTiff: keys(3072, 0, 1, 2385) }, {}, "EPSG:2385", "GeoTIFF keys"],
  ])("is taken from %s", async (_, scan, given, code, basis) => {
    const found = await georeference(scan, given);
    expect(found).toMatchObject({ basis, crs: { code } });
    expect(outputWkt(found)).toContain(found.crs.name);
    await expect(georeference(scan, { ...given, engine: "proj4js" })).rejects.toMatchObject({
      code: expect.stringMatching(/^CRS_(UNKNOWN|UNSUPPORTED)$/),
    });
  });

  it("keeps the heights that the file declares, its unit of z included, and tells it", async () => {
    const wkt = `COMPD_CS["both",${epsg(25832)!.wkt},${epsg(7837)!.wkt}]`;
    const found = await georeference(tile("scan.las", { wkt }), { crs: "EPSG:5682" });
    expect(found).toMatchObject({
      crs: { code: "EPSG:5682+7837", height: { epsg: 7837 }, verticalUnit: { size: 1, declared: true } },
      notes: [{ code: "CRS_HEIGHTS_KEPT", text: expect.stringMatching(/^DHHN2016 height \(metre\)/) }],
    });
    expect(outputWkt(found)).toMatch(/^COMPOUNDCRS.*DB_REF.*VERTCRS\["DHHN2016 height".*ID\["EPSG",7837\]/);
    const feet = { ...bare, geoTiff: keys(3072, 0, 1, 25832, 4099, 0, 1, 9003) };
    const inFeet = await georeference(feet, { crs: "EPSG:5682" });
    expect(inFeet.crs).toMatchObject({ code: "EPSG:5682", verticalUnit: { size: 1200 / 3937 } });
    expect(outputWkt(inFeet)).toMatch(/VERTCRS\["unknown".*survey foot/);
    const other = await georeference(tile("scan.las", { wkt }), { crs: "EPSG:5682", vertical: "EPSG:5783" });
    expect([other.crs.code, other.notes]).toEqual(["EPSG:5682+5783", []]);
  });

  it("stays refused where PROJ does not understand it either, in the same words", async () => {
    const given = { crs: "EPSG:999999" };
    const words = await georeference(bare, { ...given, engine: "proj4js" }).catch((error) => error.message);
    await expect(georeference(bare, given)).rejects.toThrow(words);
  });
});

describe("several inputs", () => {
  const utm = (zone: number) => ({ wkt: epsg(25800 + zone)!.wkt! });

  it("tell what is strange of some, with their names; of all, without", async () => {
    const geoTiff = { directory: [1, 1, 0, 1, 3072, 0, 1, 25833], doubles: [], ascii: "" };
    const odd = (file: string) => tile(file, { ...utm(32), geoTiff });
    const some = await commonGeoreference([tile("a.las", utm(32)), odd("b.las"), odd("c.las")], {});
    expect(some.notes.map(({ text }) => text)).toEqual([
      expect.stringMatching(/^b\.las, c\.las: the WKT \(/),
    ]);
    const all = await commonGeoreference([odd("b.las"), odd("c.las")], {});
    expect(all.notes.map(({ text }) => text)).toEqual([expect.stringMatching(/^the WKT \(/)]);
  });

  it("of many, name a few", async () => {
    const scans = ["a", "b", "c", "d", "e"].map((file) => tile(file, utm(32)));
    await expect(commonGeoreference([...scans, tile("f", utm(33))], {})).rejects.toMatchObject({
      ...{ code: "CRS_MIXED", file: "f" },
      cause: expect.stringMatching(/2 different systems: .*32N \(a, b, c, 2 more\); .*33N \(f\)/),
    });
  });
});
