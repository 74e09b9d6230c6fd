import { execFile, spawn } from "node:child_process";
import {
  chmodSync,
  copyFileSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { fileURLToPath } from "node:url";
import { afterEach, beforeEach, describe, expect, it } from "vitest";

const main = fileURLToPath(new URL("../../dist/main.js", import.meta.url));
let folder = "";
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), "groma-pdal-"));
  mkdirSync(join(folder, "out"));
  writeFileSync(join(folder, "scan.e57"), "ASTM-E57 and so on");
});
afterEach(() => rmSync(folder, { recursive: true, force: true }));

interface Behaviour {
  /** Number that it announces and the bounds of the points. */
  readonly points?: number;
  /** LAS file that it gives for the points; without it, it never ends. */
  readonly gives?: string;
  /** What it complains of. */
  readonly complains?: string;
}

/** A program that answers as PDAL does, as far as Groma asks. */
function pdalThat({ points = 4, gives, complains }: Behaviour): string {
  const metadata = {
    stages: {
      "filters.stats": {
        statistic: ["X", "Y", "Z"].map((name) => ({ name, average: 0.5, minimum: 0, maximum: 1 })),
      },
      "filters.info": {
        num_points: points,
        schema: { dimensions: ["X", "Y", "Z"].map((name) => ({ name, size: 8, type: "floating" })) },
        srs: { compoundwkt: "", isgeographic: false },
      },
      "readers.e57": {},
    },
  };
  const program = join(folder, "pdal");
  writeFileSync(
    program,
    `#!${process.execPath}
const fs = require("node:fs");
if (process.argv[2] === "--version") console.log("pdal 2.9.9 (git-version: none)");
else if (${JSON.stringify(complains ?? "")}) { console.error("PDAL: " + ${JSON.stringify(complains ?? "")}); process.exitCode = 1; }
else if (process.argv.includes("--metadata")) console.log(${JSON.stringify(JSON.stringify(metadata))});
else {
  const { pipeline } = JSON.parse(fs.readFileSync(0, "utf8"));
  const { filename } = pipeline.at(-1);
  fs.writeFileSync(${JSON.stringify(join(folder, "pid"))}, String(process.pid));
  if (${JSON.stringify(gives ?? "")}) fs.copyFileSync(${JSON.stringify(gives ?? "")}, filename);
  else { fs.appendFileSync(filename, Buffer.alloc(1000)); setInterval(() => {}, 1000); }
}
`,
  );
  chmodSync(program, 0o755);
  return program;
}

/** A LAS 1.2 file with four points on the unit cube's corners. */
function fourPoints(): string {
  const bytes = Buffer.alloc(227 + 4 * 20);
  bytes.write("LASF", 0, "latin1");
  bytes.set([1, 2], 24);
  bytes.writeUInt16LE(227, 94);
  bytes.writeUInt32LE(227, 96);
  bytes.writeUInt16LE(20, 105);
  bytes.writeUInt32LE(4, 107);
  for (const axis of [0, 1, 2]) {
    bytes.writeDoubleLE(0.001, 131 + 8 * axis);
    bytes.writeDoubleLE(1, 179 + 16 * axis);
  }
  for (const [i, at] of [
    [0, 0, 0],
    [1000, 0, 0],
    [0, 1000, 0],
    [1000, 1000, 1000],
  ].entries()) {
    for (const [axis, value] of at.entries()) bytes.writeInt32LE(value, 227 + 20 * i + 4 * axis);
    bytes.writeUInt8(0b1001, 227 + 20 * i + 14);
  }
  const file = join(folder, "four.las");
  writeFileSync(file, bytes);
  return file;
}

const args = (...more: string[]) => {
  const place = ["--anchor", "7.9,46.5,800,0", "--progress", "json"];
  return [main, "convert", join(folder, "scan.e57"), join(folder, "out/o.copc.laz"), ...place, ...more];
};

function groma(...more: string[]): Promise<{ code: number; stdout: string; stderr: string }> {
  return new Promise((resolve) => {
    const env = { ...process.env, GROMA_PDAL: "", XDG_CACHE_HOME: folder, PATH: "/nowhere" };
    execFile(process.execPath, args(...more), { env }, (error, stdout, stderr) =>
      resolve({ code: error ? Number(error.code ?? 1) : 0, stdout, stderr }),
    );
  });
}

