import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data, projectRoot } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing } from "./core.js";
import { groma } from "./groma.js";

type Line = readonly (readonly [number, number])[];

/** What the referee finds. */
interface Found {
  readonly count: number;
  readonly written: number;
  readonly same: boolean;
  readonly doubtful: number;
  readonly meaning: boolean;
  readonly kept: boolean;
  readonly bounds: boolean;
  readonly along: { readonly chainage?: [number, number]; readonly offset?: [number, number] };
  readonly users: readonly string[];
}

const main = join(projectRoot, "converter/dist/main.js");
let folder = "";
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), "groma-profile-"));
});
afterAll(() => rmSync(folder, { recursive: true }));

/** A file that was cut from a scan, and the strip that it was cut along. */
type Cut = readonly [path: string, width: number, line: Line];

/** Has the referee judge cuts of a scan. */
const judged = (scan: string, cuts: readonly Cut[]): Found[] =>
  runPython("interop/strip.py", [scan], JSON.stringify(cuts));

/** Runs `groma profile` on a scan. */
function profile(scan: string, line: Line, width: number, options: readonly string[] = []): Cut {
  const file = join(folder, "line.geojson");
  const out = join(folder, `cut-${width}${options.join("")}.las`);
  writeFileSync(file, JSON.stringify({ type: "LineString", coordinates: line }));
  const run = groma([
    ...["profile", scan, "--line", file, "--line-crs", "source", "--width", String(width)],
    ...["--out", out, "--overwrite", ...options],
  ]);
  expect(run.stderr).not.toMatch(/^[A-Z]+_[A-Z]+:/m);
  expect(run.code).toBe(0);
  return [out, width, line];
}

function expectExact(found: Found): void {
  expect(found).toMatchObject({ same: true, written: found.count, meaning: true, kept: true, bounds: true });
  expect(found.count).toBeGreaterThan(0);
}

const road = data("vol_total.laz");
const REFUSED = road.missing ?? coreMissing ?? pythonMissing;

