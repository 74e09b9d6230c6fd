import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import {
  compileTransformation,
  type Domain,
  decodeTransformation,
  encodeTransformation,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { georeference } from "../../converter/cli/place/georeference.js";
import { geoTiff } from "../../converter/cli/proj/grids/geotiff.fixture.js";
import { findProj } from "../../converter/cli/proj/program/find.js";
import { projTransformation } from "../../converter/cli/proj/transformation.js";
import { proj, projMissing } from "../proj.js";
import { pythonMissing, runPython } from "../python.js";
import { distance } from "./groma.js";

const missing = projMissing ?? pythonMissing;
const METRE = { name: "metre", kind: "linear", size: 1, declared: true } as const;
/** Points along each side of a data set. */
const SIDE = 9;

/** Folder of PROJ's database, which the referee reads too. */
function database(): string {
  const folder = proj!.directories.find((directory) => existsSync(join(directory, "proj.db")));
  if (folder === undefined) throw new Error("PROJ's database is in none of its folders");
  return folder;
}

function raster({ minX, minY, maxX, maxY }: Domain): number[][] {
  const at = (from: number, to: number, i: number) => from + ((to - from) * i) / (SIDE - 1);
  return Array.from({ length: SIDE * SIDE }, (_, i) => [
    at(minX, maxX, i % SIDE),
    at(minY, maxY, Math.floor(i / SIDE)),
    50,
  ]);
}

describe.skipIf(missing)(
  `data across the areas of operations${missing ? ` (skipped: ${missing})` : ""}`,
  () => {
    it.each([
      // Spain's operation of ED50 ends at 43.56° N; France's goes on.
      ["EPSG:23031", 400_000, 4_700_000, 100_000, 200_000],
      // Alaska and Yukon, NAD27.
      ["EPSG:26707", 450_000, 6_900_000, 100_000, 100_000],
      // Sinai, Israel and Jordan.
      ["EPSG:23036", 550_000, 3_300_000, 250_000, 300_000],
      // Six operations of ED50; one for the sea stands between them in PROJ's list.
      ["EPSG:4230", -1.2, 42.8, 22.4, 14.4],
    ])("%s at %i, %i: every point lies where PROJ puts it", async (code, minX, minY, width, height) => {
      const domain = { minX, minY, minZ: 0, maxX: minX + width, maxY: minY + height, maxZ: 100 };
      const crs = { name: code, code, proj4: "", horizontalUnit: METRE, verticalUnit: METRE } as const;
      const { transformation, report } = await projTransformation(
        proj!,
        { ...crs, height: { kind: "unknown" } },
        domain,
      );
      const points = raster(domain);
      const theirs = runPython<(number[] | null)[]>(
        "interop/point_by_point.py",
        [code, database()],
        JSON.stringify(points),
      );
      const { evaluate } = compileTransformation(transformation);
      const ecef = new Float64Array(3);
      const far = points.map(([x, y, z], i) => {
        evaluate(x!, y!, z!, ecef, 0);
        return theirs[i] ? distance([...ecef], theirs[i]) : 0;
      });
      const farthest = Math.max(...far);
      console.info(`${code}: ${farthest} m, ${report.accuracy} m stated by ${report.operation}`);
      expect(farthest).toBeLessThan(1e-3);
      expect(report.accuracy ?? 999).toBeGreaterThan(1);
      expect(report.notes.join()).toMatch(/points are placed by another operation, as PROJ does/);
    });
    it.each([
      ["EPSG:9308", 2023.25],
      ["EPSG:9308", undefined],
      ["EPSG:9000", 2020.5],
    ])("%s, whose operation changes with time, at the epoch %s", async (code, epoch) => {
      const domain = { minX: 145.5, minY: -37.2, minZ: 0, maxX: 145.51, maxY: -37.19, maxZ: 100 };
      const file = epoch === undefined ? code : `${code}@${epoch}`;
      const { crs } = await georeference({ file }, { crs: file });
      expect(crs.code).toBe(file);
      const { transformation, report } = await projTransformation(proj!, crs, domain);
      expect(report).toMatchObject({ unstated: epoch === undefined, ballpark: false });
      expect(report.accuracy === null).toBe(epoch === undefined);
      const points = raster(domain);
      const theirs = runPython<number[][]>(
        "interop/point_by_point.py",
        [code, database()],
        JSON.stringify(epoch === undefined ? points : points.map((point) => [...point, epoch])),
      );
      const { forward } = compileTransformation(transformation);
      const ecef = new Float64Array(3);
      for (const [i, [x, y, z]] of points.entries()) {
        forward(x!, y!, z!, ecef);
        expect(distance([...ecef], theirs[i]!)).toBeLessThan(1e-3);
      }
    });

    it.each([
      // Two operations with one name; that for the smaller area is taken.
      ["EPSG:4901", 0, 53, 0.3],
      // Where the first that PROJ proposes is for the sea.
      ["EPSG:20255", 300_000, 6_679_000, 2_000],
    ])("%s: the one operation that PROJ takes everywhere is taken", async (code, minX, minY, size) => {
      const domain = { minX, minY, minZ: 0, maxX: minX + size, maxY: minY + size, maxZ: 100 };
      const crs = { name: code, code, proj4: "", horizontalUnit: METRE, verticalUnit: METRE } as const;
      const whole = { ...crs, height: { kind: "unknown" } } as const;
      const { transformation } = await projTransformation(proj!, whole, domain);
      const points = raster(domain);
      const theirs = runPython<number[][]>(
        "interop/point_by_point.py",
        [code, database()],
        JSON.stringify(points),
      );
      const { forward } = compileTransformation(transformation);
      const ecef = new Float64Array(3);
      for (const [i, [x, y, z]] of points.entries()) {
        forward(x!, y!, z!, ecef);
        expect(distance([...ecef], theirs[i]!)).toBeLessThan(1e-3);
      }
    });

    it("goes by the grid as far as that reaches, and by what PROJ takes beyond", async () => {
      const folder = mkdtempSync(join(tmpdir(), "groma-grid-end-"));
      try {
        // Not LINZ's: chance shifts under its name, which end within the data set at 174.85° E and 41.0° S.
        writeFileSync(join(folder, "nz_linz_nzgd2kgrid0005.tif"), geoTiff("horizontal", [174, -41]));
        const grids = (await findProj({ grids: folder }))!;
        const code = "EPSG:27200";
        const domain = {
          minX: 2_650_000,
          minY: 6_000_000,
          minZ: 0,
          maxX: 2_680_000,
          maxY: 6_040_000,
          maxZ: 100,
        };
        const crs = { name: code, code, proj4: "", horizontalUnit: METRE, verticalUnit: METRE } as const;
        const { transformation, report } = await projTransformation(
          grids,
          { ...crs, height: { kind: "unknown" } },
          domain,
        );
        const points = raster(domain);
        const theirs = runPython<(number[] | null)[]>(
          "interop/point_by_point.py",
          [code, `${folder}:${database()}`],
          JSON.stringify(points),
        );
        const { evaluate } = compileTransformation(
          decodeTransformation(encodeTransformation(transformation), code),
        );
        const ecef = new Float64Array(3);
        const far = points.map(([x, y, z], i) => {
          evaluate(x!, y!, z!, ecef, 0);
          return distance([...ecef], theirs[i]!);
        });
        expect(Math.max(...far)).toBeLessThan(1e-3);
        expect(report.grids).toEqual(["nz_linz_nzgd2kgrid0005.tif"]);
        expect(report.accuracy).toBeGreaterThanOrEqual(4);
        expect(report.notes.join()).toMatch(/points are placed by another operation, as PROJ does/);
      } finally {
        rmSync(folder, { recursive: true, force: true });
      }
    });
  },
);
