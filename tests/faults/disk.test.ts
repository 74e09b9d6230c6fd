import { execFileSync, spawnSync } from "node:child_process";
import {
  closeSync,
  existsSync,
  mkdirSync,
  openSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { join } from "node:path";
import { afterAll, afterEach, beforeAll, describe, expect, it, test } from "vitest";
import { titled } from "../interop/comparison.js";
import { convert, coreMissing, filesOf, makeFolder, type Outcome } from "../interop/core.js";
import { projectRoot } from "../project.js";
import { lasOf } from "./las-bytes.js";

const folder = makeFolder();
const path = (name: string) => join(folder, name);
const files = ["in.las", "old.copc.laz"];
beforeAll(() => {
  writeFileSync(path("in.las"), lasOf(300_000));
  writeFileSync(path("old.copc.laz"), "old");
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** One error of the code, told in full, and every file as it was. */
function expectRefused({ status, signal, events }: Outcome, code: string | RegExp): void {
  expect({ status, signal }).toEqual({ status: 1, signal: null });
  expect(events.filter(({ event }) => event === "error")).toHaveLength(1);
  expect(events.at(-1)).toMatchObject({ code: expect.stringMatching(code), cause: expect.any(String) });
  expect(filesOf(folder)).toEqual(files);
  expect(readFileSync(path("old.copc.laz"), "utf8")).toBe("old");
}

describe.skipIf(coreMissing)("places that take no file", () => {
  it.each<[string, string, string, string[]]>([
    ["an output in a folder that is not there", "OUTPUT_WRITE", "no/such/out.laz", []],
    ["an output that is a folder", "OUTPUT_WRITE", ".", ["--overwrite"]],
    ["an output in a file", "OUTPUT_WRITE", "in.las/out.laz", []],
    ["an output that is there", "OUTPUT_EXISTS", "old.copc.laz", []],
    ["an output that is the input", "OUTPUT_INPUT", "in.las", ["--overwrite"]],
    ["a temporary folder that is not there", "OPTION_TEMP_DIR", "out.laz", ["--temp-dir", "/no/such"]],
    ["a temporary folder that is a file", "OPTION_TEMP_DIR", "out.laz", ["--temp-dir", "in.las"]],
  ])("%s: %s", async (_, code, output, options) => {
    const named = options.map((option) => (option === "in.las" ? path(option) : option));
    expectRefused(await convert([path("in.las"), path(output), ...named]), code);
  });

  const noProc = existsSync("/proc/self") ? "" : " (skipped: this system has no /proc)";
  it.skipIf(noProc)(`an output in a folder that nobody may write to${noProc}`, async () => {
    const outcome = await convert([path("in.las"), "/proc/out.copc.laz"]);
    expectRefused(outcome, "OUTPUT_WRITE");
  });

  // Root may write anywhere but in a file system that takes none.
  it.skipIf(noProc)(`a temporary folder that nobody may write to${noProc}`, async () => {
    const outcome = await convert([path("in.las"), path("out.laz"), "--temp-dir", "/proc/self"]);
    expectRefused(outcome, "TEMP_FILE");
  });

  it("a disk that is full halfway through the output leaves the old one", async () => {
    for (const fileSize of [0, 1, 100, 1000]) {
      const outcome = await convert([path("in.las"), path("old.copc.laz"), "--overwrite"], { fileSize });
      expectRefused(outcome, /^(OUTPUT_WRITE|TEMP_\w+)$/);
    }
  });
});

describe.skipIf(coreMissing)("inputs that are no files", () => {
  const odd = path("odd");
  afterEach(() => rmSync(odd, { recursive: true, force: true }));

  it.each<[string, string, () => void]>([
    ["a folder without scans", odd, () => mkdirSync(odd)],
    ["a link to itself", odd, () => symlinkSync("odd", odd)],
    ["a link to nothing", odd, () => symlinkSync("nothing", odd)],
    ["a device without end", "/dev/zero", () => undefined],
    ["an empty device", "/dev/null", () => undefined],
    ["a pipe that nobody writes to", odd, () => execFileSync("mkfifo", [odd])],
  ])("%s is refused at once", async (_, input, make) => {
    make();
    const { status, signal, events } = await convert([input, path("out.laz")], { timeout: 5000 });
    rmSync(odd, { recursive: true, force: true });
    expect({ status, signal }).toEqual({ status: 1, signal: null });
    expect(events.at(-1)).toMatchObject({ event: "error", code: expect.stringMatching(/^INPUT_/) });
    expect(filesOf(folder)).toEqual(files);
  });
});

/** A small file system of its own; why there is none where it cannot be made. */
function smallDisk(): { mount: string; missing: string | undefined } {
  const mount = makeFolder();
  const { status } = spawnSync("mount", ["-t", "tmpfs", "-o", "size=2m", "none", mount], { stdio: "ignore" });
  return { mount, missing: status === 0 ? undefined : "only root may make a small disk" };
}

describe.skipIf(coreMissing || process.platform !== "linux")("a disk that is too small", () => {
  const { mount, missing } = smallDisk();
  afterAll(() => {
    if (missing === undefined) execFileSync("umount", [mount]);
    rmSync(mount, { recursive: true, force: true });
  });

  test.skipIf(missing)(titled("for the output is told, and stays empty", missing), async () => {
    const outcome = await convert([path("in.las"), join(mount, "out.copc.laz")]);
    expect(outcome).toMatchObject({ status: 1, signal: null });
    expect(outcome.events.at(-1)!.code).toMatch(/^(OUTPUT_WRITE|TEMP_SPACE)$/);
    expect(filesOf(mount)).toEqual([]);
  });
});

const noFull = existsSync("/dev/full") ? "" : " (skipped: this system has no /dev/full)";
it.skipIf(noFull)(`output that has no room is told in one sentence${noFull}`, () => {
  const main = join(projectRoot, "converter/dist/main.js");
  const full = openSync("/dev/full", "w");
  for (const args of [["info", path("in.las")], ["info", path("in.las"), "--json"], ["--help"]]) {
    const { status, stderr } = spawnSync(process.execPath, [main, ...args], {
      ...{ stdio: ["ignore", full, "pipe"], encoding: "utf8" },
    });
    expect([status, stderr]).toEqual([
      1,
      "OUTPUT_WRITE: output of groma: it cannot be written (ENOSPC: no space left on device, write). Free space, or send it elsewhere.\n",
    ]);
  }
  closeSync(full);
});
