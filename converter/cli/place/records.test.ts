import { pointTransform, truthOf } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { findProj } from "../proj/program/find.js";
import { written } from "../proj/source.js";
import { type Given, georeference } from "./georeference.js";
import { makeRecords } from "./records.js";

const proj = await findProj();

type Corner = readonly [number, number, number];

const METRE = 'LENGTHUNIT["metre",1]';
const GOODE =
  'PROJCS["x",GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Goode_Homolosine"],PARAMETER["False_Easting",0.0],PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",0.0],PARAMETER["Option",1.0],UNIT["Meter",1.0]]';
const SHIFTED =
  'VERTCS["EGM96_Geoid",VDATUM["EGM96_Geoid"],PARAMETER["Vertical_Shift",25.0],PARAMETER["Direction",1.0],UNIT["Meter",1.0]]';

/** The records of a data set by PROJ. */
async function records(given: Pick<Given, "crs" | "vertical">, [x, y, z]: Corner, width: number) {
  const system = await georeference({ file: "scan.las" }, { ...given, engine: "proj" });
  const bounds = { min: [x, y, z], max: [x + width, y + width, z + 50] } as const;
  return makeRecords(
    ...([system, bounds as never, [1e-7, 1e-7, 1e-3], { engine: "proj" }, { file: "scan.las" }] as const),
  );
}

/** What a data set is worth by PROJ, metres, by the names of the parts. */
async function worth(...[crs, corner, width]: [crs: string, corner: Corner, width: number]) {
  const { georeference: record } = await records({ crs }, corner, width);
  return new Map(record.accuracy.map(({ name, metres }) => [name, metres]));
}

describe.skipIf(!proj)(`what a place is worth by PROJ${proj ? "" : " (skipped: PROJ is not there)"}`, () => {
  it("counts the ensemble of WGS 84 at the antimeridian too", async () => {
    expect((await worth("EPSG:4979", [179.99, -17.01, 0], 0.02)).get("datum operation")).toBe(2);
  });

  it("is not known of heights with a shift that PROJ passes over, where PROJ alone knows the plane", async () => {
    const parts = await worth(`${GOODE},${SHIFTED}`, [8e5, 5e6, 0], 1000);
    expect([parts.get("datum operation"), parts.get("height")]).toEqual([2, null]);
  });

  it("is that of the plane with the heights that are given in place of those of a third axis", async () => {
    const three = await written(proj!, { name: "RD", text: "EPSG:28992" }, "WKT2:2019").then((wkt) =>
      wkt
        .replace(/,ID\["EPSG",28992\]\]$/, "]")
        .replace(
          /CS\[Cartesian,2\].*?(?=,USAGE)/,
          `CS[Cartesian,3],AXIS["x",east],AXIS["y",north],AXIS["h",up],${METRE}`,
        ),
    );
    const at = [155_000, 463_000, 0] as const;
    const place = async (given: Pick<Given, "crs" | "vertical">) => {
      const { transformation, georeference: record } = await records(given, at, 100);
      expect(record.engine.name).toBe("PROJ");
      const ecef = new Float64Array(3);
      pointTransform(truthOf({ crs: record.crs, transformation }, 0, "scan.las"))(...at, ecef, 0);
      return ecef;
    };
    for (const vertical of ["ellipsoidal", "EPSG:5709"]) {
      const [own, plain] = [
        await place({ crs: three, vertical }),
        await place({ crs: "EPSG:28992", vertical }),
      ];
      expect(Math.hypot(...own.map((value, i) => value - plain[i]!))).toBeLessThan(1e-6);
    }
    const [bessel, plain] = [await place({ crs: three }), await place({ crs: "EPSG:28992" })];
    expect(Math.hypot(...bessel.map((value, i) => value - plain[i]!))).toBeCloseTo(43.35, 1);
  });
});
