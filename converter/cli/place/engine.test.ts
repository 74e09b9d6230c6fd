import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { resolveCrs } from "@groma/georef";
import { afterAll, describe, expect, it } from "vitest";
import { findProj } from "../proj/program/find.js";
import { chosenProj, engineTransformation } from "./engine.js";
import { epsg } from "./epsg.js";

const folder = mkdtempSync(join(tmpdir(), "groma-engine-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const here = (await findProj()) !== undefined;
const absent = here ? "" : " (skipped: PROJ is not installed)";
const crs = resolveCrs({ file: "scan", given: "EPSG:28992" }, epsg);
const domain = { minX: 150_000, minY: 450_000, minZ: 0, maxX: 151_000, maxY: 451_000, maxZ: 50 };
const file = "scan.las";

describe("the engine", () => {
  it("is proj4js where it is asked for", async () => {
    const { report } = await engineTransformation(crs, domain, { engine: "proj4js" }, { file });
    expect(report.engine.name).toBe("proj4js");
    expect(report.notes.join()).toMatch(/without PROJ/);
  });

  it("is not proj4js with grids of PROJ", async () => {
    await expect(chosenProj({ engine: "proj4js", grids: folder })).rejects.toMatchObject({
      code: "OPTION_ENGINE",
    });
  });

  it("is not looked for anywhere but in the folder that was given", async () => {
    await expect(chosenProj({ proj: folder })).rejects.toMatchObject({ code: "PROJ_MISSING" });
  });

  it.skipIf(!here)(`is PROJ where it is found${absent}`, async () => {
    const { report } = await engineTransformation(crs, domain, {}, { file });
    expect(report.engine.name).toBe("PROJ");
  });

  it.skipIf(!here)(`gives way to proj4js where PROJ refuses, and says why${absent}`, async () => {
    const surroundings = { file, text: "+proj=nowhere" };
    const { report } = await engineTransformation(crs, domain, {}, surroundings);
    expect(report.engine.name).toBe("proj4js");
    expect(report.notes[0]).toMatch(
      /^PROJ .* was found, but its way cannot be followed: PROJ does not understand/,
    );
    await expect(engineTransformation(crs, domain, { engine: "proj" }, surroundings)).rejects.toMatchObject({
      code: "CRS_UNKNOWN",
    });
  });
});
