import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import {
  type Crs,
  compileTransformation,
  type Domain,
  decodeTransformation,
  ecefToGeodetic,
  encodeTransformation,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { dataFolder } from "../../../tests/project.js";
import { runPipeline } from "./cct.js";
import { geoTiff } from "./grids/geotiff.fixture.js";
import { listOperations } from "./operation.js";
import { parsePipeline } from "./pipeline.js";
import { findProj } from "./program/find.js";
import { projTransformation } from "./transformation.js";

const grids = `${dataFolder}/grids`;
const tables = existsSync(grids);
const plain = await findProj();
const proj = plain && tables ? await findProj({ grids }) : undefined;
const absent = plain ? "" : " (skipped: PROJ is not installed)";
const without = plain && !tables ? " (skipped: no grids in ../shared/data)" : absent;

const METRE = { name: "metre", kind: "linear", size: 1, declared: true } as const;
const FOOT_US = { name: "US survey foot", kind: "linear", size: 1200 / 3937, declared: true } as const;
const FOOT = { name: "foot", kind: "linear", size: 0.3048, declared: false } as const;
const GEOID = { kind: "geoid", model: "the vertical CRS" } as const;
const UNKNOWN = { kind: "unknown" } as const;

function crsOf(code: string, height: Crs["height"], verticalUnit: Crs["verticalUnit"] = METRE): Crs {
  return { name: code, code, proj4: "", horizontalUnit: METRE, verticalUnit, height };
}

function box(minX: number, minY: number, size = 5000): Domain {
  return { minX, minY, minZ: 0, maxX: minX + size, maxY: minY + size, maxZ: 300 };
}

type Row = readonly [x: number, y: number, z: number, X: number, Y: number, Z: number];

function truth(name: string): { source: string; rows: readonly Row[]; domain: Domain } {
  const { source, rows } = JSON.parse(readFileSync(`${dataFolder}/truth/${name}.json`, "utf8"));
  const along = (axis: number) => rows.map((row: Row) => row[axis]);
  const [minX, minY, minZ] = [0, 1, 2].map((axis) => Math.min(...along(axis)));
  const [maxX, maxY, maxZ] = [0, 1, 2].map((axis) => Math.max(...along(axis)));
  return { source, rows, domain: { minX, minY, minZ, maxX, maxY, maxZ } };
}

describe.skipIf(!proj)(`PROJ with grids${without}`, () => {
  it.each(["grid_rd_nap", "grid_lv95_ln02", "grid_lv03_ln02"])(
    "puts every row of %s where it did",
    async (name) => {
      const { source, rows, domain } = truth(name);
      const start = performance.now();
      const { transformation, report } = await projTransformation(proj!, crsOf(source, GEOID), domain);
      const seconds = (performance.now() - start) / 1000;
      const { evaluate } = compileTransformation(transformation);
      const own = new Float64Array(3);
      let worst = 0;
      for (const [x, y, z, ...place] of rows) {
        evaluate(x, y, z, own, 0);
        const apart = Math.hypot(...place.map((value, axis) => own[axis] - value));
        worst = Math.max(worst, apart);
      }
      console.info(
        `${name}: ${rows.length} rows, worst ${(worst * 1e3).toFixed(5)} mm, ${seconds.toFixed(2)} s`,
      );
      expect(worst).toBeLessThan(1e-3);
      expect(report.grids.length).toBeGreaterThan(0);
      expect(report).toMatchObject({ ballpark: false, lacking: [], passedOver: [], notes: [] });
      expect(report.worstDifference).toBeLessThan(1e-4);
    },
  );

  it("reports the operation, its accuracy and its grids, in few bytes", async () => {
    const crs = crsOf("EPSG:7415", GEOID);
    const small = await projTransformation(proj!, crs, box(150_000, 450_000, 10_000));
    expect(small.report).toMatchObject({
      engine: { name: "PROJ" },
      grids: ["nl_nsgi_rdtrans2018.tif", "nl_nsgi_nlgeo2018.tif"],
    });
    expect(small.report.accuracy).toBeCloseTo(1, 1);
    expect(encodeTransformation(small.transformation).length).toBeLessThan(8192);
    const large = await projTransformation(proj!, crs, box(120_000, 420_000, 50_000));
    expect(encodeTransformation(large.transformation).length).toBeLessThan(65_536);
  });

  it("follows finer grids into the coarser ones around them", async () => {
    const domain = { minX: 30_000, minY: 600_000, minZ: 0, maxX: 130_000, maxY: 660_000, maxZ: 10 };
    const { report } = await projTransformation(proj!, crsOf("EPSG:7415", GEOID), domain);
    expect(report.worstDifference).toBeLessThan(1e-4);
  });

  it("goes on by EGM96 where the grid of the heights ends", async () => {
    const domain = { minX: 2_820_000, minY: 1_180_000, minZ: 0, maxX: 2_880_000, maxY: 1_240_000, maxZ: 100 };
    const { report, transformation } = await projTransformation(
      proj!,
      crsOf("EPSG:2056+5728", GEOID),
      domain,
    );
    expect(report.grids).toEqual(["ch_swisstopo_chgeo2004_ETRS89_LN02.tif", "EGM96"]);
    expect(report.notes.join()).toMatch(
      /in 7\d % of .*, beyond the grids, .* height by the geoid model EGM96/,
    );
    const { evaluate } = compileTransformation(
      decodeTransformation(encodeTransformation(transformation), ""),
    );
    const out = new Float64Array(3);
    const heightAt = (x: number, y: number) => {
      evaluate(x, y, 50, out, 0);
      ecefToGeodetic(out[0], out[1], out[2], out);
      return out[2];
    };
    for (let x = domain.minX; x <= domain.maxX; x += 5000) {
      for (let y = domain.minY; y <= domain.maxY; y += 5000) {
        expect(heightAt(x, y)).toBeGreaterThan(95);
        expect(heightAt(x, y)).toBeLessThan(105);
      }
    }
    // Within the grid it is PROJ's, with the geoid of Switzerland.
    const within = { ...domain, minX: 2_819_000, minY: 1_185_000, maxX: 2_820_000, maxY: 1_186_000 };
    const inside = await projTransformation(proj!, crsOf("EPSG:2056+5728", GEOID), within);
    expect(inside.report.grids).toEqual(["ch_swisstopo_chgeo2004_ETRS89_LN02.tif"]);
    const alone = compileTransformation(inside.transformation);
    const there = new Float64Array(3);
    alone.evaluate(2_820_000, 1_185_500, 50, there, 0);
    evaluate(2_820_000, 1_185_500, 50, out, 0);
    expect(Math.hypot(...there.map((value, axis) => value - out[axis]))).toBeLessThan(1e-4);
  });

  it("takes heights that the user declares apart from the CRS, or against it", async () => {
    const domain = box(150_000, 450_000);
    const given = { kind: "geoid", model: "NAP height", epsg: 5709 } as const;
    const { report } = await projTransformation(proj!, crsOf("EPSG:28992", given), domain);
    expect(report.grids).toContain("nl_nsgi_nlgeo2018.tif");
    const flat = await projTransformation(proj!, crsOf("EPSG:7415", { kind: "ellipsoidal" }), domain);
    expect(flat.report.grids).toEqual([]);
  });
});

describe.skipIf(!plain)(`PROJ alone${absent}`, () => {
  it.each([
    ["UTM", crsOf("EPSG:32633", { kind: "ellipsoidal" }), box(500_000, 5_500_000)],
    ["US survey feet", crsOf("EPSG:2225", UNKNOWN, FOOT_US), box(6_000_000, 2_000_000)],
    ["international feet", crsOf("EPSG:2994", UNKNOWN, FOOT), box(600_000, 1_000_000)],
    ["northing before easting", crsOf("EPSG:2193", UNKNOWN), box(1_600_000, 5_500_000)],
    ["polar axes", crsOf("EPSG:32661", UNKNOWN), box(2_100_000, 2_100_000)],
    ["Krovak", crsOf("EPSG:5514", UNKNOWN), box(-750_000, -1_050_000)],
    ["a code of ESRI's", crsOf("EPSG:102634", UNKNOWN, FOOT_US), box(1_500_000, 1_500_000)],
    ["a code of IGN's", crsOf("IGNF:RGF93LAMB93", UNKNOWN), box(650_000, 6_860_000)],
    ["a URN", crsOf("urn:ogc:def:crs:EPSG::2154", UNKNOWN), box(650_000, 6_860_000)],
    [
      "a projection without a name in WKT",
      crsOf("+proj=lsat +lsat=5 +path=220 +ellps=WGS84", UNKNOWN),
      box(17_742_000, -3_119_000),
    ],
    ["an ellipsoid by numbers", crsOf("EPSG:20135", UNKNOWN), box(500_000, 1_100_000)],
    ["Paris and grads", crsOf("EPSG:4807", UNKNOWN), box(0, 54, 0.1)],
    ["degrees across the antimeridian", crsOf("EPSG:4326", UNKNOWN), box(179.95, 54, 0.1)],
    ["an offset of longitude and latitude", crsOf("EPSG:2000", UNKNOWN), box(285_000, 2_012_000)],
    ["an offset before a shift", crsOf("EPSG:4120", UNKNOWN), box(23, 38, 0.1)],
    ["heights by an offset", crsOf("EPSG:7414", GEOID), box(140, 36, 0.1)],
    [
      "a zone across the antimeridian",
      crsOf("EPSG:32660", { kind: "ellipsoidal" }),
      box(690_000, 100_000, 30_000),
    ],
    ["degrees from 0 to 360", crsOf("EPSG:4326+5773", GEOID), box(289.9, 44, 0.1)],
  ])("is met in %s", async (_, crs, domain) => {
    const { report } = await projTransformation(plain!, crs, domain);
    expect(report.checkedPoints).toBeGreaterThan(500);
    expect(report.worstDifference).toBeLessThan(1e-5);
    expect(report.ballpark).toBe(false);
  });

  it("gets z in the unit that the data are in, whatever the vertical CRS has", async () => {
    const domain = box(500_000, 5_500_000);
    const evaluate = async (unit: Crs["verticalUnit"], z: number) => {
      const crs = crsOf("EPSG:32633+5773", GEOID, unit);
      const { transformation } = await projTransformation(plain!, crs, domain);
      const out = new Float64Array(3);
      compileTransformation(transformation).evaluate(502_000, 5_502_000, z, out, 0);
      return out;
    };
    const [metres, feet] = [await evaluate(METRE, 30.48), await evaluate({ ...FOOT, declared: true }, 100)];
    expect(Math.hypot(...metres.map((value, i) => value - feet[i]))).toBeLessThan(1e-8);
  });

  it("names the grids that it lacks, and gives heights by EGM96 instead of taking them for ellipsoidal", async () => {
    const domain = box(500_000, 5_500_000);
    const { report, transformation } = await projTransformation(
      plain!,
      crsOf("EPSG:25832+7837", GEOID),
      domain,
    );
    expect(report.accuracy).toBeLessThanOrEqual(1);
    expect(report.lacking[0].grids.length).toBeGreaterThan(0);
    expect(report.notes.join()).toMatch(/EGM96/);
    expect(transformation.steps.map(({ kind }) => kind)).toContain("verticalShift");
  });

  it.each([
    ["DHHN2016", "EPSG:25832+7837"],
    ["DHHN2016, as many write it", "EPSG:4647+7837"],
  ])("gives German heights (%s) by the grid as it is named today, not by EGM96", async (_, code) => {
    const folder = mkdtempSync(join(tmpdir(), "groma-german-"));
    try {
      writeFileSync(join(folder, "de_bkg_gcg2016.tif"), geoTiff("vertical", [8.8, 49.7]));
      const german = (await findProj({ grids: folder }))!;
      const domain = code.includes("4647")
        ? box(32_500_000, 5_480_000, 15_000)
        : box(500_000, 5_480_000, 15_000);
      const { report, transformation } = await projTransformation(german, crsOf(code, GEOID), domain);
      expect(report).toMatchObject({ grids: ["de_bkg_gcg2016.tif"], ballpark: false, notes: [] });
      expect(report.accuracy).toBeLessThanOrEqual(1.1);
      expect(transformation.steps.map(({ kind }) => kind)).toContain("verticalShift");
      expect(report.worstDifference).toBeLessThan(1e-5);
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  });

  it.each([
    ["EPSG:32632+5715", 1],
    ["EPSG:32618+6358", 1200 / 3937],
  ])("lays the depths of %s downwards, without a geoid of its own", async (code, unit) => {
    const crs = crsOf(code, { kind: "geoid", model: "depth" }, { ...METRE, size: -unit });
    const { transformation, report } = await projTransformation(plain!, crs, box(500_000, 5_000_000, 100));
    const [ecef, place] = [new Float64Array(3), new Float64Array(3)];
    compileTransformation(transformation).evaluate(500_050, 5_000_050, 100, ecef, 0);
    ecefToGeodetic(ecef[0], ecef[1], ecef[2], place);
    expect(place[2]).toBeCloseTo(-100 * unit, 6);
    expect(report.grids).toEqual([]);
  });

  it("says so when z is only taken for ellipsoidal", async () => {
    const { report } = await projTransformation(plain!, crsOf("EPSG:3067", UNKNOWN), box(400_000, 7_000_000));
    expect(report.notes).toEqual([expect.stringMatching(/height reference unknown/)]);
  });

  it.each([
    ["a geocentric CRS", crsOf("EPSG:4978", UNKNOWN), box(3_900_000, 300_000), "CRS_OPERATION_UNSUPPORTED"],
    ["a vertical CRS", crsOf("EPSG:5728", UNKNOWN), box(0, 0), "CRS_UNSUPPORTED"],
    ["a CRS of nothing", crsOf("EPSG:999999", UNKNOWN), box(0, 0), "CRS_UNKNOWN"],
    ["a place where the projection has none", crsOf("EPSG:32633", UNKNOWN), box(1e9, 1e9), "PLACE_DOMAIN"],
  ])("is refused by name with %s", async (_, crs, domain, code) => {
    await expect(projTransformation(plain!, crs, domain)).rejects.toMatchObject({ code });
  });

  it("refuses grids of the user's own that lie outside of PROJ's folders", async () => {
    const crs = { ...crsOf("", UNKNOWN), code: undefined as never, name: "x" };
    const text = "+proj=utm +zone=33 +ellps=bessel +nadgrids=/etc/passwd +type=crs";
    await expect(projTransformation(plain!, crs, box(500_000, 5_500_000), { text })).rejects.toThrow(
      expect.objectContaining({ code: expect.stringMatching(/^(CRS|PROJ)_/) }),
    );
  });
});

interface Format {
  readonly code: string;
  readonly fmts: Readonly<Record<string, string | object>>;
}

describe.skipIf(!proj)(`every operation for the CRSs of the table of formats${without}`, () => {
  const formats: readonly Format[] = proj
    ? JSON.parse(readFileSync(`${dataFolder}/truth/crs_formats.json`, "utf8"))
    : [];

  it.each(formats.map(({ code }) => code))("is understood or refused by name: EPSG:%s", async (code) => {
    const operations = await listOperations(proj!, { name: code, text: `EPSG:${code}` });
    expect(operations.length).toBeGreaterThan(0);
    for (const { pipeline, name } of operations) {
      try {
        expect(parsePipeline(pipeline!).steps.at(-1)?.kind, name).toBe("geocentric");
      } catch (error) {
        // NADCON5, which PROJ writes so from 9.2 on.
        expect(error).toMatchObject({ code: "CRS_OPERATION_UNSUPPORTED" });
        expect(pipeline).toContain("+proj=gridshift");
      }
    }
  });

  it.each(formats.filter((_, i) => i % 5 === 1))(
    "is the same from WKT and PROJJSON: $code",
    async ({ code, fmts }) => {
      const first = async (text: string) => (await listOperations(proj!, { name: code, text }))[0];
      const { pipeline } = await first(`EPSG:${code}`);
      for (const key of ["WKT2_2019", "PROJJSON"]) {
        const text = typeof fmts[key] === "string" ? fmts[key] : JSON.stringify(fmts[key]);
        expect((await first(text)).pipeline, key).toBe(pipeline);
      }
    },
  );
});

describe.skipIf(!plain)(`the reading of a pipeline${absent}`, () => {
  it("agrees with PROJ about the multiplier of heights", async () => {
    const steps = parsePipeline(
      "+proj=pipeline +step +inv +proj=utm +zone=33 +ellps=WGS84 +step +proj=vgridshift +grids=egm96_15.gtx +step +proj=cart +ellps=WGS84",
    );
    const shifted = steps.steps.find(({ kind }) => kind === "verticalShift");
    expect(shifted).toMatchObject({ multiplier: -1 });
    const point = Float64Array.of(500_000, 5_500_000, 0);
    const [, , height] = await runPipeline(plain!, steps.pipeline.slice(0, 2), point);
    expect(height).toBeLessThan(-30);
  });
});
