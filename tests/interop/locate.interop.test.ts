import { mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { ecefToGeodetic } from "@groma/georef";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { projMissing } from "../proj.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing } from "./core.js";
import { distance, groma, gromaJson, type Located, locate } from "./groma.js";

const grids = data("grids");

/** The tables: source coordinates with heights above a national zero, and ECEF by PROJ with its grids. */
const TABLES = [
  { name: "grid_rd_nap", crs: "EPSG:7415", wkt: "EPSG:7415" },
  { name: "grid_lv95_ln02", crs: "EPSG:2056+5728" },
  { name: "grid_lv03_ln02", crs: "EPSG:21781+5728" },
] as const;

/** x, y, z, X, Y, Z. */
type Row = [number, number, number, number, number, number];

const folder = mkdtempSync(join(tmpdir(), "groma-locate-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const tables = TABLES.map((table) => ({ ...table, ...data(`truth/${table.name}.json`) }));
const missing = pythonMissing ?? coreMissing ?? tables.find((table) => table.missing)?.missing;
const rowsOf = (path: string): Row[] => JSON.parse(readFileSync(path, "utf8")).rows;
const las = (name: string) => join(folder, `${name}.las`);

/** Rows of a square about the middle of a table, moved there; it has what a scan of that size has. */
function square(rows: readonly Row[], side: number): number[][] {
  const middle = (axis: number) => rows.reduce((sum, row) => sum + row[axis], 0) / rows.length;
  const [x, y] = [middle(0), middle(1)];
  return [0, 1, 2, 3].map((corner) => [
    x + (corner & 1 ? side : -side) / 2,
    y + (corner & 2 ? side : -side) / 2,
    10,
  ]);
}

interface Done {
  engine: { name: string };
  operation: { notes: string[]; grids: string[]; accuracy: number | null };
  accuracy: { total: number | null };
  recordBytes: number;
  transformationBytes: number;
}

const convert = (name: string, crs: string, out: string, ...more: string[]) =>
  gromaJson<Done>(["convert", las(name), out, "--crs", crs, "--progress", "json", "--overwrite", ...more]);

const withGrids = new Map<string, { out: string; done: Done }>();

/** A whole table converted with its grids, once for all tests. */
function converted({ name, crs }: { name: string; crs: string }): { out: string; done: Done } {
  const out = join(folder, `${name}.copc.laz`);
  const known = withGrids.get(name) ?? { out, done: convert(name, crs, out, "--grids", grids.path) };
  withGrids.set(name, known);
  return known;
}

beforeAll(() => {
  const jobs = tables.flatMap(({ name, path, ...table }) => {
    const rows = rowsOf(path);
    const whole = { path: las(name), scale: 0.01, rows, ...("wkt" in table && { wkt: table.wkt }) };
    const squares = [10, 50].map((km) => ({
      ...{ path: las(`${name}-${km}`), scale: 0.001, rows: square(rows, km * 1000) },
    }));
    return [whole, ...squares];
  });
  expect(runPython<number>("interop/make_las.py", [], JSON.stringify(jobs))).toBe(jobs.length);
});

describe.skipIf(missing ?? projMissing ?? grids.missing)("groma locate after a conversion with PROJ", () => {
  it.each(tables)("puts every row of $name within 1 mm", { timeout: 120_000 }, (table) => {
    const { out, done } = converted(table);
    expect(done.engine.name).toBe("PROJ");
    const { name, path } = table;
    const rows = rowsOf(path);
    const located = locate(out, rows);
    expect(located.length).toBe(rows.length);
    const worst = Math.max(...located.map(({ ecef }, i) => distance(ecef, rows[i].slice(3))));
    console.info(
      `${name}: worst ${(1000 * worst).toFixed(4)} mm of ${rows.length} rows, ` +
        `records ${done.recordBytes} + ${done.transformationBytes} bytes`,
    );
    expect(worst).toBeLessThanOrEqual(1e-3);
  });

  it("takes the heights of the file's own WKT", { timeout: 120_000 }, () => {
    const { name, path } = tables[0];
    const out = join(folder, "own.copc.laz");
    const args = ["convert", las(name), out, "--grids", grids.path, "--progress", "json"];
    expect(gromaJson<Done>(args).operation.grids).toContain("nl_nsgi_nlgeo2018.tif");
    const rows = rowsOf(path).slice(0, 100);
    for (const [i, { ecef }] of locate(out, rows).entries()) {
      expect(distance(ecef, rows[i].slice(3))).toBeLessThanOrEqual(1e-3);
    }
  });

  it.each(tables)("keeps the records of $name small", { timeout: 120_000 }, ({ name, crs }) => {
    for (const [km, most] of [
      [10, 8000],
      [50, 64_000],
    ] as const) {
      const { recordBytes, transformationBytes } = convert(
        ...([`${name}-${km}`, crs, join(folder, "small.copc.laz")] as const),
        ...["--grids", grids.path],
      );
      console.info(`${name}, ${km} km: ${recordBytes} + ${transformationBytes} bytes`);
      expect(recordBytes + transformationBytes).toBeLessThanOrEqual(most);
    }
  });

  it("leaves a COPC that others read, the transformation of a country behind its points", () => {
    const { path } = tables[1];
    const { out, done } = converted(tables[1]);
    const { transformationBytes } = done;
    expect(transformationBytes).toBeGreaterThan(65_535);
    const points = rowsOf(path).length;
    expect(runPython("interop/extended_record.py", [out])).toEqual({
      ...{ laspy: points, copclib: points },
      extended: [
        ["copc", 1000],
        ["groma", 3],
      ],
      bytes: transformationBytes,
    });
  });

  it("finds the coordinates of rows again, from wherever they are given", { timeout: 120_000 }, () => {
    const table = tables[0];
    const { out } = converted(table);
    const rows = rowsOf(table.path).slice(0, 300);
    const placed = locate(out, rows);
    const inverse = (from: string, points: readonly (readonly number[])[]) => {
      const text = points.map((point) => point.join(" ")).join("\n");
      return gromaJson<{ points: Located[] }>(
        ["locate", out, "--points", "-", "--inverse", from, "--json"],
        text,
      ).points;
    };
    const geodetic = placed.map((point) => point.geodetic);
    const found = {
      ecef: inverse(
        "ecef",
        placed.map(({ ecef }) => ecef),
      ),
      geodetic: inverse("geodetic", geodetic),
      // In its own plane x and y are those of the scan.
      own: inverse(
        "EPSG:28992",
        rows.map(([x, y], i) => [x, y, geodetic[i][2]]),
      ),
    };
    for (const points of Object.values(found)) {
      const worst = Math.max(...points.map(({ source }, i) => distance(source, rows[i])));
      // Degrees as they are printed are right to a few nanometres.
      expect(worst).toBeLessThanOrEqual(1e-6);
    }
    const truth = inverse(
      "ecef",
      rows.map((row) => row.slice(3)),
    );
    expect(Math.max(...truth.map(({ source }, i) => distance(source, rows[i])))).toBeLessThanOrEqual(1e-3);
  });

  it("refuses a place by its line that no coordinates of the scan lead to", () => {
    const { out } = converted(tables[0]);
    const far = groma(
      ["locate", out, "--points", "-", "--inverse", "geodetic"],
      "5.4 52.1 40\n\n8.5 47.3 400\n",
    );
    expect(far.code).toBe(1);
    expect(far.stderr).toMatch(/^PLACE_DOMAIN: .*line 3: /);
    const unknown = groma(["locate", out, "--points", "-", "--inverse", "mars"], "1 2 3\n");
    expect(unknown.stderr).toMatch(/^OPTION_INVERSE: --inverse: "mars" is no projection/);
    const { stdout } = groma(["locate", out, "--points", "-", "--inverse", "geodetic"], "5.4 52.1 46\n");
    expect(stdout.trimEnd().split("\n").at(-1)).toMatch(/^15\d{4}\.\d{6} 4\d{5}\.\d{6} \d\.\d{6}$/);
  });

  it("says by name what lies outside, and tells the line", () => {
    const { out } = converted(tables[0]);
    const { code, stderr } = groma(
      ["locate", out, "--points", "-"],
      "# remark\n150000 450000\n900000;450000;3\n",
    );
    expect(code).toBe(1);
    expect(stderr).toMatch(/^PLACE_DOMAIN: .*line 3: .*\(900000, 450000, 3\)/);
  });
});

describe.skipIf(missing)("groma locate after a conversion without PROJ", () => {
  it.each(tables)("is off by no more than it says for $name", { timeout: 120_000 }, ({ name, crs, path }) => {
    const out = join(folder, `${name}-js.copc.laz`);
    const done = convert(name, crs, out, "--engine", "proj4js");
    expect(done.engine.name).toBe("proj4js");
    const words = done.operation.notes.join("\n");
    const plane = Number(/expect errors of [\d.]+ to ([\d.]+) m in plane/.exec(words)?.[1]);
    const height = Number(/up to about ([\d.]+) m/.exec(words)?.[1]);
    const rows = rowsOf(path);
    const located = locate(out, rows);
    const off = located.map(({ ecef, geodetic }, i) => {
      const truth = rows[i].slice(3);
      const place = new Float64Array(3);
      ecefToGeodetic(truth[0], truth[1], truth[2], place);
      const high = Math.abs(geodetic[2] - place[2]);
      const whole = distance(ecef, truth);
      return { high, whole, flat: Math.sqrt(Math.max(0, whole ** 2 - high ** 2)) };
    });
    const worst = (part: keyof (typeof off)[number]) => Math.max(...off.map((error) => error[part]));
    console.info(
      `${name} without PROJ: worst ${worst("flat").toFixed(3)} m in plane, ${worst("high").toFixed(3)} m in height, ` +
        `stated ${done.accuracy.total?.toFixed(2)} m`,
    );
    expect(worst("whole")).toBeGreaterThan(0.01);
    expect(worst("flat")).toBeLessThanOrEqual(plane);
    expect(worst("high")).toBeLessThanOrEqual(height);
    expect(done.accuracy.total).not.toBeNull();
    expect(worst("whole")).toBeLessThanOrEqual(done.accuracy.total!);
    expect(located.every(({ accuracy }) => accuracy === done.accuracy.total)).toBe(true);
    expect(groma(["info", out]).stdout).toContain(words.split("\n")[0]);
  });

  it("takes proj4js by itself where there is no PROJ", () => {
    const empty = join(folder, "empty");
    mkdirSync(empty);
    const before = { PATH: process.env.PATH, XDG_CACHE_HOME: process.env.XDG_CACHE_HOME };
    try {
      Object.assign(process.env, { PATH: empty, XDG_CACHE_HOME: empty });
      const { name, crs } = tables[0];
      const done = convert(`${name}-10`, crs, join(folder, "no-proj.copc.laz"));
      expect(done.engine.name).toBe("proj4js");
      expect(done.operation.notes.join()).toMatch(/without PROJ/);
    } finally {
      process.env.PATH = before.PATH;
      if (before.XDG_CACHE_HOME === undefined) delete process.env.XDG_CACHE_HOME;
      else process.env.XDG_CACHE_HOME = before.XDG_CACHE_HOME;
    }
  });
});
