import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
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

let folder = "";
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), "groma-profile-"));
});
afterAll(() => rmSync(folder, { recursive: true }));

/** Runs `groma profile` on a scan and has the referee judge what it wrote. */
function profile(scan: string, line: Line, width: number, options: readonly string[] = []): Found {
  const file = join(folder, "line.geojson");
  const out = join(folder, "cut.las");
  writeFileSync(file, JSON.stringify({ type: "LineString", coordinates: line }));
  const run = groma([
    ...["profile", scan, "--line", file, "--line-crs", "source", "--width", String(width)],
    ...["--out", out, "--overwrite", ...options],
  ]);
  expect(run.stderr).not.toMatch(/^[A-Z]+_[A-Z]+:/m);
  expect(run.code).toBe(0);
  return runPython<Found>("interop/strip.py", [scan, out, String(width), JSON.stringify(line)]);
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
    "a line that turns back on itself": [
      [589600, 231400],
      [589900, 231450],
      [589600, 231400],
    ],
  };

  it.each(Object.entries(lines))("takes just the records in the strip along %s, each once", (_, line) => {
    for (const width of [0.5, 10, 60]) {
      const found = profile(converted(road.path), line, width);
      expectExact(found);
      if (line === lines["a line along the lattice"]) expect(found.doubtful).toBeGreaterThan(0);
    }
  });

  it("adds chainage and offset behind the records, and leaves them as they are", () => {
    const line = lines["a line that crosses itself, with segments of no length"]!;
    const found = profile(converted(road.path), line, 10, ["--chainage"]);
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
    const found = runPython<Found>("interop/strip.py", [scan, out, "9.99", JSON.stringify(line)]);
    // But at the two ends, which points of the lattice lie on.
    expect(Math.abs(found.written - found.count)).toBeLessThanOrEqual(20);
    expect(found.written).toBeGreaterThan(1000);
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
      const found = profile(converted(stadium.path), line, 100);
      expectExact(found);
      expect(found.doubtful).toBeGreaterThan(0);
    });
  },
);