describe.skipIf(REFUSED)("groma profile of a real scan", () => {
  const lines: Readonly<Record<string, Line>> = {
    // Points lie on a lattice of 1 cm, so that many are exactly on an edge of these.
    "a line along the lattice": [
      [589600, 231400],
      [589900, 231400],
    ],
    "corners of 1° and 179°": [
      [589600, 231380],
      [589750, 231400],
      [589900, 231417.4],
      [589750.5, 231397.1],
    ],
    "a line that crosses itself, with segments of no length": [
      [589600, 231350],
      [589800, 231450],
      [589800, 231450],
      [590000, 231400],
      [589700, 231500],
      [589700, 231340],
      [589700, 231340],
    ],
    "pieces at both ends that are shorter than half the width": [
      [589600, 231380],
      [589601, 231381.5],
      [589850, 231430],
      [589900, 231420],
      [589901.25, 231421],
    ],
    "a line that turns back on itself": [
      [589600, 231400],
      [589900, 231450],
      [589600, 231400],
    ],
  };

  it.each(Object.entries(lines))("takes just the records in the strip along %s, each once", (_, line) => {
    const scan = converted(road.path);
    const cuts = [0.5, 10, 60].map((width) => profile(scan, line, width));
    for (const found of judged(scan, cuts)) {
      expectExact(found);
      if (line === lines["a line along the lattice"]) expect(found.doubtful).toBeGreaterThan(0);
    }
  });

  it("adds chainage and offset behind the records, and leaves them as they are", () => {
    const line = lines["a line that crosses itself, with segments of no length"]!;
    const scan = converted(road.path);
    const [found] = judged(scan, [profile(scan, line, 10, ["--chainage"])]);
    expectExact(found);
    const length = line.reduce((sum, [x, y], index) => {
      const [fromX, fromY] = line[Math.max(0, index - 1)]!;
      return sum + Math.hypot(x - fromX, y - fromY);
    }, 0);
    const { chainage, offset } = found.along;
    expect(chainage![0]).toBeGreaterThanOrEqual(0);
    expect(chainage![1]).toBeLessThanOrEqual(length + 1e-9);
    expect(chainage![1]).toBeGreaterThan(length - 60);
    expect(offset![0]).toBeGreaterThanOrEqual(-5 - 1e-9);
    expect(offset![0]).toBeLessThan(-4.9);
    expect(offset![1]).toBeLessThanOrEqual(5 + 1e-9);
    expect(offset![1]).toBeGreaterThan(4.9);
    expect(found.users).toEqual(["LASF_Projection", "LASF_Spec", "groma"]);
  });

  it("counts chainage along geodesics, from a start", () => {
    const scan = converted(road.path);
    const line = lines["a line along the lattice"]!;
    const cut = (...options: string[]) =>
      profile(scan, line, 10, ["--chainage", "--start", "1000", ...options]);
    const [grid, geodesic] = judged(scan, [cut(), cut("--stations", "geodesic")]).map(
      ({ along }) => along.chainage!,
    );
    expect(grid[0]).toBeGreaterThanOrEqual(1000);
    expect(grid[1]).toBeGreaterThan(1299);
    expect(grid[1]).toBeLessThanOrEqual(1300);
    // The scan lies 765 m up, of which a geodesic on the ellipsoid knows nothing; LV03 is within 200 ppm of true there.
    const ratio = (geodesic[1] - 1000) / (grid[1] - 1000);
    expect(Math.abs(ratio - 1)).toBeLessThan(2e-4);
    expect(ratio).not.toBe(1);
  });

  it("finds the same by longitude and latitude", () => {
    const scan = converted(road.path);
    const line = lines["a line along the lattice"]!;
    const located = JSON.parse(
      groma(["locate", scan, "--points", "-", "--json"], line.map((vertex) => vertex.join(" ")).join("\n"))
        .stdout,
    ) as { points: { geodetic: [number, number, number] }[] };
    const file = join(folder, "geographic.geojson");
    const out = join(folder, "geographic.las");
    const coordinates = located.points.map(({ geodetic }) => geodetic.slice(0, 2));
    writeFileSync(
      file,
      JSON.stringify({ type: "Feature", properties: null, geometry: { type: "LineString", coordinates } }),
    );
    // The edges lie between the lattice's lines, so that a micrometre decides nothing.
    const run = groma(["profile", scan, "--line", file, "--width", "9.99", "--out", out, "--overwrite"]);
    expect(run.stderr).not.toMatch(/OPTION|INTERNAL/);
    const [found] = judged(scan, [[out, 9.99, line]]);
    // But at the two ends, which points of the lattice lie on.
    expect(Math.abs(found.written - found.count)).toBeLessThanOrEqual(20);
    expect(found.written).toBeGreaterThan(1000);
  });

  it("writes the same points as LAS, LAZ, CSV, DXF and GeoJSON, for programs of others", () => {
    const scan = converted(road.path);
    const line = lines["corners of 1° and 179°"]!;
    const file = join(folder, "formats.geojson");
    writeFileSync(file, JSON.stringify({ type: "LineString", coordinates: line }));
    for (const format of ["las", "laz", "csv", "dxf", "geojson"]) {
      const out = join(folder, `formats-cut.${format}`);
      const run = groma([
        "profile",
        scan,
        "--line",
        file,
        "--line-crs",
        "source",
        "--width",
        "3",
        "--out",
        out,
      ]);
      expect(run).toMatchObject({ code: 0 });
    }
    const found = runPython<Record<string, unknown>>("interop/cut_formats.py", [join(folder, "formats-cut")]);
    expect(found).toMatchObject({
      laz: true,
      compressed: true,
      crs: true,
      csv: true,
      dxf: true,
      geojson: true,
      // Place and transformation; what the converter found of all points, and their octree, are another file's.
      groma: [1, 3],
    });
    expect(found).toMatchObject({ vertices: line, layers: ["GRID", "LINE", "POINTS", "TEXT"] });
    expect(found.count).toBeGreaterThan(1000);
    // pyproj shifts the datum at height 0; where a place is to the millimetre, other tests hold.
    expect(found.metresOff).toBeLessThan(0.05);
  });

  it("writes LAZ whose records have chainage and offset as those of LAS", () => {
    const line = lines["a line along the lattice"]!;
    const out = join(folder, "chainage.laz");
    const file = join(folder, "chainage.geojson");
    writeFileSync(file, JSON.stringify({ type: "LineString", coordinates: line }));
    const scan = converted(road.path);
    const options = ["--line", file, "--line-crs", "source", "--width", "10", "--chainage", "--out", out];
    expect(groma(["profile", scan, ...options]).code).toBe(0);
    const [found] = judged(scan, [[out, 10, line]]);
    expectExact(found);
    expect(found.along.chainage![1]).toBeGreaterThan(299);
  });

  it("reads a file of a server by Range requests, to the same bytes", async () => {
    const scan = converted(road.path);
    const server = spawn(process.execPath, [main, "serve", dirname(scan), "--port", "0"]);
    try {
      const said = await new Promise<string>((resolve) => {
        server.stdout.on("data", (chunk) => resolve(String(chunk)));
      });
      const address = /http:\S+/.exec(said)![0];
      const file = join(folder, "served.geojson");
      writeFileSync(
        file,
        JSON.stringify({ type: "LineString", coordinates: lines["a line along the lattice"] }),
      );
      const options = ["--line", file, "--line-crs", "source", "--width", "10", "--overwrite"];
      const outs = [join(folder, "served.las"), join(folder, "local.las")];
      const url = `${address.replace(/\/$/, "")}/${basename(scan)}`;
      for (const [index, input] of [url, scan].entries()) {
        const run = groma(["profile", input, ...options, "--out", outs[index]!]);
        expect(run.stderr).not.toMatch(/^[A-Z]+_[A-Z]+:/m);
      }
      expect(Buffer.compare(readFileSync(outs[0]!), readFileSync(outs[1]!))).toBe(0);
    } finally {
      server.kill();
    }
  });

  it("leaves nothing behind when it is stopped", async () => {
    const scan = converted(road.path);
    const file = join(folder, "stopped.geojson");
    const place = join(folder, "stopped");
    mkdirSync(place);
    writeFileSync(
      file,
      JSON.stringify({ type: "LineString", coordinates: lines["a line along the lattice"] }),
    );
    const options = [
      "--line",
      file,
      "--line-crs",
      "source",
      "--width",
      "400",
      "--out",
      join(place, "cut.las"),
    ];
    const child = spawn(process.execPath, [main, "profile", scan, ...options, "--progress", "json"]);
    let stderr = "";
    child.stderr.on("data", (chunk) => {
      stderr += chunk;
    });
    child.stdout.once("data", () => child.kill("SIGINT"));
    const code = await new Promise((resolve) => child.on("close", resolve));
    expect([code, stderr]).toEqual([1, expect.stringMatching(/^INTERRUPTED: /)]);
    expect(readdirSync(place)).toEqual([]);
  });

  it("refuses what it cannot do, by name, and leaves nothing behind", () => {
    const scan = converted(road.path);
    const file = join(folder, "far.geojson");
    const write = (value: unknown) => writeFileSync(file, JSON.stringify(value));
    const run = (...options: string[]) =>
      groma(["profile", scan, "--line", file, "--width", "1", ...options]).stderr.split(":")[0];
    const out = join(folder, "nothing.las");
    write({
      type: "LineString",
      coordinates: [
        [0, 0],
        [1, 1],
      ],
    });
    expect(run("--line-crs", "source", "--out", out)).toContain("SELECTION_EMPTY");
    expect(run("--line-crs", "source", "--out", join(folder, "nothing.xyz"))).toBe("OPTION_FORMAT");
    write({
      type: "LineString",
      coordinates: [
        [589600, 231400],
        [589900, 231400],
      ],
    });
    expect(run("--out", out)).toBe("OPTION_CRS");
    write({
      type: "LineString",
      coordinates: [
        [7, 7],
        [7, 7],
      ],
    });
    expect(run("--line-crs", "source", "--out", out)).toBe("OPTION_LINE");
    write({ type: "Point", coordinates: [7, 7] });
    expect(run("--line-crs", "source", "--out", out)).toBe("GEOJSON_GEOMETRY");
    write({
      type: "LineString",
      coordinates: [
        [7, 7],
        ["7", 8],
      ],
    });
    expect(run("--line-crs", "source", "--out", out)).toBe("GEOJSON_GEOMETRY");
    writeFileSync(file, "{");
    expect(run("--line-crs", "source", "--out", out)).toBe("GEOJSON_SYNTAX");
    rmSync(file);
    expect(run("--line-crs", "source", "--out", out)).toBe("GEOJSON_NOT_FOUND");
    expect(groma(["profile", road.path, "--line", "x", "--width", "0", "--out", out]).stderr).toMatch(
      /^OPTION_INVALID/,
    );
  });
});

