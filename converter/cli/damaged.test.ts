import { execFile, execFileSync } from "node:child_process";
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

const main = fileURLToPath(new URL("../dist/main.js", import.meta.url));
const generator = fileURLToPath(new URL("../../demo/sample/dist/generate.js", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "groma-damaged-"));

interface Outcome {
  code: number;
  stdout: string;
  stderr: string;
}

function groma(...args: string[]): Promise<Outcome> {
  return new Promise((resolve) => {
    execFile(process.execPath, [main, ...args], { cwd: folder }, (error, stdout, stderr) => {
      resolve({ code: error ? Number(error.code ?? 1) : 0, stdout, stderr });
    });
  });
}

/** The last JSON line of an outcome. */
const last = ({ stdout }: Outcome) => JSON.parse(stdout.trimEnd().split("\n").at(-1)!);

const put = (name: string, bytes: Uint8Array) => writeFileSync(join(folder, name), bytes);

beforeAll(() => {
  execFileSync(process.execPath, [generator, join(folder, "good.las"), "5000"]);
  const good = readFileSync(join(folder, "good.las"));
  const empty = Buffer.from(good.subarray(0, good.readUInt32LE(96)));
  empty.writeUInt32LE(0, 107);
  if (empty[25] === 4) empty.writeBigUInt64LE(0n, 247);
  put("empty.las", empty);
  put("cut.las", good.subarray(0, good.length - 100));
  put("none.las", new Uint8Array(0));
});
afterAll(() => rmSync(folder, { recursive: true }));

