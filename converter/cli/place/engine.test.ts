import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { compileTransformation, ecefToGeodetic, resolveCrs } from "@groma/georef";
import proj4 from "proj4";
import { afterAll, describe, expect, it } from "vitest";
import { findProj } from "../proj/program/find.js";
import { chosenProj, engineTransformation } from "./engine.js";
import { epsg } from "./epsg.js";
import { georeference } from "./georeference.js";
import { withKnownShift } from "./known-shift.js";

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

  it.skipIf(!here).each([
    ["+proj=utm +zone=33 +south +datum=WGS84 +geoidgrids=@null", 500_123, 7_788_876],
    [
      "+proj=merc +a=6378137 +b=6378137 +nadgrids=@null +wktext +no_defs +geoidgrids=@null",
      1_669_792,
      6_446_275,
    ],
    ["+proj=utm +zone=33 +ellps=bessel +nadgrids=@nosuch.gsb,null", 500_123, 5_499_876],
  ])(`lifts and shifts nothing for %s, as PROJ does${absent}`, async (text, x, y) => {
    const { crs: named } = await georeference({ file }, { crs: text });
    const around = { minX: x - 50, minY: y - 50, minZ: 400, maxX: x + 50, maxY: y + 50, maxZ: 420 };
    const { transformation, report } = await engineTransformation(
      named,
      around,
      { engine: "proj" },
      { file, text },
    );
    expect(named.height.kind).toBe("unknown");
    expect(report).toMatchObject({ ballpark: false, grids: [], lacking: [] });
    const ecef = new Float64Array(3);
    const geodetic = new Float64Array(3);
    compileTransformation(transformation).forward(x, y, 412.5, ecef);
    ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, geodetic);
    expect(geodetic[2]).toBeCloseTo(412.5, 6);
    const [longitude, latitude] = proj4(text.replace(/\+nadgrids=@nosuch\S*|\+geoidgrids=\S+/, "")).inverse([
      x,
      y,
    ]);
    expect((geodetic[0]! * 180) / Math.PI).toBeCloseTo(longitude, 9);
    expect((geodetic[1]! * 180) / Math.PI).toBeCloseTo(latitude, 9);
  });

  it.skipIf(!here)(
    `takes PROJ's first operation far from all areas, of unknown accuracy${absent}`,
    async () => {
      const far = {
        minX: -8_242_596,
        minY: 4_966_606,
        minZ: 400,
        maxX: -8_242_500,
        maxY: 4_966_706,
        maxZ: 420,
      };
      const { transformation, report } = await engineTransformation(crs, far, { engine: "proj" }, { file });
      expect(report).toMatchObject({ ballpark: false, unstated: true, accuracy: null });
      expect(report.notes.join()).toMatch(/no operation of PROJ is meant for this place/);
      expect(withKnownShift(report, crs, compileTransformation(transformation), far).accuracy).toBeNull();
      // By cs2cs of PROJ 9.6.
      const ecef = new Float64Array(3);
      compileTransformation(transformation).forward(-8_242_596, 4_966_606, 412.5, ecef);
      expect(
        Math.hypot(ecef[0]! + 652511.8791, ecef[1]! + 5482054.0082, ecef[2]! - 3184160.6941),
      ).toBeLessThan(1e-3);
    },
  );

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
