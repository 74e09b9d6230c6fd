import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, describe, expect, it } from "vitest";
import { data } from "../project.js";
import { coreMissing } from "./core.js";
import { distance, groma, gromaJson, locate } from "./groma.js";

const lion = data("lion_takanawa.copc.laz");
const folder = mkdtempSync(join(tmpdir(), "groma-anchor-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const DEGREE = Math.PI / 180;
/** Takanawa; 40 m above the ellipsoid; +y towards 30° east of north; half a metre per unit. */
const ANCHOR = { longitude: 139.74, latitude: 35.63, height: 40, heading: 30, scale: 0.5 };

interface Done {
  engine: { name: string };
  residuals: number[];
  accuracy: { total: number | null; parts: { name: string; metres: number | null; note: string }[] };
}

/** Converts the lion and returns where. */
function converted(name: string, ...options: string[]): { out: string; done: Done } {
  const out = join(folder, name);
  const done = gromaJson<Done>(["convert", lion.path, out, "--progress", "json", "--overwrite", ...options]);
  return { out, done };
}

let atAnchor: ReturnType<typeof converted> | undefined;

/** The lion at its anchor, converted once for all tests. */
const anchored = () => {
  const { longitude, latitude, height, heading, scale } = ANCHOR;
  const anchor = [longitude, latitude, height, heading, scale].join();
  atAnchor ??= converted("anchor.copc.laz", "--anchor", anchor);
  return atAnchor;
};

/** Points of the scan that are far from one line. */
const POINTS = [
  [-4.5, 1.2, -3.1],
  [-0.8, 6.5, 1.1],
  [-4.2, 6.1, 0.4],
  [-1.1, 1.5, -2.2],
  [-2.5, 3.3, 0.9],
];

/** Control points as a file has them: where `groma locate` puts points of the anchored scan, each moved by metres. */
function controlFile(name: string, moved: readonly number[]): string {
  const { out } = anchored();
  const lines = locate(out, POINTS).map(({ source, geodetic: [longitude, latitude, height] }, i) =>
    [...source, longitude, latitude, height + (moved[i] ?? 0)].join("; "),
  );
  const file = join(folder, name);
  writeFileSync(file, `# x y z longitude latitude height\n${lines.join("\n")}\n`);
  return file;
}

describe.skipIf(coreMissing ?? lion.missing)("a scan without CRS", () => {
  it("is refused without a place, and the fix names the options", () => {
    const { code, stderr } = groma(["convert", lion.path, join(folder, "no.copc.laz")]);
    expect(code).toBe(1);
    expect(stderr).toMatch(/^CRS_MISSING: .*--crs.*--anchor.*--control/);
  });

  it("stands at its anchor, +y along the heading, +x to the right of it, +z up", () => {
    const { out, done } = anchored();
    expect(done.engine.name).toBe("similarity");
    const [origin, y, x, z] = locate(out, [
      [0, 0, 0],
      [0, 20, 0],
      [20, 0, 0],
      [0, 0, 20],
    ]);
    expect(origin.geodetic[0]).toBeCloseTo(ANCHOR.longitude, 12);
    expect(origin.geodetic[1]).toBeCloseTo(ANCHOR.latitude, 12);
    expect(origin.geodetic[2]).toBeCloseTo(ANCHOR.height, 7);
    for (const end of [x, y, z]) expect(distance(origin.ecef, end.ecef)).toBeCloseTo(20 * ANCHOR.scale, 7);
    const azimuth = (end: typeof y) => {
      const east = (end.geodetic[0] - origin.geodetic[0]) * Math.cos(ANCHOR.latitude * DEGREE);
      // Radii of curvature along the meridian and across it, over the equatorial radius.
      const [meridian, across] = [0.99667, 1.00114];
      return Math.atan2(east * across, (end.geodetic[1] - origin.geodetic[1]) * meridian) / DEGREE;
    };
    expect(azimuth(y)).toBeCloseTo(ANCHOR.heading, 2);
    expect(azimuth(x)).toBeCloseTo(ANCHOR.heading + 90, 2);
    expect(z.geodetic[2] - origin.geodetic[2]).toBeCloseTo(20 * ANCHOR.scale, 7);
  });

  it("may have another of its points at the anchor", () => {
    const { out } = converted("at.copc.laz", "--anchor", "139.74,35.63,40,30", "--anchor-at=-4.5,1.2,-3.1");
    const [{ geodetic }] = locate(out, [[-4.5, 1.2, -3.1]]);
    expect(geodetic[0]).toBeCloseTo(139.74, 12);
    expect(geodetic[1]).toBeCloseTo(35.63, 12);
    expect(geodetic[2]).toBeCloseTo(40, 7);
  });

  it("comes back from control points to 1 µm, with residuals in words", () => {
    const { out: first } = anchored();
    const { out, done } = converted("control.copc.laz", "--control", controlFile("exact.txt", []));
    expect(Math.max(...done.residuals)).toBeLessThan(1e-6);
    const [known, found] = [first, out].map((file) => locate(file, [...POINTS, [0, 0, 0], [30, -20, 10]]));
    for (const [i, { ecef }] of found.entries()) expect(distance(ecef, known[i].ecef)).toBeLessThan(1e-6);
    expect(groma(["info", out]).stdout).toMatch(/placed by 5 control points .*residuals ≤/);
  });

  it("tells how badly control points fit", () => {
    const { out, done } = converted(
      "off.copc.laz",
      "--control",
      controlFile("off.txt", [0.05, 0, 0, 0, -0.03]),
    );
    const part = done.accuracy.parts.find(({ name }) => name === "control points");
    expect(part?.metres).toBeCloseTo(Math.max(...done.residuals), 12);
    expect(part?.metres).toBeGreaterThan(0.005);
    expect(part?.metres).toBeLessThan(0.05);
    expect(locate(out, [[0, 0, 0]])[0].accuracy).toBe(done.accuracy.total);
  });

  it("keeps its place when it is converted again", () => {
    const { out } = anchored();
    const again = join(folder, "again.copc.laz");
    expect(groma(["convert", out, again, "--overwrite"]).code).toBe(0);
    expect(locate(again, POINTS)).toEqual(locate(out, POINTS));
  });

  it.each<[string, string, string]>([
    ["two points", "0 0 0 139 35 0\n1 0 0 139.1 35 0\n", "CONTROL_TOO_FEW"],
    ["one place", "1 1 1 139 35 0\n".repeat(4), "CONTROL_DEGENERATE"],
    ["one line", "0 0 0 139 35 0\n1 1 1 139.1 35 0\n2 2 2 139.2 35 9\n", "CONTROL_COLLINEAR"],
    ["no place on earth", "0 0 0 139 95 0\n1 0 0 139 35 0\n0 1 0 139 36 0\n", "CONTROL_RANGE"],
    ["five columns", "0 0 0 139 35\n", "CONTROL_SYNTAX"],
    ["nothing but remarks", "# nothing\n\n", "CONTROL_EMPTY"],
    ["columns mixed up", "0 0 0 35 139 0\n", "CONTROL_TOO_FEW"],
    [
      "a shape that is another",
      "0 0 0 139 35 0\n100 0 0 139.001 35 0\n0 100 0 139 35.02 0\n100 100 0 139.2 35.001 0\n",
      "CONTROL_MISMATCH",
    ],
  ])("refuses control points of %s by name", (_, text, code) => {
    const file = join(folder, "bad.txt");
    writeFileSync(file, text);
    const { stderr } = groma(["convert", lion.path, join(folder, "bad.copc.laz"), "--control", file]);
    expect(stderr).toMatch(new RegExp(`^${code}: `));
  });
});
