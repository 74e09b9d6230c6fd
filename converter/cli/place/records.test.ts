import { describe, expect, it } from "vitest";
import { findProj } from "../proj/program/find.js";
import { georeference } from "./georeference.js";
import { makeRecords } from "./records.js";

const proj = await findProj();

type Corner = readonly [number, number, number];

const GOODE =
  'PROJCS["x",GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Goode_Homolosine"],PARAMETER["False_Easting",0.0],PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",0.0],PARAMETER["Option",1.0],UNIT["Meter",1.0]]';
const SHIFTED =
  'VERTCS["EGM96_Geoid",VDATUM["EGM96_Geoid"],PARAMETER["Vertical_Shift",25.0],PARAMETER["Direction",1.0],UNIT["Meter",1.0]]';

/** What a data set is worth by PROJ, metres, by the names of the parts. */
async function worth(crs: string, [x, y, z]: Corner, width: number) {
  const system = await georeference({ file: "scan.las" }, { crs, engine: "proj" });
  const bounds = { min: [x, y, z], max: [x + width, y + width, z + 50] } as const;
  const { georeference: record } = await makeRecords(
    ...([system, bounds as never, [1e-7, 1e-7, 1e-3], { engine: "proj" }, { file: "scan.las" }] as const),
  );
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
});
