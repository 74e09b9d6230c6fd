import { describe, expect, it } from "vitest";
import { findProj } from "../proj/program/find.js";
import { georeference } from "./georeference.js";
import { makeRecords } from "./records.js";

const proj = await findProj();

type Corner = [number, number, number];

/** The parts of what a data set is worth, metres, by their names. */
async function worth(crs: string, min: Corner, max: Corner) {
  const system = await georeference({ file: "scan.las" }, { crs, engine: "proj" });
  const bounds = { min, max };
  const surroundings = { text: crs.startsWith("+") ? crs : undefined, file: "scan.las" };
  const { georeference: record } = await makeRecords(
    ...([system, bounds, [1e-7, 1e-7, 1e-3], { engine: "proj" }, surroundings] as const),
  );
  return new Map(record.accuracy.map(({ name, metres }) => [name, metres]));
}

describe.skipIf(!proj)(`what a place is worth by PROJ${proj ? "" : " (skipped: PROJ is not there)"}`, () => {
  it.each([
    ["over the antimeridian", "EPSG:4979", [179.99, -17.01, 0], [180.01, -16.99, 50]],
    ["around a pole", "EPSG:3413", [-3000, -3000, 0], [3000, 3000, 50]],
    ["by another name", "OGC:CRS84h", [9, 48, 0], [9.01, 48.01, 50]],
    ["in a plane of ESRI's", "ESRI:54030", [8e5, 5e6, 0], [801_000, 5_001_000, 50]],
    ["in one that PROJ alone knows", "+proj=igh +datum=WGS84", [8e5, 5e6, 0], [801_000, 5_001_000, 50]],
  ] as const)("WGS 84 is an ensemble of two metres %s", async (_, crs, min, max) => {
    expect((await worth(crs, [...min], [...max])).get("datum operation")).toBe(2);
  });
});
