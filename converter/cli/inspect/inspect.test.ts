import { execFile } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, describe, expect, it } from "vitest";
import { inspect } from "./inspect.js";
import { report } from "./report.js";
import { reportJson } from "./report-json.js";

const data = fileURLToPath(new URL("../../../../shared/data/", import.meta.url));
const missing = existsSync(data) ? "" : " (skipped: ../shared/data is not there)";
const core = fileURLToPath(new URL("../../target/release/groma-core", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "groma-inspect-"));
afterAll(() => rmSync(folder, { recursive: true }));

/** Converts by the core, which counts all points in its own way. */
function converted(input: string): Promise<string> {
  const output = join(folder, `${input.replaceAll("/", "_")}.copc.laz`);
  return new Promise((resolve, reject) => {
    execFile(process.env.GROMA_CORE || core, ["convert", join(data, input), output], (error) =>
      error ? reject(error) : resolve(output),
    );
  });
}

describe.skipIf(missing)(`what is told of a file${missing}`, () => {
  it.each([
    ["las-variants/las__simple.las", "LAS, format 3"],
    ["las-variants/laz__simple.laz", "LAZ, format 3"],
    ["las-variants/las__test1_4.las", "LAS 1.4"],
    ["las-variants/las__permutations__1.0_1.las", "LAS 1.0"],
    ["las-variants/las__sample_c_thin.las", "LAS, returns"],
    ["las-variants/laz__las_with_several_extra_byte_bloc.laz", "extra bytes"],
  ])("%s: a sample that holds all points is what the core counts (%s)", async (input) => {
    const before = await inspect(join(data, input));
    const after = await inspect(await converted(input));
    const [ours, theirs] = [before.statistics!, after.statistics!];
    expect(before.sampled).toBeDefined();
    expect(after.sampled).toBeUndefined();
    if (ours.points === before.scan.points) {
      expect(ours.classes).toEqual(theirs.classes);
      expect(ours.returns).toEqual(theirs.returns);
      expect(ours.rgbBits).toBe(theirs.rgbBits);
    }
    for (const { name, min, max } of ours.attributes) {
      const other = theirs.attributes.find((one) => one.name === name);
      // Extra bytes with a scale of their own are told as they are stored.
      if (other === undefined || before.scan.extraBytes.some((extra) => extra.name === name)) continue;
      const slack = name === "scanAngle" ? 0.003 : 1e-6 * Math.max(1, Math.abs(max));
      expect(min, name).toBeGreaterThanOrEqual(other.min - slack);
      expect(max, name).toBeLessThanOrEqual(other.max + slack);
      if (ours.points < before.scan.points) continue;
      expect(Math.abs(min - other.min), name).toBeLessThanOrEqual(slack);
      expect(Math.abs(max - other.max), name).toBeLessThanOrEqual(slack);
    }
    expect(after.octree!.levels.reduce((sum, { points }) => sum + points, 0)).toBe(after.scan.points);
    expect(after.header.records.map(({ userId }) => userId)).toContain("copc");
  });

  it("samples the coarse nodes of somebody else's COPC, and knows its octree", async () => {
    const { scan, sampled, statistics, octree } = await inspect(join(data, "ellipsoid.copc.laz"));
    expect(sampled).toBe("coarsest nodes");
    expect(statistics!.points).toBeGreaterThan(0);
    expect(statistics!.points).toBeLessThanOrEqual(100_000);
    for (const [axis, name] of ["x", "y", "z"].entries()) {
      const { min, max } = statistics!.attributes.find((one) => one.name === name)!;
      expect(min).toBeGreaterThanOrEqual(scan.min[axis]! - 1e-6);
      expect(max).toBeLessThanOrEqual(scan.max[axis]! + 1e-6);
      // The coarse nodes cover the whole.
      expect(max - min).toBeGreaterThan(0.9 * (scan.max[axis]! - scan.min[axis]!));
    }
    expect(octree!.levels[0]).toMatchObject({ level: 0, nodes: 1 });
    expect(octree!.levels.reduce((sum, { points }) => sum + points, 0)).toBe(scan.points);
  });

  it("is told to people in lines, to machines as one object", async () => {
    const inspection = await inspect(join(data, "las-variants/las__autzen_trim.las"));
    const text = report(inspection).join("\n");
    expect(text).toMatch(/^returns +1: 99,257 {3}2: 9,021 {3}3: 1,623 {3}4: 99$/m);
    expect(text).toMatch(/^classes +1 unclassified: \d+/m);
    expect(text).toMatch(/^ +2 ground: \d+/m);
    expect(text).toMatch(/^ +classes, attributes and times of 100,000 points: evenly spread$/m);
    expect(text).toMatch(
      /^gps time +245379\.\d+ … 245385\.\d+ s of an unstated GPS week: Tuesday 20:09:39 … Tuesday 20:09:4/m,
    );
    expect(text).toMatch(/^density +1\.79 points per m², 74\.8 cm apart/m);
    expect(text).toMatch(/^records +LASF_Projection 34735: 184 B, GeoTiff GeoKeyDirectoryTag$/m);
    expect(reportJson(inspection)).toMatchObject({
      points: 110_000,
      pointsByReturn: [99_257, 9021, 1623, 99, 0],
      statisticsOf: "evenly spread",
      classNames: { 1: "unclassified", 2: "ground" },
      gpsTime: { kind: "week", from: null },
      octree: null,
    });
  });

  it("shows a mean between the ends of its range, and lengths in the units of the file", async () => {
    const inspection = await inspect(join(data, "las-variants/las__autzen_trim.las"));
    const attributes = [{ name: "gpsTime", min: 245_385.71, max: 245_385.89, mean: 245_385.8 }];
    const statistics = { ...inspection.statistics!, attributes };
    const text = report({ ...inspection, statistics }).join("\n");
    expect(text).toMatch(/^attributes +gpsTime 245385\.71 … 245385\.89, mean 245385\.8$/m);
    expect(text).toMatch(/^step +x 0\.01 foot {3}y 0\.01 foot {3}z 0\.01 foot$/m);
  });

  it("is still told where points and octree are damaged", async () => {
    const bytes = readFileSync(join(data, "ellipsoid.copc.laz"));
    const root = Number(bytes.readBigUInt64LE(429 + 40));
    bytes.fill(0xff, root, root + 64);
    bytes.fill(0xa5, 2000, 4000);
    writeFileSync(join(folder, "damaged.copc.laz"), bytes);
    const inspection = await inspect(join(folder, "damaged.copc.laz"));
    expect(inspection.octree).toBeUndefined();
    expect(report(inspection).join("\n")).toMatch(/^octree +FORMAT_HIERARCHY: /m);
  });

  it("tells of a file that holds fewer points than it declares", async () => {
    const whole = readFileSync(join(data, "las-variants/las__simple.las"));
    const short = join(folder, "short.las");
    writeFileSync(short, whole.subarray(0, whole.length - 100));
    const { scan } = await inspect(short);
    expect(scan.warnings).toContainEqual(
      expect.stringMatching(/^the header declares [\d,]+ points, the file holds [\d,]+: it is incomplete$/),
    );
    expect((await inspect(join(data, "las-variants/las__simple.las"))).scan.warnings).toEqual([]);
  });
});
