import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import {
  compileTransformation,
  cutWindow,
  decodeEgm96,
  deriveTransformation,
  EGM96_ACCURACY,
  egm96Undulation,
  resolveCrs,
  undulationOf,
  type VerticalSystem,
  verticalLookup,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { distance, random } from "../../georef/src/cartesian/points.fixture.js";
import { proj, projMissing } from "../proj.js";
import { data, projectRoot } from "../project.js";

const DEGREE = Math.PI / 180;
const grid = data("grids/us_nga_egm96_15.tif");
const missing = grid.missing ?? projMissing;
const skipped = missing ? ` (skipped: ${missing})` : "";

/** Half a centimetre, by which the nodes of the model are rounded, and what float32 costs PROJ. */
const ROUNDING = 0.0055;

const asset = (name: string) => readFileSync(join(projectRoot, "layer/dist/cloud", name));
const egm96 = decodeEgm96(asset("egm96.bin"), "egm96.bin");
const systems = JSON.parse(asset("vertical-systems.json").toString()) as VerticalSystem[];

/** `cct` over points; four columns, of which it prints as many. */
function cct(args: readonly string[], points: readonly (readonly number[])[]): number[][] {
  const input = points.map((point) => `${[...point, 0, 0].slice(0, 4).join(" ")}\n`).join("");
  const output = execFileSync(proj!.cct, ["-d", "9", ...args], { input, encoding: "utf8" });
  return output
    .trim()
    .split("\n")
    .map((line) => line.trim().split(/\s+/).map(Number));
}

describe("EGM96 as the page has it", () => {
  it.skipIf(missing)(`is PROJ's to half a centimetre all over the earth${skipped}`, () => {
    const next = random(96);
    const places = Array.from({ length: 4000 }, () => [
      360 * next() - 180,
      Math.asin(2 * next() - 1) / DEGREE,
    ]);
    places.push([0, 90], [0, -90], [180, 0], [-180, 12.3], [179.99, -17], [-179.99, 65.1], [0, 0]);
    const truth = cct(["+proj=vgridshift", `+grids=${grid.path}`, "+multiplier=1"], places);
    let worst = 0;
    for (const [i, [longitude, latitude]] of places.entries()) {
      const own = egm96Undulation(egm96, longitude * DEGREE, latitude * DEGREE);
      worst = Math.max(worst, Math.abs(own - truth[i][2]));
    }
    console.log(`EGM96, ${places.length} places: worst ${(1000 * worst).toFixed(2)} mm`);
    expect(worst).toBeLessThan(ROUNDING);
  });

  it("is the same from any turn, and across the antimeridian", () => {
    for (const longitude of [-179.9, 180.1, 540.1]) {
      expect(egm96Undulation(egm96, longitude * DEGREE, -16 * DEGREE)).toBeCloseTo(
        egm96Undulation(egm96, -179.9 * DEGREE, -16 * DEGREE),
        9,
      );
    }
    const bounds = { west: 179.2 * DEGREE, east: 181.1 * DEGREE, south: -17 * DEGREE, north: -16 * DEGREE };
    const across = undulationOf(cutWindow(egm96, bounds));
    const [west, east] = [179.9999, 180.0001].map((degrees) => across(degrees * DEGREE, -16.5 * DEGREE));
    expect(Math.abs(west - east)).toBeLessThan(0.001);
  });
});

describe("a height system given in the page", () => {
  const BERN = "+lat_0=46.9524055555556 +lon_0=7.43958333333333";
  const CASES = [
    {
      table: "grid_lv95_ln02.json",
      given: `+proj=somerc ${BERN} +k_0=1 +x_0=2600000 +y_0=1200000 +ellps=bessel +towgs84=674.374,15.056,405.346 +units=m`,
      vertical: "EPSG:5728",
      projection: `+proj=somerc ${BERN} +k_0=1 +x_0=2600000 +y_0=1200000 +ellps=bessel`,
      shift: "+proj=helmert +x=674.374 +y=15.056 +z=405.346",
    },
    {
      table: "grid_rd_nap.json",
      given:
        "+proj=sterea +lat_0=52.1561605555556 +lon_0=5.38763888888889 +k=0.9999079 +x_0=155000 +y_0=463000 +ellps=bessel +towgs84=565.4171,50.3319,465.5524,-0.398957388243134,0.343987817378283,-1.87740163998045,4.0725 +units=m",
      vertical: "EPSG:5709",
      projection:
        "+proj=sterea +lat_0=52.1561605555556 +lon_0=5.38763888888889 +k=0.9999079 +x_0=155000 +y_0=463000 +ellps=bessel",
      shift:
        "+proj=helmert +x=565.4171 +y=50.3319 +z=465.5524 +rx=-0.398957388243134 +ry=0.343987817378283 +rz=-1.87740163998045 +s=4.0725 +convention=position_vector",
    },
  ] as const;

  it.for(CASES)(
    "$vertical: as PROJ with EGM96 to half a centimetre, and within what is stated of the truth",
    async ({ table, given, vertical, projection, shift }, { skip }) => {
      const file = data(`truth/${table}`);
      skip((file.missing ?? missing) !== undefined, file.missing ?? missing);
      const { rows } = JSON.parse(readFileSync(file.path, "utf8")) as { rows: number[][] };
      const axis = (i: number) => rows.map((row) => row[i]);
      const [low, high] = [Math.min, Math.max].map((most) => [0, 1, 2].map((i) => most(...axis(i))));
      const domain = {
        ...{ minX: low[0], minY: low[1], minZ: low[2] },
        ...{ maxX: high[0], maxY: high[1], maxZ: high[2] },
      };
      const crs = resolveCrs({ file: table, given, givenVertical: vertical }, verticalLookup(systems));
      expect(crs.height).toMatchObject({ kind: "geoid", epsg: Number(vertical.slice(5)) });
      const { evaluate } = compileTransformation(await deriveTransformation(crs, domain, { egm96 }));
      const steps = [
        ...[`+inv ${projection}`, "+proj=push +v_3", "+proj=cart +ellps=bessel", shift],
        ...["+inv +proj=cart +ellps=WGS84", "+proj=pop +v_3"],
        ...[`+proj=vgridshift +grids=${grid.path} +multiplier=1`, "+proj=cart +ellps=WGS84"],
      ];
      const pipeline = ["+proj=pipeline", ...steps.map((step) => `+step ${step}`)].join(" ");
      const byProj = cct(pipeline.split(" "), rows);
      const own = new Float64Array(3);
      let [toProj, toTruth] = [0, 0];
      for (const [i, [x, y, z, ...truth]] of rows.entries()) {
        evaluate(x, y, z, own, 0);
        toProj = Math.max(toProj, distance(own, byProj[i].slice(0, 3)));
        toTruth = Math.max(toTruth, distance(own, truth));
      }
      console.log(
        `${vertical} by EGM96, ${rows.length} rows: ${(1000 * toProj).toFixed(2)} mm from PROJ's EGM96, ${toTruth.toFixed(2)} m from the truth`,
      );
      expect(toProj).toBeLessThan(ROUNDING);
      expect(toTruth).toBeLessThan(EGM96_ACCURACY);
      expect(toTruth).toBeGreaterThan(0.1);
    },
  );
});

describe("the table of height systems", () => {
  it("has what EPSG has, heights and depths apart", () => {
    const byCode = new Map(systems.map((system) => [system.code, system]));
    expect(systems.length).toBeGreaterThan(200);
    expect(byCode.get(5728)).toMatchObject({ name: "LN02 height", depth: false, unit: { size: 1 } });
    expect(byCode.get(8228)).toMatchObject({ name: "NAVD88 height (ft)", unit: { size: 0.3048 } });
    expect(byCode.get(5861)).toMatchObject({ depth: true });
    expect(byCode.get(5709)?.partners).toContain(28992);
    expect(byCode.has(2056)).toBe(false);
  });
});
