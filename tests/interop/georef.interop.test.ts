import { execFile } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { PointCloud } from "@groma/layer";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { BadServer } from "../faults/bad-server.js";
import { localExecutor } from "../faults/local-executor.js";
import { projMissing } from "../proj.js";
import { data, projectRoot } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing } from "./core.js";
import { distance, gromaJson } from "./groma.js";

const grids = data("grids");
const table = data("truth/grid_rd_nap.json");
const missing = pythonMissing ?? coreMissing ?? projMissing ?? grids.missing ?? table.missing;

const folder = mkdtempSync(join(tmpdir(), "groma-georef-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** Runs `groma` while this process serves. */
function groma(...args: string[]): Promise<{ code: number; stdout: string; stderr: string }> {
  const main = join(projectRoot, "converter/dist/main.js");
  return new Promise((resolve) => {
    execFile(process.execPath, [main, ...args], { cwd: folder }, (error, stdout, stderr) => {
      resolve({ code: error ? Number(error.code ?? 1) : 0, stdout, stderr });
    });
  });
}

describe.skipIf(missing)("groma georef", () => {
  let server: BadServer;
  let rows: number[][];
  let size = 0;

  beforeAll(async () => {
    rows = JSON.parse(readFileSync(table.path, "utf8")).rows;
    const las = join(folder, "rows.las");
    const job = { path: las, scale: 0.01, rows, wkt: "EPSG:7415" };
    expect(runPython<number>("interop/make_las.py", [], JSON.stringify([job]))).toBe(1);
    const converted = join(folder, "rows.copc.laz");
    gromaJson(["convert", las, converted, "--engine", "proj4js", "--progress", "json"]);
    // As of another writer: what Groma says of the place is nobody's.
    const bytes = readFileSync(converted);
    for (let at = bytes.indexOf("groma\0"); at >= 0; at = bytes.indexOf("groma\0", at + 1)) {
      bytes.write("other\0", at, "latin1");
    }
    size = bytes.length;
    server = await BadServer.start(bytes);
  }, 60_000);
  afterAll(() => server?.stop());

  it("places a file of a server that nobody can rewrite, as a conversion would", {
    timeout: 60_000,
  }, async () => {
    const { code, stderr, stdout } = await groma("georef", server.url, "--grids", grids.path, "--json");
    expect([code, stderr]).toEqual([0, ""]);
    expect(JSON.parse(stdout)).toMatchObject({ output: "scan.georef", engine: { name: "PROJ" } });
    const requests = server.log.length;
    // The opening, which has the records, and the root page of the hierarchy: no points.
    expect(requests).toBeLessThanOrEqual(3);
    const options = { executor: localExecutor() };
    const transformation = new Uint8Array(readFileSync(join(folder, "scan.georef")));
    const certified = await PointCloud.fromUrl(server.url, { ...options, transformation });
    const derived = await PointCloud.fromUrl(server.url, options);
    const worst = (cloud: PointCloud) =>
      Math.max(...rows.map(([x, y, z, ...ecef]) => distance([...cloud.place(x!, y!, z!)], ecef)));
    console.info(
      `RD + NAP of ${size} bytes: worst ${(1000 * worst(certified)).toFixed(4)} mm by ${transformation.length} bytes ` +
        `made in ${requests} requests; by proj4js ${worst(derived).toFixed(2)} m`,
    );
    expect(worst(certified)).toBeLessThanOrEqual(1e-3);
    expect(worst(derived)).toBeGreaterThan(0.01);
    expect([certified.engine.name, derived.engine.name]).toEqual(["PROJ", "proj4js"]);
    expect(certified.operation?.grids).toContain("nl_nsgi_nlgeo2018.tif");
    // By address too, and never for another file.
    writeFileSync(join(folder, "other.georef"), transformation);
    const beside = await BadServer.start(transformation);
    const served = await PointCloud.fromUrl(server.url, { ...options, transformation: beside.url });
    expect([...served.place(...(rows[0]!.slice(0, 3) as [number, number, number]))]).toEqual([
      ...certified.place(...(rows[0]!.slice(0, 3) as [number, number, number])),
    ]);
    await beside.stop();
    for (const cloud of [certified, derived, served]) cloud.destroy();
  });

  it("says which grids a file lacks, and nothing where it has them", { timeout: 60_000 }, async () => {
    const las = join(folder, "rows.las");
    const told = async (...more: string[]) => {
      const { stdout } = await groma("grids", ...more, "--json");
      return JSON.parse(stdout) as {
        operation: { grids: string[] };
        better: { accuracy: number; grids: { name: string; get: string }[] }[];
      };
    };
    const bare = await told(las);
    // A machine of its own grids lacks none.
    const known = [
      ...bare.operation.grids,
      ...bare.better.flatMap(({ grids }) => grids.map(({ name }) => name)),
    ];
    expect(known).toContain("nl_nsgi_nlgeo2018.tif");
    for (const { grids: lacking } of bare.better) {
      for (const { name, get } of lacking) expect(get).toBe(`projsync --file ${name}`);
    }
    const full = await told(server.url, "--grids", grids.path);
    expect([full.operation.grids.includes("nl_nsgi_nlgeo2018.tif"), full.better]).toEqual([true, []]);
  });

  it("does not write over a file, and says what is wrong with an input", async () => {
    const out = join(folder, "there.georef");
    writeFileSync(out, "mine");
    expect((await groma("georef", server.url, out)).stderr).toMatch(/^OUTPUT_EXISTS: /);
    expect(readFileSync(out, "utf8")).toBe("mine");
    expect((await groma("georef", join(folder, "none.copc.laz"))).stderr).toMatch(/^INPUT_NOT_FOUND: /);
    expect((await groma("georef", join(folder, "rows.las"))).stderr).toMatch(/^FORMAT_/);
  });
});
