import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, describe, expect, test } from "vitest";
import { findPdal, type Pdal } from "../../converter/cli/pdal/find.js";
import { data } from "../project.js";
import { runPython } from "../python.js";
import { refereesMissing, titled } from "./comparison.js";
import { groma, gromaJson } from "./groma.js";

const pdal: Pdal | undefined = await findPdal(undefined, "").catch(() => undefined);
const pdalMissing = pdal ? undefined : "PDAL is not there: run converter/scripts/install-pdal";
const e57 = data("las-variants/A_B.e57");
const las = data("las-variants/las__autzen_trim.las");
const folder = mkdtempSync(join(tmpdir(), "groma-pdal-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const ANCHOR = ["--anchor", "7.9,46.5,800,0"];

interface Points {
  integers: [number[], number[], number[]];
  scale: number[];
  offset: number[];
  dimensions: Record<string, number[]>;
}

interface Done {
  points: number;
  pdal: { scale: number[]; asStored: boolean; keptAside: string[]; rounded: string[]; streamed: boolean }[];
}

/** Converts, and reads the result with laspy. */
function converted(name: string, ...args: string[]): { done: Done; points: Points } {
  const output = join(folder, name);
  const done = gromaJson<Done>(["convert", ...args, output, "--progress", "json"]);
  // What PDAL wrote for the core is gone.
  expect(readdirSync(folder).filter((file) => file.startsWith("."))).toEqual([]);
  return { done, points: runPython<Points>("interop/pdal_points.py", [output]) };
}

/** The points of a file in PDAL's own words, 12 digits behind the point, sorted. */
function told(file: string, order: string): number[][] {
  const text = join(folder, "told.csv");
  const writer = { order, precision: 12, keep_unspecified: false };
  const options = Object.entries(writer).map(([name, value]) => `--writers.text.${name}=${value}`);
  execFileSync(pdal!.program, ["translate", file, text, "-w", "text", ...options]);
  const [, ...rows] = readFileSync(text, "utf8").trim().split("\n");
  return rows.map((row) => row.split(",").map(Number)).sort((a, b) => a[0]! - b[0]!);
}

describe("what PDAL reads", () => {
  const missing = pdalMissing ?? refereesMissing;

  test.skipIf(missing ?? e57.missing)(
    titled("E57: every point, rounded by no more than is said", missing ?? e57.missing),
    () => {
      const { done, points } = converted("e57.copc.laz", e57.path, ...ANCHOR);
      expect(done.points).toBe(6);
      expect(done.pdal[0]).toMatchObject({ streamed: true, asStored: false, keptAside: [], rounded: [] });
      const expected = told(e57.path, "X,Y,Z,Red,Green,Blue,Intensity");
      const { integers, scale, offset, dimensions } = points;
      expect(scale).toEqual(done.pdal[0]!.scale);
      const found = integers[0]
        .map((_, i) => [
          ...[0, 1, 2].map((axis) => integers[axis]![i]! * scale[axis]! + offset[axis]!),
          ...["red", "green", "blue", "intensity"].map((name) => dimensions[name]![i]!),
        ])
        .sort((a, b) => a[0]! - b[0]!);
      expect(found).toHaveLength(expected.length);
      for (const [i, row] of found.entries()) {
        for (const axis of [0, 1, 2]) {
          expect(Math.abs(row[axis]! - expected[i]![axis]!)).toBeLessThanOrEqual(scale[axis]! / 2 + 1e-12);
        }
        expect(row.slice(3)).toEqual(expected[i]!.slice(3));
      }
    },
  );

  test.skipIf(missing)(
    titled("text: extra dimensions stay, and what LAS's fields cannot hold", missing),
    () => {
      const rows = [
        [2600000.1234, 1200000.5, 400.25, -1000, 1, 0.25],
        [2600001.1234, 1200001.5, 401.25, 2000, 10, 0.5],
        [2600002.1235, 1200002.5, 402.25, 3000, 100, -0.125],
      ];
      const file = join(folder, "points.txt");
      writeFileSync(file, `X Y Z Intensity Red Depth\n${rows.map((row) => row.join(" ")).join("\n")}\n`);
      const { done, points } = converted("text.copc.laz", file, "--crs", "EPSG:2056");
      expect(done.pdal[0]).toMatchObject({ keptAside: ["IntensityAsRead"], rounded: ["Red"] });
      expect(points.dimensions.IntensityAsRead).toEqual([-1000, 2000, 3000]);
      expect(points.dimensions.intensity).toEqual([0, 0, 0]);
      expect(points.dimensions.Depth).toEqual([0.25, 0.5, -0.125]);
      expect(points.dimensions.red).toEqual([1, 10, 100]);
      const x = points.integers[0].map((value) => value * points.scale[0]! + points.offset[0]!);
      for (const [i, row] of rows.entries()) expect(x[i]).toBeCloseTo(row[0]!, 6);
      const coarse = converted("coarse.copc.laz", file, "--crs", "EPSG:2056", "--scale", "0.01");
      expect(coarse.points.scale).toEqual([0.01, 0.01, 0.01]);
    },
  );

  test.skipIf(missing ?? las.missing)(
    titled("a pipeline over LAS leaves its integers alone", missing ?? las.missing),
    () => {
      const pipeline = join(folder, "ground.json");
      writeFileSync(pipeline, JSON.stringify([{ type: "filters.range", limits: "Classification[2:2]" }]));
      const { done, points } = converted("ground.copc.laz", las.path, "--pipeline", pipeline);
      expect(done.pdal[0]).toMatchObject({ asStored: true, streamed: true });
      const source = runPython<Points>("interop/pdal_points.py", [las.path]);
      const key = ({ integers }: Points, i: number) => integers.map((axis) => axis[i]).join();
      const ground = source.integers[0].flatMap((_, i) =>
        source.dimensions.classification![i] === 2 ? [key(source, i)] : [],
      );
      expect(points.integers[0].map((_, i) => key(points, i)).sort()).toEqual(ground.sort());
      expect(points.scale).toEqual(source.scale);
      expect(points.offset).toEqual(source.offset);
    },
  );

  test.skipIf(missing)(
    titled("coordinates that are no numbers are refused, and leave nothing", missing),
    () => {
      const file = join(folder, "nan.txt");
      writeFileSync(file, "X Y Z\n1 2 3\nnan 2 3\n");
      const { code, stderr } = groma(["convert", file, join(folder, "nan.copc.laz"), "--crs", "EPSG:2056"]);
      expect(code).toBe(1);
      expect(stderr).toMatch(/PDAL_COORDINATES: .*nan\.txt: .*filters\.range/);
      expect(readdirSync(folder).filter((name) => name.includes("nan"))).toEqual(["nan.txt"]);
    },
  );
});
