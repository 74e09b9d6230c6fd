import { mkdtempSync, readdirSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, describe, expect, it } from "vitest";
import { data } from "../project.js";
import { coreMissing } from "./core.js";
import { groma, gromaJson } from "./groma.js";

interface Plan {
  event: string;
  points: number;
  levels: number;
  memory: number;
  tempBytes: number;
  outputBytes: number;
  output: string;
}

interface Info {
  octree: { levels: unknown[] };
}

const scan = data("vol_total.laz");
const missing = coreMissing ?? scan.missing;
const folder = mkdtempSync(join(tmpdir(), "groma-dry-run-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const options = ["--crs", "EPSG:32632", "--memory", "512MB"];

describe.skipIf(missing)(`what --dry-run announces${missing ? ` (skipped: ${missing})` : ""}`, () => {
  const output = join(folder, "out.copc.laz");
  const plan = () => gromaJson<Plan>(["convert", scan.path, output, ...options, "--dry-run", "--json"]);

  it("is what a conversion then takes, and nothing is written", { timeout: 120_000 }, () => {
    const planned = plan();
    expect(planned.event).toBe("plan");
    expect(planned.memory).toBeLessThanOrEqual(512 * 2 ** 20);
    expect(planned.output).toBe(output);
    expect(readdirSync(folder)).toEqual([]);
    // Half a million points take less than what a run may take.
    const roomy = gromaJson<Plan>([
      ...["convert", scan.path, output, "--crs", "EPSG:32632", "--memory", "16GB", "--threads", "2"],
      ...["--dry-run", "--json"],
    ]);
    expect(roomy.memory).toBeLessThan(300 * 2 ** 20);
    const { points } = gromaJson<{ points: number }>([
      ...["convert", scan.path, output, ...options, "--progress", "json"],
    ]);
    const { levels } = gromaJson<Info>(["info", output, "--json"]).octree;
    expect(planned.points).toBe(points);
    expect(Math.abs(planned.levels - levels.length)).toBeLessThanOrEqual(1);
    const bytes = statSync(output).size;
    expect(planned.outputBytes / bytes).toBeGreaterThan(2 / 3);
    expect(planned.outputBytes / bytes).toBeLessThan(3 / 2);
  });

  it("is refused as the conversion would be", () => {
    const refused = groma(["convert", scan.path, join(folder, "none/out.copc.laz"), ...options, "--dry-run"]);
    expect(refused.code).toBe(1);
    expect(refused.stderr).toMatch(/^OUTPUT_WRITE: .*there is no folder /m);
  });
});