describe.skipIf(REFUSED)("groma clip of a real scan", () => {
  /** Runs `groma clip` and has GEOS judge what it wrote. */
  function clip(rings: readonly Line[], classes: readonly number[], options: readonly string[]) {
    const scan = converted(road.path);
    const file = join(folder, "polygon.geojson");
    const out = join(folder, "clip.las");
    writeFileSync(file, JSON.stringify({ type: "Polygon", coordinates: rings }));
    const given =
      rings.length > 0 && options.length === 0 ? ["--polygon", file, "--polygon-crs", "source"] : options;
    const chosen = classes.length > 0 ? ["--classes", classes.join(",")] : [];
    const run = groma(["clip", scan, ...given, ...chosen, "--out", out, "--overwrite"]);
    expect(run.stderr).not.toMatch(/^[A-Z]+_[A-Z]+:/m);
    return runPython<{ count: number; same: boolean; onEdge: number }>("interop/clipped.py", [
      ...[scan, out, JSON.stringify(rings), JSON.stringify(classes)],
    ]);
  }

  const slanted: Line = [
    [589600, 231350],
    [589900, 231330],
    [589950, 231500],
    [589750, 231420],
    [589600, 231350],
  ];
  const square: Line = [
    [589700, 231380],
    [589740, 231380],
    [589740, 231400],
    [589700, 231400],
    [589700, 231380],
  ];

  it("takes just the records in a polygon with a hole, those on its edges too", () => {
    const found = clip([slanted, square], [], []);
    expect(found.same).toBe(true);
    expect(found.count).toBeGreaterThan(1000);
    expect(found.onEdge).toBeGreaterThan(0);
  });

  it("takes just the records in a box, and those of classes", () => {
    const found = clip([square], [], ["--box", "589700,231380,589740,231400"]);
    expect(found.same).toBe(true);
    expect(found.count).toBeGreaterThan(100);
    expect(clip([], [0], [])).toMatchObject({ same: true, count: 498868 });
  });

  it("refuses what it cannot do, by name", () => {
    const run = (...options: string[]) =>
      groma(["clip", converted(road.path), ...options, "--out", join(folder, "none.las")]).stderr;
    expect(run()).toMatch(
      /^OPTION_INVALID: .*--polygon, --box, --heights, --clips, --classes, --returns or --range/,
    );
    expect(run("--box", "1,2,3")).toMatch(/^OPTION_INVALID/);
    expect(run("--box", "3,3,1,1")).toMatch(/^OPTION_BOX/);
    expect(run("--classes", "300")).toMatch(/^OPTION_INVALID/);
    expect(run("--classes", "200")).toMatch(/SELECTION_EMPTY/);
  });
});

const stadium = data("autzen.laz");

describe.skipIf(stadium.missing ?? coreMissing ?? pythonMissing)(
  "groma profile of ten million points",
  () => {
    it("takes just the records in a wide strip, each once", { timeout: 280_000 }, () => {
      const line: Line = [
        [636001.5, 849500],
        [637500.5, 849500],
        [637600, 849000],
        [638900, 852900],
      ];
      const scan = converted(stadium.path);
      const [found] = judged(scan, [profile(scan, line, 100)]);
      expectExact(found);
      expect(found.doubtful).toBeGreaterThan(0);
    });
  },
);
