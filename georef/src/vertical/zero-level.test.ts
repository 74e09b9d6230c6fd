import { describe, expect, it } from "vitest";
import type { Crs } from "../crs/crs.js";
import { deriveTransformation } from "../georeference/derive.js";
import { accuracyParts } from "../record/accuracy.js";
import { EGM96, egm96Grid } from "./egm96.js";
import { isAboveGeoid, ownLevel, ownLevelNote } from "./zero-level.js";

const METRE = { name: "metre", kind: "linear", size: 1 } as const;
const crsOf = (model: string, epsg?: number, size = 1): Crs => ({
  name: "scan",
  proj4: "+proj=utm +zone=33 +a=6378137 +rf=298.257223563 +towgs84=0,0,0 +units=m +no_defs",
  horizontalUnit: METRE,
  verticalUnit: { ...METRE, size, declared: true },
  height: { kind: "geoid", model, ...(epsg !== undefined && { epsg }) },
});

describe("heights that count from a level of their own", () => {
  it.each([
    ["Vienna height", 8881, 1, 157],
    ["Caspian height", 5611, 1, 28],
    ["MHHW height", 5869, 1, 9],
    ["LAT depth", 5861, -1, 9],
    ["NAVD88 depth", 6357, -1, 0.5],
  ])("%s", (model, epsg, size, offset) => {
    expect(ownLevel(crsOf(model, epsg, size))).toEqual({ offset });
  });

  it.each([
    ...[
      "Local site datum",
      "Plant height",
      "Chart datum",
      "assumed heights",
      "Vienna_height",
      "Caspian_height",
    ],
    ...["AIOC95_Height", "KOC_Construction_Datum", "Kiunga_(height)", "Instantaneous_Water_Level_Height"],
  ])("%s, without a code", (model) => {
    expect(ownLevel(crsOf(model))).toEqual({ offset: null });
  });

  it("are depths of any name", () => {
    expect(ownLevel(crsOf("NAP", undefined, -1))).toEqual({ offset: null });
  });

  it("are not those of countries, whether they have a code or not", () => {
    for (const [model, epsg] of [
      ["NAP height", 5709],
      ["Ostend height", 5710],
      ["NAVD88 - Geoid12B (metres)", undefined],
      ["Flat Amsterdam height", undefined],
    ] as const) {
      expect(isAboveGeoid(crsOf(model, epsg))).toBe(true);
    }
  });

  it("are not ellipsoidal or unknown ones, which are above no geoid either", () => {
    const { verticalUnit } = crsOf("");
    for (const kind of ["ellipsoidal", "unknown"] as const) {
      expect(ownLevel({ verticalUnit, height: { kind } })).toBeUndefined();
      expect(isAboveGeoid({ verticalUnit, height: { kind } })).toBe(false);
    }
  });
});

describe("what is done with them", () => {
  const egm96 = egm96Grid(() => 45);
  const domain = { minX: 600_000, minY: 5_340_000, minZ: 0, maxX: 600_100, maxY: 5_340_100, maxZ: 10 };

  it("no geoid is applied, and depths go down", async () => {
    const kinds = async (crs: Crs) =>
      (await deriveTransformation(crs, domain, { egm96 })).steps.map(({ kind }) => kind);
    expect(await kinds(crsOf("GHA height", 5778))).toContain("verticalShift");
    expect(await kinds(crsOf("Vienna height", 8881))).toEqual(["projection", "geocentric"]);
    const { steps } = await deriveTransformation(crsOf("LAT depth", 5861, -1), domain, { egm96 });
    expect(steps[1]).toEqual({ kind: "height", metresPerUnit: -1 });
  });

  it("their accuracy is unknown, with the size that it may have", () => {
    const placing = { operation: { name: "one", accuracy: 1, ballpark: false }, geoids: [] };
    const part = (crs: Crs, geoids: readonly string[] = []) =>
      accuracyParts(crs, [0.001, 0.001, 0.001], 0.001, { ...placing, geoids }).find(
        ({ name }) => name === "height",
      );
    expect(part(crsOf("Vienna height", 8881))).toMatchObject({
      metres: null,
      note: expect.stringContaining("264 m"),
    });
    // PROJ's own way with the country's grids is another matter.
    expect(part(crsOf("Vienna height", 8881), ["grid.tif"])?.metres).toBe(0);
    expect(part(crsOf("NAP height", 5709), [EGM96])?.metres).toBe(4);
  });

  it("that size is the distance from sea level and the geoid's from the ellipsoid", () => {
    const vienna = crsOf("Vienna height", 8881);
    expect(ownLevelNote(vienna, { offset: 157 }, 43.2)).toMatch(/^Vienna height: .* by up to 201 m$/);
    expect(ownLevelNote(vienna, { offset: null }, -43.2)).toMatch(/by 44 m and as much as its zero/);
  });
});