describe.skipIf(process.platform === "win32")("a conversion that needs PDAL", () => {
  it("names what is lacking, and how it is had", async () => {
    const { code, stderr } = await groma();
    expect(code).toBe(1);
    expect(stderr).toMatch(
      /^PDAL_MISSING: .*scan\.e57: .+\. Install PDAL \(.+\), or name its program with --pdal/,
    );
    expect((await groma("--pdal", "/nowhere/pdal")).stderr).toMatch(/^PDAL_MISSING: \/nowhere\/pdal: /);
  });

  it("takes the points, and keeps nothing of PDAL", async () => {
    const { code, stdout, stderr } = await groma("--pdal", pdalThat({ gives: fourPoints() }));
    expect(stderr).toBe("");
    expect(code).toBe(0);
    const lines = stdout
      .trim()
      .split("\n")
      .map((line) => JSON.parse(line));
    expect(lines.at(-1)).toMatchObject({ event: "done", points: 4, pdal: [{ version: "2.9.9", points: 4 }] });
    expect(new Set(lines.map(({ stage }) => stage))).toContain("pdal");
    expect(readdirSync(join(folder, "out"))).toEqual(["o.copc.laz"]);
  });

  it("refuses points that are not those announced", async () => {
    const { code, stdout, stderr } = await groma("--pdal", pdalThat({ points: 5, gives: fourPoints() }));
    expect(code).toBe(1);
    expect(stderr).toMatch(/^PDAL_MISMATCH: .*scan\.e57: PDAL announced 5 points but wrote 4\. /);
    expect(JSON.parse(stdout.trim().split("\n").at(-1)!)).toMatchObject({
      event: "error",
      code: "PDAL_MISMATCH",
    });
    expect(readdirSync(join(folder, "out"))).toEqual([]);
  });

  it("says what PDAL complains of", async () => {
    const { stderr } = await groma("--pdal", pdalThat({ complains: "Unable to open the file." }));
    expect(stderr).toMatch(/^PDAL_FAILED: .*scan\.e57: Unable to open the file\. /);
  });

  it("refuses before work starts what has no room", async () => {
    const { stderr } = await groma("--pdal", pdalThat({ points: 1e12, gives: fourPoints() }));
    expect(stderr).toMatch(
      /^TEMP_SPACE: .*: temporary files need 3\d{13} bytes, \d+ are free\. .*--temp-dir/,
    );
    expect(existsSync(join(folder, "pid"))).toBe(false);
  });

  it("refuses an output that is there before PDAL is run", async () => {
    copyFileSync(fourPoints(), join(folder, "out/o.copc.laz"));
    const { stderr } = await groma("--pdal", pdalThat({ gives: fourPoints() }));
    expect(stderr).toMatch(/^OUTPUT_EXISTS: /);
  });

  it("is stopped with PDAL, and leaves nothing", async () => {
    const child = spawn(process.execPath, args("--pdal", pdalThat({})), { stdio: "pipe" });
    let stderr = "";
    child.stderr.on("data", (text) => {
      stderr += text;
    });
    const ended = new Promise<number | null>((resolve) => child.on("close", resolve));
    while (!existsSync(join(folder, "pid")) && child.exitCode === null) await sleep(20);
    expect(readdirSync(join(folder, "out"))).toHaveLength(1);
    child.kill("SIGTERM");
    expect(await ended).toBe(1);
    expect(stderr).toMatch(/^INTERRUPTED: /);
    expect(readdirSync(join(folder, "out"))).toEqual([]);
  });

  it("removes what a killed one has left", async () => {
    const program = pdalThat({});
    const killed = spawn(process.execPath, args("--pdal", program), { stdio: "ignore" });
    const ended = new Promise((resolve) => killed.on("close", resolve));
    const pid = join(folder, "pid");
    while (!existsSync(pid) && killed.exitCode === null) await sleep(20);
    killed.kill("SIGKILL");
    await ended;
    // Nobody tells PDAL that its caller was killed.
    process.kill(Number(readFileSync(pid, "utf8")));
    expect(readdirSync(join(folder, "out"))).toHaveLength(1);
    const { code } = await groma("--pdal", pdalThat({ gives: fourPoints() }));
    expect(code).toBe(0);
    expect(readdirSync(join(folder, "out"))).toEqual(["o.copc.laz"]);
  });
});