describe("several inputs, some of which are empty or cannot be read", () => {
  it("are converted without these, which are listed at the end", async () => {
    const inputs = ["empty.las", "cut.las", "good.las", "none.las"];
    const made = await groma("convert", ...inputs, "a.copc.laz", "--progress", "json");
    expect(made.code).toBe(0);
    const done = last(made);
    expect(done).toMatchObject({ event: "done", points: 4970 });
    expect(done.skipped.map(({ file, code }: { file: string; code: string }) => [file, code])).toEqual([
      ["empty.las", "INPUT_EMPTY"],
      ["cut.las", "INPUT_TRUNCATED"],
      ["none.las", "INPUT_MAGIC"],
    ]);
    expect(made.stdout.match(/"event":"warning","text":"[a-z]+\.las: skipped: /g)).toHaveLength(3);
    const { stdout } = await groma("convert", ...inputs, "b.copc.laz", "--progress", "plain");
    expect(stdout).toMatch(/^skipped +cut\.las: .* \(INPUT_TRUNCATED\)$/m);
    const plan = last(await groma("convert", ...inputs, "c.copc.laz", "--dry-run", "--json"));
    expect(plan).toMatchObject({ inputs: 1, points: 4970, skipped: done.skipped });
  });

  it("are links to nothing too, as tiles on a disk that is not there, and pipes", async () => {
    mkdirSync(join(folder, "tiles"));
    symlinkSync("../good.las", join(folder, "tiles/good.las"));
    for (const name of ["gone.e57", "gone.las"]) symlinkSync(`/nowhere/${name}`, join(folder, "tiles", name));
    execFileSync("mkfifo", [join(folder, "tiles/pipe.e57")]);
    const plan = last(await groma("convert", "tiles", "e.copc.laz", "--dry-run", "--json"));
    expect(plan).toMatchObject({ inputs: 1, points: 4970 });
    expect(plan.skipped.map(({ file, code }: { file: string; code: string }) => [file, code])).toEqual([
      ["tiles/gone.e57", "INPUT_NOT_FOUND"],
      ["tiles/gone.las", "INPUT_NOT_FOUND"],
      ["tiles/pipe.e57", "INPUT_NOT_FOUND"],
    ]);
    const strict = await groma("convert", "tiles", "e.copc.laz", "--dry-run", "--strict");
    expect([strict.code, strict.stderr]).toEqual([
      1,
      expect.stringMatching(/^INPUT_NOT_FOUND: tiles\/(gone|pipe)\./m),
    ]);
  });

  it("are refused with --strict, and so is one that is alone or not there", async () => {
    const refused: [string[], RegExp][] = [
      [["good.las", "empty.las", "d.copc.laz", "--strict"], /^INPUT_EMPTY: empty\.las: /],
      [["good.las", "cut.las", "d.copc.laz", "--strict"], /^INPUT_TRUNCATED: cut\.las: /],
      [["empty.las", "d.copc.laz"], /^INPUT_EMPTY: empty\.las: /],
      [["good.las", "misspelt.las", "d.copc.laz"], /^INPUT_NOT_FOUND: misspelt\.las: /],
      [["empty.las", "cut.las", "d.copc.laz"], /^INPUT_NONE: empty\.las: none of the 2 inputs can be read: /],
    ];
    for (const [args, message] of refused) {
      const { code, stderr } = await groma("convert", ...args, "--progress", "plain");
      expect(stderr.trimEnd().split("\n").at(-1)).toMatch(message);
      expect(code).toBe(1);
    }
    expect(existsSync(join(folder, "d.copc.laz"))).toBe(false);
  });
});

it("a LAZ that lacks points is truncated, as a LAS is; what is there can be had", async () => {
  await groma("convert", "good.las", "all.copc.laz");
  const bytes = readFileSync(join(folder, "all.copc.laz"));
  // The number of points by LAS 1.4; the older field is 0 or the same.
  expect(bytes.readBigUInt64LE(247)).toBe(4970n);
  bytes.writeBigUInt64LE(4980n, 247);
  if (bytes.readUInt32LE(107) > 0) bytes.writeUInt32LE(4980, 107);
  put("short.copc.laz", bytes);
  const lost = /the chunk table covers 4970 of 4980 points; .* 10 are not in the file/;
  const made = await groma("convert", "short.copc.laz", "rest.copc.laz", "--progress", "json");
  expect(last(made)).toMatchObject({ event: "done", points: 4970 });
  expect(made.stdout).toMatch(lost);
  for (const args of [
    ["convert", "short.copc.laz", "none.copc.laz", "--strict"],
    ["info", "short.copc.laz", "--verify"],
  ]) {
    const { code, stderr } = await groma(...args);
    expect(stderr).toMatch(/^INPUT_TRUNCATED: short\.copc\.laz: /m);
    expect(stderr).toMatch(lost);
    expect(stderr).toMatch(/its writer, the copy or the download stopped early/);
    expect(code).toBe(1);
  }
  expect(existsSync(join(folder, "none.copc.laz"))).toBe(false);
});

it("an output that is not named as LAZ is refused", async () => {
  const { code, stderr } = await groma("convert", "good.las", "out.las");
  expect(stderr).toMatch(/OUTPUT_NAME: out\.las: .*\.copc\.laz/);
  expect(code).toBe(1);
});

describe("groma info --verify", () => {
  it("tells that all points are as they were written, or which are not", async () => {
    await groma("convert", "good.las", "whole.copc.laz");
    const told = JSON.parse((await groma("info", "whole.copc.laz", "--verify", "--json")).stdout);
    expect(told).toMatchObject({
      checksums: "CRC-32C",
      verified: { points: 4970, checksums: true },
    });
    expect((await groma("info", "whole.copc.laz")).stdout).toMatch(/^checksums +CRC-32C of each node/m);
    const bytes = readFileSync(join(folder, "whole.copc.laz"));
    const at = Number(bytes.readBigUInt64LE(bytes.readUInt32LE(96))) - 1000;
    bytes[at]! ^= 1;
    put("damaged.copc.laz", bytes);
    for (const args of [
      ["info", "damaged.copc.laz", "--verify"],
      ["convert", "damaged.copc.laz", "again.copc.laz"],
    ]) {
      const { code, stderr } = await groma(...args);
      expect(stderr).toMatch(
        /^INPUT_CHECKSUM: damaged\.copc\.laz: .*the points of node \d+-\d+-\d+-\d+ are/m,
      );
      expect(code).toBe(1);
    }
  });

  it("decodes the points of a file without checksums", async () => {
    const { stdout } = await groma("info", "good.las", "--verify");
    expect(stdout).toMatch(/^checksums +none stored; 1 chunk with 4,970 points decode$/m);
  });
});
