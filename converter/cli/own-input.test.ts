import { linkSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { runClip } from "./commands/clip.js";
import { runGeoref } from "./commands/georef.js";
import { runProfile } from "./commands/profile.js";
import { prepare } from "./conversion/prepare.js";

// Refused before anything is read, so that no real scan is needed.
const folder = mkdtempSync(join(tmpdir(), "groma-own-"));
const path = (name: string) => join(folder, name);
const scan = path("scan.copc.laz");
const [symbolic, hard] = [path("symbolic.copc.laz"), path("hard.copc.laz")];
const line = path("line.csv");
const area = path("area.csv");
const volumes = path("volumes.csv");
const control = path("control.txt");
const geometry = (type: string, coordinates: unknown) => JSON.stringify({ type, coordinates });
const ring = [
  [7, 46],
  [8, 46],
  [8, 47],
  [7, 46],
];

beforeAll(() => {
  writeFileSync(volumes, "[]");
  for (const file of [scan, control, path("job.laz")]) writeFileSync(file, "as it was");
  writeFileSync(line, geometry("LineString", ring.slice(0, 2)));
  writeFileSync(area, geometry("Polygon", [ring]));
  symlinkSync(scan, symbolic);
  linkSync(scan, hard);
});
afterAll(() => rmSync(folder, { recursive: true }));

const cut = { overwrite: true, progress: "json" } as const;
const clip = (out: string) => runClip([scan], { ...cut, out, box: [0, 0, 1, 1], polygonCrs: "source" });
const profile = (out: string, sections?: true) =>
  runProfile([scan], {
    ...{ ...cut, out, line, plane: "source", width: 1, stations: "grid", thickness: 1, interval: 1 },
    ...(sections && { sections }),
  });
const convert = (output: string, options = {}) =>
  prepare([scan], output, { overwrite: true, ...options }, () => undefined);
const zip = path("scan.zip");

describe("an output that is a file that is read", () => {
  it.each<[string, string, () => Promise<unknown>]>([
    ["the scan of clip", scan, () => clip(scan)],
    ["the scan of clip by a symbolic link", scan, () => clip(symbolic)],
    ["the scan of clip by a hard link", scan, () => clip(hard)],
    [
      "the polygon of clip",
      area,
      () => runClip([scan], { ...cut, out: area, polygon: area, polygonCrs: "source" }),
    ],
    [
      "the clips of clip",
      volumes,
      () => runClip([scan], { ...cut, out: volumes, clips: volumes, polygonCrs: "source" }),
    ],
    ["the scan of a profile", scan, () => profile(scan)],
    ["the line of a profile", line, () => profile(line)],
    ["the scan of georef", scan, () => runGeoref(scan, scan, { overwrite: true })],
    ["the control points of georef", control, () => runGeoref(scan, control, { overwrite: true, control })],
    ["the scan of a conversion by a hard link", scan, () => convert(hard)],
    [
      "the pipeline of a conversion",
      path("job.laz"),
      () => convert(path("job.laz"), { pipeline: path("job.laz") }),
    ],
  ])("is refused: %s", async (_, file, run) => {
    const before = readFileSync(file);
    await expect(run()).rejects.toMatchObject({ code: "OUTPUT_INPUT" });
    expect(readFileSync(file)).toEqual(before);
  });

  it("is refused where cross-sections are written", async () => {
    linkSync(line, zip);
    await expect(profile(zip, true)).rejects.toMatchObject({ code: "OUTPUT_INPUT" });
  });
});
