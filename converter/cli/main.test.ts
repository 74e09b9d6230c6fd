import { execFile } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

const main = fileURLToPath(new URL("../dist/main.js", import.meta.url));
const generator = fileURLToPath(new URL("../../demo/sample/dist/generate.js", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "groma-cli-"));
const sample = join(folder, "sample.las");

interface Outcome {
  code: number;
  stdout: string;
  stderr: string;
}

function run(program: string, args: readonly string[]): Promise<Outcome> {
  return new Promise((resolve) => {
    execFile(process.execPath, [program, ...args], { cwd: folder }, (error, stdout, stderr) => {
      resolve({ code: error ? Number(error.code ?? 1) : 0, stdout, stderr });
    });
  });
}

const groma = (...args: string[]) => run(main, args);

/** Bytes of the sample with its WKT record renamed, so that nobody finds a CRS in it. */
function withoutCrs(): string {
  const bytes = readFileSync(sample);
  const at = bytes.indexOf("LASF_Projection");
  bytes.write("somebody_else\0\0", at, "latin1");
  const file = join(folder, "no-crs.las");
  writeFileSync(file, bytes);
  return file;
}

beforeAll(async () => {
  const { code, stderr } = await run(generator, [sample, "5000"]);
  expect(stderr).toBe("");
  expect(code).toBe(0);
});

afterAll(() => rmSync(folder, { recursive: true }));

describe("groma convert", () => {
  it("makes a COPC that groma info describes with the CRS of the input", async () => {
    const made = await groma("convert", sample, "out.copc.laz");
    expect(made.stderr).not.toMatch(/warning|error/i);
    expect(made.code).toBe(0);
    const info = JSON.parse((await groma("info", "--json", "out.copc.laz")).stdout);
    const input = JSON.parse((await groma("info", "--json", sample)).stdout);
    expect(info).toMatchObject({
      copc: true,
      points: input.points,
      scale: input.scale,
      offset: input.offset,
    });
    expect(info.crs.code).toBe("EPSG:2056+5728");
    expect(info.crs.height).toEqual({ kind: "geoid", model: "LN02 height", epsg: 5728 });
    expect(info.statistics.points).toBe(input.points);
    // The sample lies near Lauterbrunnen.
    expect(info.geodeticBounds.west).toBeGreaterThan(7.8);
    expect(info.geodeticBounds.east).toBeLessThan(8);
    const people = (await groma("info", "out.copc.laz")).stdout;
    expect(people).toContain("LN02 height (EPSG:5728), geoid not applied");
  });

  it("refuses a file without CRS in one line, leaves no output, and takes the one given", async () => {
    const file = withoutCrs();
    const refused = await groma("convert", file, "no.copc.laz");
    expect(refused.code).toBe(1);
    expect(refused.stderr).toMatch(/^CRS_MISSING: .*no-crs\.las: .+\. .+--crs.+\.\n$/);
    expect(existsSync(join(folder, "no.copc.laz"))).toBe(false);
    const given = await groma(
      "convert",
      file,
      "given.copc.laz",
      "--crs",
      "EPSG:2056",
      "--vertical",
      "EPSG:5728",
    );
    expect(given.code).toBe(0);
    const info = JSON.parse((await groma("info", "--json", "given.copc.laz")).stdout);
    expect(info.crs.height.epsg).toBe(5728);
  });

  it("refuses inputs in different systems with their list, and an output that is there", async () => {
    await groma("convert", sample, "a.copc.laz", "--crs", "EPSG:2056");
    const mixed = await groma("convert", sample, "a.copc.laz", "mixed.copc.laz");
    expect(mixed.stderr).toMatch(/^CRS_MIXED: .*sample\.las is in .*a\.copc\.laz is in /);
    const there = await groma("convert", sample, "a.copc.laz");
    expect(there).toMatchObject({ code: 1 });
    expect(there.stderr).toMatch(/OUTPUT_EXISTS: /);
    expect((await groma("convert", sample, "a.copc.laz", "--overwrite")).code).toBe(0);
  });

  it("tells its progress as JSON lines, the result last", async () => {
    const { stdout, code } = await groma("convert", sample, "json.copc.laz", "--progress", "json");
    const lines = stdout
      .trim()
      .split("\n")
      .map((line) => JSON.parse(line));
    expect(code).toBe(0);
    expect(lines[0]).toMatchObject({
      event: "progress",
      total: expect.any(Number),
      rate: expect.any(Number),
    });
    expect(lines.at(-1)).toMatchObject({ event: "done", crs: { code: "EPSG:2056+5728" } });
  });
});

describe("the command line", () => {
  it.each([
    [["frob"], "OPTION_INVALID"],
    [["convert", "only-one.las"], "OPTION_INVALID"],
    [["convert", "in.las", "out.copc.laz", "--no-such-option"], "OPTION_INVALID"],
    [["view", "x.las", "--port", "70000"], "OPTION_INVALID"],
    [["info", "nowhere.laz"], "INPUT_NOT_FOUND"],
    [["view", "nowhere.laz"], "INPUT_NOT_FOUND"],
    [["serve", "nowhere"], "SERVER_FOLDER"],
    [["convert", sample, "out2.copc.laz", "--crs", "EPSG:999999"], "CRS_UNKNOWN"],
  ])("%j ends with exit code 1 and %s", async (args, code) => {
    const outcome = await groma(...args);
    expect(outcome.code).toBe(1);
    expect(outcome.stderr).toMatch(new RegExp(`^${code}: [^\\n]+\\.\\n$`));
    expect(outcome.stdout).toBe("");
  });

  it("helps with exit code 0", async () => {
    const { code, stdout } = await groma("--help");
    expect(code).toBe(0);
    expect(stdout).toMatch(/convert/);
  });
});
