import { execFile, spawn } from "node:child_process";
import {
  copyFileSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { findProj } from "./proj/program/find.js";

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

/** The engine that is taken where none is asked for. */
const byDefault = (await findProj()) ? "PROJ" : "proj4js";

const groma = (...args: string[]) => run(main, args);

/** Runs a command whose output nobody reads, as after `| head` has had its lines. */
function unread(...args: string[]): Promise<Pick<Outcome, "code" | "stderr">> {
  return new Promise((resolve) => {
    const child = spawn(process.execPath, [main, ...args], { cwd: folder });
    child.stdout.destroy();
    let stderr = "";
    child.stderr.on("data", (chunk) => {
      stderr += chunk;
    });
    child.on("close", (code) => resolve({ code: code ?? -1, stderr }));
  });
}

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

describe("a command whose output nobody reads any more", () => {
  it("ends without a word", async () => {
    expect(await unread("info", sample)).toEqual({ code: 0, stderr: "" });
  });

  it("stops a conversion as a signal does", async () => {
    const { code, stderr } = await unread("convert", sample, "unread.copc.laz", "--progress", "json");
    expect(code).toBe(1);
    expect(stderr).toMatch(/^INTERRUPTED: /);
    expect(existsSync(join(folder, "unread.copc.laz"))).toBe(false);
  });
});

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
    expect(people).toMatch(/height +above LN02 height \(EPSG:5728\), geoid .* applied/);
    expect(people).toMatch(/place +EPSG:2056\+5728 .* → ECEF by .*, fit ≤ .* mm, operation /);
    expect(people).toContain(` → ECEF by ${byDefault} `);
    expect((await groma("info", sample)).stdout).toContain("geoid not applied: shown as ellipsoidal");
    expect(made.stdout).toMatch(/^out\.copc\.laz .*\nplace {4}EPSG:2056/);
  });

  it("says in words what proj4js is worth, to people and to machines", async () => {
    const made = await groma("convert", sample, "js.copc.laz", "--engine", "proj4js");
    expect(made.stdout).toMatch(/^note {5}.*without PROJ.*expect errors of/m);
    const info = JSON.parse((await groma("info", "--json", "js.copc.laz")).stdout);
    expect(info).toMatchObject({ engine: { name: "proj4js" }, geoids: ["EGM96"] });
    expect(info.operation.notes.join()).toMatch(/expect errors of/);
    expect(info.accuracy.total).toBeGreaterThan(1);
    expect(info.recordBytes.transformation).toBeGreaterThan(100);
  });

  it("tells what an unknown height may mean", async () => {
    await groma("convert", withoutCrs(), "unknown.copc.laz", "--crs", "EPSG:2056");
    const { accuracy, crs } = JSON.parse((await groma("info", "--json", "unknown.copc.laz")).stdout);
    expect(crs.height.kind).toBe("unknown");
    const height = accuracy.parts.find((part: { name: string }) => part.name === "height");
    expect(height).toMatchObject({ metres: null, note: expect.stringMatching(/should be \d+\.\d m higher/) });
    expect(accuracy.total).toBeNull();
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
    await groma("convert", sample, "a.copc.laz", "--vertical", "ellipsoidal");
    const mixed = await groma("convert", sample, "a.copc.laz", "mixed.copc.laz");
    expect(mixed.stderr).toMatch(
      /^CRS_MIXED: .*LN02 height.* \(.*sample\.las\); .*ellipsoidal.* \(a\.copc\.laz\)/,
    );
    const there = await groma("convert", sample, "a.copc.laz");
    expect(there).toMatchObject({ code: 1 });
    expect(there.stderr).toMatch(/OUTPUT_EXISTS: /);
    expect((await groma("convert", sample, "a.copc.laz", "--overwrite")).code).toBe(0);
  });

  it("takes a folder and a pattern, and leaves the output out", async () => {
    const tiles = join(folder, "tiles");
    mkdirSync(tiles);
    for (const name of ["a.las", "b.las"]) copyFileSync(sample, join(tiles, name));
    const { points } = JSON.parse((await groma("info", "--json", sample)).stdout);
    const last = (stdout: string) => JSON.parse(stdout.trimEnd().split("\n").at(-1)!);
    const whole = await groma("convert", "tiles", "tiles/all.copc.laz", "--progress", "json");
    expect(last(whole.stdout)).toMatchObject({ event: "done", points: 2 * points });
    const again = await groma(
      ...["convert", "tiles/*.la?", "tiles/all.copc.laz", "--overwrite", "--progress", "json"],
    );
    expect(last(again.stdout)).toMatchObject({ event: "done", points: 2 * points });
  });

  it("ends with one line that tells what it made", async () => {
    const { stdout } = await groma("convert", sample, "summary.copc.laz");
    expect(stdout).toMatch(
      /^summary\.copc\.laz {2}[\d,]+ points in [\d,]+ nodes?.* {2}[\d.]+ kB \([\d.]+ bytes per point\) {2}[\d.]+ s, [\d,]+ points\/s\n/,
    );
  });

  it("states the total accuracy, or why it is unknown", async () => {
    const byProj4js = await groma("convert", sample, "accuracy.copc.laz", "--engine", "proj4js");
    expect(byProj4js.stdout).toMatch(/^accuracy [\d.]+ m in total$/m);
    const plane = await groma(
      "convert",
      withoutCrs(),
      "plane.copc.laz",
      "--engine",
      "proj4js",
      "--crs",
      "EPSG:2056",
    );
    expect(plane.stdout).toMatch(/^accuracy total accuracy unknown: height reference not declared$/m);
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

describe("a header that lies about its bounds", () => {
  it("does not move the domain of the transformation: the points themselves do", async () => {
    const bytes = readFileSync(sample);
    // LAS 1.4 R15, table 3: max and min of x, y, z, six doubles from byte 179.
    const [maxX, minX, maxY, minY] = [0, 1, 2, 3].map((i) => bytes.readDoubleLE(179 + 8 * i));
    for (let i = 0; i < 6; i++) bytes.writeDoubleLE(i % 2 ? -1e7 : 1e7, 179 + 8 * i);
    writeFileSync(join(folder, "lying.las"), bytes);
    await groma("convert", "lying.las", "lying.copc.laz");
    const info = JSON.parse((await groma("info", "--json", "lying.copc.laz")).stdout);
    expect([info.max[0], info.min[0], info.max[1], info.min[1]]).toEqual([maxX, minX, maxY, minY]);
    writeFileSync(join(folder, "corners.txt"), `${minX} ${minY}\n${maxX} ${maxY}\n`);
    const { points } = JSON.parse(
      (await groma("locate", "lying.copc.laz", "--points", "corners.txt", "--json")).stdout,
    );
    expect(points).toHaveLength(2);
    writeFileSync(join(folder, "outside.txt"), `${minX} ${minY}\n${maxX + 1} ${maxY}\n`);
    const outside = await groma("locate", "lying.copc.laz", "--points", "outside.txt");
    expect(outside.stderr).toMatch(/^PLACE_DOMAIN: lying\.copc\.laz: line 2: /);
  });
});

describe("groma locate", () => {
  it("places points by the file's record, or by proj4js where it has none, and says which", async () => {
    await groma("convert", sample, "located.copc.laz");
    const info = JSON.parse((await groma("info", "--json", sample)).stdout);
    const [x, y, z] = [0, 1, 2].map((axis) => (info.min[axis] + info.max[axis]) / 2);
    writeFileSync(join(folder, "points.txt"), `# middle\n${x}, ${y}, ${z}\n${x} ${y}\n`);
    const { points, engine } = JSON.parse(
      (await groma("locate", "located.copc.laz", "--points", "points.txt", "--json")).stdout,
    );
    expect(points).toHaveLength(2);
    expect(points[0].source).toEqual([x, y, z]);
    // Without a height it is in the middle.
    expect(points[1].source[2]).toBeCloseTo(z, 9);
    expect(points[0].geodetic[0]).toBeCloseTo((info.geodeticBounds.west + info.geodeticBounds.east) / 2, 3);
    // The geoid is 50 m above the ellipsoid there.
    expect(points[0].geodetic[2] - z).toBeGreaterThan(40);
    expect(Math.hypot(...points[0].ecef)).toBeGreaterThan(6.3e6);
    expect(engine.name).toBe(byDefault);
    const bare = await groma("locate", sample, "--points", "points.txt");
    expect(bare.stdout).toMatch(/^# .* by proj4js .*, derived here from the file's WKT\n/);
    for (const [axis, name] of ["x", "y", "z"].entries()) {
      const far = [x, y, z].map((value, i) => (i === axis ? value + info.max[i] - info.min[i] : value));
      writeFileSync(join(folder, `far-${name}.txt`), `${x} ${y} ${z}\n${far.join(" ")}\n`);
      for (const file of ["located.copc.laz", sample]) {
        const { stderr } = await groma("locate", file, "--points", `far-${name}.txt`);
        expect(stderr).toMatch(/^PLACE_DOMAIN: .*: line 2: .* lies outside of the bounds of the data set/);
      }
    }
    const outside = await groma("locate", "located.copc.laz", "--points", "far.txt");
    expect(outside.stderr).toMatch(/^POINTS_NOT_FOUND: far\.txt: /);
  });
});

describe("the command line", () => {
  it.each([
    [["frob"], "OPTION_INVALID"],
    [["convert", "only-one.las"], "OPTION_INVALID"],
    [["convert", "in.las", "out.copc.laz", "--no-such-option"], "OPTION_INVALID"],
    [["view", "x.las", "--port", "70000"], "OPTION_INVALID"],
    [["serve", "--cors", "folder"], "OPTION_INVALID"],
    [["serve", ".", "--cors", "https://a.example/path"], "OPTION_INVALID"],
    [["info", "nowhere.laz"], "INPUT_NOT_FOUND"],
    [["locate", sample], "OPTION_INVALID"],
    [["locate", sample, "--points", "nowhere.txt"], "POINTS_NOT_FOUND"],
    [["convert", sample, "out3.copc.laz", "--anchor", "7.9,46.5,800,0"], "CRS_TWICE"],
    [["convert", sample, "out3.copc.laz", "--anchor", "7.9,46.5", "--crs", "none"], "OPTION_ANCHOR"],
    [["convert", sample, "out3.copc.laz", "--anchor", "7.9,95,0,0", "--crs", "none"], "OPTION_ANCHOR"],
    [["convert", sample, "out3.copc.laz", "--anchor-at", "1,2,3", "--crs", "none"], "OPTION_ANCHOR"],
    [["convert", sample, "out3.copc.laz", "--anchor", "1,2,3,4", "--control", "c.txt"], "OPTION_INVALID"],
    [["convert", sample, "out3.copc.laz", "--control", "nowhere.txt", "--crs", "none"], "CONTROL_NOT_FOUND"],
    [["convert", sample, "out3.copc.laz", "--crs", "none"], "CRS_MISSING"],
    [["convert", sample, "out3.copc.laz", "--proj", "nowhere"], "PROJ_MISSING"],
    [["convert", sample, "out3.copc.laz", "--engine", "proj4js", "--grids", "."], "OPTION_ENGINE"],
    [["view", sample, "--engine", "guess"], "OPTION_INVALID"],
    [["view", "nowhere.laz"], "INPUT_NOT_FOUND"],
    [["convert", "nothing-*.laz", "out3.copc.laz"], "INPUT_NOT_FOUND"],
    [["convert", sample, "out3.copc.laz", "--json"], "OPTION_INVALID"],
    [["convert", sample, "out3.copc.laz", "--threads", "0"], "OPTION_INVALID"],
    [["convert", sample, "out3.copc.laz", "--sampling", "best"], "OPTION_INVALID"],
    [["convert", sample, "out3.copc.laz", "--sampler", "grid"], "OPTION_INVALID"],
    [["convert", sample, "out3.copc.laz", "--scale", "0"], "OPTION_INVALID"],
    [["convert", sample, "out3.copc.laz", "--scale", "0.1"], "OPTION_SCALE"],
    [["convert", sample, "out3.copc.laz", "--pdal", "nowhere"], "PDAL_MISSING"],
    [["convert", sample, "out3.copc.laz", "--pipeline", "nowhere.json"], "PDAL_PIPELINE"],
    [["convert", "--pipeline", "nowhere.json"], "OPTION_INVALID"],
    [["convert", sample, "out3.copc.laz", "--crs="], "OPTION_INVALID"],
    [["view", sample, "--control", ""], "OPTION_INVALID"],
    [["serve", ".", "--port="], "OPTION_INVALID"],
    [["convert", sample, ""], "OPTION_INVALID"],
    [["help", "nosuch"], "OPTION_INVALID"],
    [["serve", "nowhere"], "SERVER_FOLDER"],
    [["convert", sample, "out2.copc.laz", "--crs", "EPSG:999999"], "CRS_UNKNOWN"],
  ])("%j ends with exit code 1 and %s", async (args, code) => {
    const outcome = await groma(...args);
    expect(outcome.code).toBe(1);
    expect(outcome.stderr).toMatch(new RegExp(`^${code}: [^\\n]+\\.\\n$`));
    expect(outcome.stdout).toBe("");
  });

  it("is loaded piece by piece: help and refused options wait for nothing but the parser", () => {
    const folder = join(main, "..");
    const imports = (file: string) =>
      [...readFileSync(join(folder, file), "utf8").matchAll(/^(?:import|export) .*?from "([^"]+)"/gm)].map(
        ([, from]) => from!,
      );
    const loaded = new Set<string>();
    const follow = (file: string) => {
      for (const from of imports(file)) {
        if (loaded.has(from)) continue;
        loaded.add(from);
        if (from.startsWith("./")) follow(from.slice(2));
      }
    };
    follow("main.js");
    expect([...loaded].sort()).toEqual([
      "./given/arguments.js",
      "./given/choices.js",
      "./terminal/output.js",
      "@groma/georef/printable",
      "commander",
      "node:module",
    ]);
  });

  it("helps where no command is given, and names the command whose options are wrong", async () => {
    const bare = await groma();
    expect([bare.code, bare.stdout]).toEqual([1, ""]);
    expect(bare.stderr).toMatch(/^Usage: groma .*\n[\s\S]*convert .*<paths\.\.\.>/);
    const { stderr } = await groma("convert", "--colour", "a.las", "b.copc.laz");
    expect(stderr).toMatch(
      /^OPTION_INVALID: groma: unknown option '--colour'.*Run groma convert --help\.\n$/,
    );
  });

  it("helps with exit code 0", async () => {
    const { code, stdout } = await groma("--help");
    expect(code).toBe(0);
    expect(stdout).toMatch(/convert/);
    expect(await groma("help")).toEqual({ code, stdout, stderr: "" });
    const info = await groma("info", "--help");
    expect(await groma("help", "info")).toEqual({ ...info, code: 0, stderr: "" });
  });

  it("says the version that all packages have", async () => {
    const read = (file: string) =>
      readFileSync(fileURLToPath(new URL(`../../${file}`, import.meta.url)), "utf8");
    const packages = ["georef", "layer", "converter", "demo"].map((name) => read(`${name}/package.json`));
    const crates = ["converter", "converter/wasm"].map((name) => read(`${name}/Cargo.toml`));
    const versions = new Set([
      ...packages.map((text) => JSON.parse(text).version),
      ...crates.map((text) => /^version = "(.*)"/m.exec(text)?.[1]),
    ]);
    expect([(await groma("--version")).stdout.trim()]).toEqual([...versions]);
  });

  it("names what is empty", async () => {
    const { stderr } = await groma("convert", sample, "out3.copc.laz", "--temp-dir", "");
    expect(stderr).toContain("option '--temp-dir <DIR>' is empty; give a value, or leave it out");
    expect((await groma("info", "")).stderr).toContain("argument 1 is empty");
  });
});
