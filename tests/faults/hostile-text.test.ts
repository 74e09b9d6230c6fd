import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { homedir, tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { projMissing } from "../proj.js";
import { projectRoot } from "../project.js";

// Every command on files whose names and contents steer a terminal, hide or reorder text, forge lines, or are names that
// every object of JavaScript inherits.

const main = join(projectRoot, "converter/dist/main.js");
const folder = mkdtempSync(join(tmpdir(), "groma-hostile-"));
const cache = join(folder, "cache");
const HOSTILE = "\x1b[31mred\x1b]0;title\x07\x9b2J\r\nforged  row\u202etxt.exe\u200b";
/** What no line may hold: anything unseen but the break at its end. */
const UNSEEN = /[^\P{C}\n]|[\p{Zl}\p{Zp}]/u;
const PROTOTYPE_NAMES = ["__proto__", "constructor", "toString"];

/** Fails a process that changes what all objects inherit. */
const guard = `data:text/javascript,${encodeURIComponent(
  `const names = () => Reflect.ownKeys(Object.prototype).map(String).sort().join();
   const before = names();
   process.on("exit", () => { if (names() !== before) process.exitCode = 99; });`,
)}`;

interface Outcome {
  readonly code: number | null;
  readonly stdout: string;
  readonly stderr: string;
}

/** Runs a command; one that serves is stopped once it has printed what `until` matches. */
function groma(args: readonly string[], until?: RegExp): Promise<Outcome> {
  return new Promise((resolve) => {
    const child = spawn(process.execPath, ["--import", guard, main, ...args], {
      cwd: folder,
      env: { ...process.env, XDG_CACHE_HOME: cache },
      stdio: ["ignore", "pipe", "pipe"],
    });
    const said = { stdout: "", stderr: "" };
    for (const stream of ["stdout", "stderr"] as const) {
      child[stream].setEncoding("utf8").on("data", (chunk: string) => {
        said[stream] += chunk;
        if (until?.test(said.stdout)) child.kill();
      });
    }
    child.on("close", (code) => resolve({ code, ...said }));
  });
}

/** Header and content of a variable length record. */
function vlr(user: string, id: number, description: string, content: Buffer): Buffer {
  const header = Buffer.alloc(54);
  header.write(user, 2, 16, "latin1");
  header.writeUInt16LE(id, 18);
  header.writeUInt16LE(content.length, 20);
  header.write(description, 22, 32, "latin1");
  return Buffer.concat([header, content]);
}

/** A description of one byte of extra bytes (LAS 1.4 R15, table 23). */
function extraByte(name: string): Buffer {
  const description = Buffer.alloc(192);
  description[2] = 1;
  description.write(name, 4, 32, "latin1");
  return description;
}

const datum = 'DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]]';
const utm = (name: string) =>
  `PROJCS["${name}",GEOGCS["WGS 84",${datum},PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],` +
  'PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],' +
  'PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]]';

/** A LAS 1.4 file of ten points of format 6 near 9° E 48° N. */
function las(crsName: string, names: readonly string[], ...records: Buffer[]): Buffer {
  const points = 10;
  const length = 30 + names.length;
  const vlrs = Buffer.concat([
    vlr("LASF_Projection", 2112, HOSTILE, Buffer.from(`${utm(crsName)}\0`)),
    vlr("LASF_Spec", 4, "extra bytes", Buffer.concat(names.map(extraByte))),
    ...records,
  ]);
  const header = Buffer.alloc(375);
  header.write("LASF", 0, "latin1");
  header.writeUInt16LE(0x10, 6);
  header.set([1, 4], 24);
  header.write(HOSTILE, 26, 32, "latin1");
  header.write("\x1b[8mhidden", 58, 32, "latin1");
  header.writeUInt16LE(375, 94);
  header.writeUInt32LE(375 + vlrs.length, 96);
  header.writeUInt32LE(2 + records.length, 100);
  header[104] = 6;
  header.writeUInt16LE(length, 105);
  const [min, max] = [
    [500_000, 5_300_000, 0],
    [500_000.09, 5_300_000.09, 0.09],
  ];
  for (const axis of [0, 1, 2]) {
    header.writeDoubleLE(0.01, 131 + 8 * axis);
    header.writeDoubleLE(min[axis]!, 155 + 8 * axis);
    header.writeDoubleLE(max[axis]!, 179 + 16 * axis);
    header.writeDoubleLE(min[axis]!, 187 + 16 * axis);
  }
  header.writeBigUInt64LE(BigInt(points), 247);
  const body = Buffer.alloc(points * length);
  for (let point = 0; point < points; point++) {
    for (const axis of [0, 1, 2]) body.writeInt32LE(point, point * length + 4 * axis);
    body[point * length + 14] = 0x11;
    names.forEach((_, index) => {
      body[point * length + 30 + index] = point + index;
    });
  }
  return Buffer.concat([header, vlrs, body]);
}

/** One name may not hold what ends a path or a string of C. */
const fileName = `${HOSTILE}.las`;
const proto = "proto.las";
const damaged = "damaged-statistics.las";

beforeAll(() => {
  writeFileSync(join(folder, fileName), las(HOSTILE, [`\x1b[31m<b>`, ...PROTOTYPE_NAMES]));
  writeFileSync(join(folder, proto), las("UTM", PROTOTYPE_NAMES));
  const statistics = '{"version":1,"attributes":[{"name":"__proto__"}],"classes":{"__proto__":1}}';
  writeFileSync(join(folder, damaged), las("UTM", [], vlr("groma", 2, "", Buffer.from(statistics))));
  writeFileSync(join(folder, "points.txt"), "500000.05 5300000.05 0\n");
  writeFileSync(join(folder, "bad-points.txt"), `1 2 ${HOSTILE}\n`);
  mkdirSync(join(folder, `sub${HOSTILE}`));
  // Nothing of these files goes to the user's own cache; the PROJ that is there is theirs too.
  mkdirSync(join(cache, "groma"), { recursive: true });
  const own = process.env.XDG_CACHE_HOME || join(homedir(), ".cache");
  symlinkSync(join(own, "groma/proj"), join(cache, "groma/proj"));
});
afterAll(() => rmSync(folder, { recursive: true }));

describe("hostile names and contents", () => {
  const locate = (file: string, points: string, ...more: string[]) => [
    "locate",
    file,
    "--points",
    points,
    ...more,
  ];
  it.each<[string, string[], number, RegExp?]>([
    ["info", ["info", fileName], 0],
    ["info of names that objects inherit", ["info", proto], 0],
    ["info of a damaged statistics record", ["info", damaged], 0],
    ["info --json", ["info", "--json", fileName], 0],
    ["info of a file that is not there", ["info", `not${fileName}`], 1],
    ["convert", ["convert", fileName, `${HOSTILE}.copc.laz`, "--progress", "plain"], 0],
    ["convert with a bar", ["convert", proto, "bar.copc.laz", "--progress", "bar"], 0],
    ["convert for machines", ["convert", fileName, "json.copc.laz", "--progress", "json"], 0],
    ["convert --dry-run", ["convert", fileName, `dry${HOSTILE}.copc.laz`, "--dry-run"], 0],
    ["convert onto what is there", ["convert", fileName, fileName], 1],
    ["an option that does not exist", ["info", fileName, `--${HOSTILE}`], 1],
    ["a CRS that does not exist", ["convert", fileName, "crs.copc.laz", "--crs", HOSTILE], 1],
    ["locate", locate(fileName, "points.txt"), 0],
    ["locate --json", locate(fileName, "points.txt", "--json"), 0],
    ["locate with odd points", locate(fileName, "bad-points.txt"), 1],
    ["locate from an odd system", locate(fileName, "points.txt", "--inverse", HOSTILE), 1],
    ["georef", ["georef", `${HOSTILE}.copc.laz`], 0],
    ["georef of what is no COPC", ["georef", fileName], 1],
    ["grids", ["grids", fileName], projMissing ? 1 : 0],
    ["serve", ["serve", `sub${HOSTILE}`, "--port", "0"], 0, /http:/],
    ["view", ["view", fileName, "--port", "0", "--progress", "plain"], 0, /http:/],
  ])("%s: shows nothing raw and changes nothing that objects inherit", async (_what, args, code, until) => {
    const { stdout, stderr, code: ended } = await groma(args, until);
    const bar = args.includes("bar");
    expect(`${stdout}${bar ? "" : stderr}`).not.toMatch(UNSEEN);
    expect(stdout + stderr).toMatch(/\S/);
    expect(`${stdout}${stderr}`).not.toContain("INTERNAL");
    // A server ends by the signal that stops it.
    expect(ended).toBe(until ? null : code);
  });

  it("are escaped to be read by people, exact for programs", async () => {
    const text = (await groma(["info", fileName])).stdout;
    expect(text).toContain(
      "\\u{1b}[31mred\\u{1b}]0;title\\u{7}\\u{9b}2J\\u{d}\\u{a}forged  row\\u{202e}txt.exe\\u{200b}",
    );
    expect(text).not.toMatch(/^forged/m);
    const json = JSON.parse((await groma(["info", "--json", fileName])).stdout);
    expect(json.file).toBe(fileName);
    expect(json.crs.name).toBe(HOSTILE);
    expect(json.extraBytes.map(({ name }: { name: string }) => name)).toEqual([
      "\x1b[31m<b>",
      ...PROTOTYPE_NAMES,
    ]);
  });

  it("are attributes like others where objects inherit such names", async () => {
    const { statistics } = JSON.parse((await groma(["info", "--json", proto])).stdout);
    const found = new Map(
      statistics.attributes.map(({ name, ...rest }: { name: string }) => [name, rest] as const),
    );
    PROTOTYPE_NAMES.forEach((name, index) => {
      expect(found.get(name)).toEqual({ min: index, max: 9 + index, mean: 4.5 + index });
    });
    expect(statistics.classes).toEqual({ 0: 10 });
  });
});
