import { type ChildProcess, spawn, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { launch, openPage, screenshot } from "../browser/harness.js";
import { lasOf } from "../faults/las-bytes.js";
import { coreMissing } from "../interop/core.js";
import { projectRoot } from "../project.js";
import { type Installation, install, type Packed, pack, projMissing } from "./packed.js";

const skipped = process.platform === "win32" ? "the test is written for a POSIX shell" : coreMissing;
const why = skipped ? ` (skipped: ${skipped})` : "";
const tarballs = mkdtempSync(join(tmpdir(), "groma-packages-"));
let packed = new Map<string, Packed>();
let place: Installation;
const children: ChildProcess[] = [];

beforeAll(async () => {
  if (skipped) return;
  packed = pack(tarballs);
  place = await install(packed, ["@groma/converter", "@groma/layer", "@groma/georef", "cesium", "ol"]);
  writeFileSync(join(place.folder, "scan.las"), lasOf(20_000));
}, 480_000);
afterAll(() => {
  for (const child of children) child.kill();
  place?.remove();
  rmSync(tarballs, { recursive: true, force: true });
}, 480_000);

/** Runs the installed `groma` in the folder. */
function groma(args: readonly string[], environment: NodeJS.ProcessEnv = {}) {
  const env = { ...place.environment, ...environment };
  const { status, stdout, stderr } = spawnSync(join(place.folder, "node_modules/.bin/groma"), args, {
    ...{ cwd: place.folder, env, encoding: "utf8", timeout: 60_000 },
  });
  return { status, stdout, stderr };
}

/** Starts a command that serves, and waits for its address. */
function serving(args: readonly string[]): Promise<string> {
  const child = spawn(join(place.folder, "node_modules/.bin/groma"), args, {
    ...{ cwd: place.folder, env: place.environment, stdio: ["ignore", "pipe", "pipe"] },
  });
  children.push(child);
  let output = "";
  return new Promise((resolve, reject) => {
    for (const stream of [child.stdout, child.stderr]) {
      stream.on("data", (chunk) => {
        output += chunk;
        const address = /http:\/\/\S+/.exec(output)?.[0];
        if (address) resolve(address);
      });
    }
    child.on("close", () => reject(new Error(output)));
  });
}

describe.skipIf(skipped)(`packages, packed${why}`, () => {
  it("hold nothing of tests, sources or the project, and their licences", () => {
    expect([...packed.keys()].sort()).toEqual([
      ...["@groma/converter", expect.stringMatching(/^@groma\/core-/), "@groma/georef", "@groma/layer"],
    ]);
    for (const [name, { files, description, read }] of packed) {
      const foreign = files.filter((file) =>
        /\.(rs|map|tsbuildinfo)$|\.(test|fixture)\.|Cargo|fuzz|(^|\/)\.|(?<!\.d)\.ts$/.test(file),
      );
      expect([name, foreign]).toEqual([name, []]);
      for (const file of ["README.md", "LICENSE", "THIRD-PARTY-NOTICES.txt"]) expect(files).toContain(file);
      expect(Object.keys(description)).not.toContain("devDependencies");
      expect(read("README.md")).toContain(`# ${name}`);
    }
  });

  it("name every licence of what they contain, each one free to pass on", () => {
    for (const [name, { read, description, path }] of packed) {
      const notices = read("THIRD-PARTY-NOTICES.txt");
      for (const needed of Object.keys(description.dependencies ?? {})) {
        if (!needed.startsWith("@groma/")) expect(notices).toContain(`\n${needed} `);
      }
      const licences = [...notices.matchAll(/^Licence: (.*)$/gm)].map(([, licence]) => licence!);
      expect(licences.length).toBeGreaterThan(1);
      const free = /MIT|ISC|BSD|Apache-2\.0|0BSD|Unlicense|CC0-1\.0|Zlib|blessing|libtiff/;
      expect([name, licences.filter((licence) => !free.test(licence))]).toEqual([name, []]);
      expect(existsSync(path.replace(/\.tgz$/, ".cdx.json"))).toBe(true);
    }
    const page = packed.get("@groma/converter")!.read("THIRD-PARTY-NOTICES.txt");
    for (const shown of ["cesium 1.", "ol 10.", "d3-scale ", "three ", "clap ", "@bjorn3/browser_wasi_shim "])
      expect(page).toContain(`\n${shown}`);
  });

  it("are as publint and attw want them", { timeout: 120_000 }, async () => {
    const { publint } = await import("publint");
    const { formatMessage } = await import("publint/utils");
    for (const [name, { path, description }] of packed) {
      const bytes = readFileSync(path);
      const tarball = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
      const { messages } = await publint({ pack: { tarball }, strict: true });
      expect([name, messages.map((message) => formatMessage(message, description))]).toEqual([name, []]);
    }
    for (const name of ["@groma/georef", "@groma/layer"]) {
      const attw = join(projectRoot, "node_modules/@arethetypeswrong/cli/dist/index.js");
      const untyped = Object.keys(packed.get(name)!.description.exports!).filter((entry) =>
        /\.(js(on)?|wasm)$/.test(entry),
      );
      const args = ["--profile", "esm-only", "--format", "json", "--exclude-entrypoints", ...untyped, "--"];
      const told = spawnSync(process.execPath, [attw, ...args, packed.get(name)!.path], { encoding: "utf8" });
      expect([name, told.status, told.status === 0 ? "" : told.stdout + told.stderr]).toEqual([name, 0, ""]);
    }
  });
});

describe.skipIf(skipped)(`an installation far from the project${why}`, () => {
  it("asks for nothing that the packages do not name", () => {
    const others = Object.keys(packed.get("@groma/converter")!.description.optionalDependencies!);
    expect(place.missing.filter((name) => !others.includes(name))).toEqual([]);
  });

  it("imports every entry where there is no DOM", () => {
    const entries = ["@groma/georef", "@groma/layer"].flatMap((name) =>
      Object.keys(packed.get(name)!.description.exports!)
        .filter((entry) => !/json$|worker|wasm$/.test(entry))
        .map((entry) => `${name}${entry.slice(1)}`),
    );
    expect(entries).toContain("@groma/layer/cesium");
    const code = `for (const name of ${JSON.stringify(entries)}) { const all = await import(name); if (Object.keys(all).length === 0) throw new Error(name); }`;
    const { status, stderr } = spawnSync(process.execPath, ["--input-type=module", "-e", code], {
      ...{ cwd: place.folder, encoding: "utf8" },
    });
    expect([status, stderr]).toEqual([0, ""]);
  });

  it("converts and tells what it made", () => {
    const made = groma([
      "convert",
      "scan.las",
      "site.copc.laz",
      "--crs",
      "EPSG:32632",
      "--vertical",
      "ellipsoidal",
    ]);
    expect([made.status, made.stderr]).toEqual([0, expect.any(String)]);
    const told = JSON.parse(groma(["info", "site.copc.laz", "--json"]).stdout);
    expect(told.points).toBe(20_000);
  });

  it.skipIf(projMissing)(
    `places by the PROJ of its package${projMissing ? ` (skipped: ${projMissing})` : ""}`,
    () => {
      // Without the system's programs.
      const options = ["--crs", "EPSG:32632", "--vertical", "ellipsoidal", "--engine", "proj", "--overwrite"];
      const path = { PATH: "/nonexistent" };
      const bin = join(place.folder, "node_modules/@groma/converter/bin/groma.mjs");
      const { status, stdout, stderr } = spawnSync(
        process.execPath,
        [bin, "convert", "scan.las", "proj.copc.laz", ...options],
        {
          ...{ cwd: place.folder, env: { ...place.environment, ...path }, encoding: "utf8" },
        },
      );
      expect([status, stderr]).toEqual([0, expect.any(String)]);
      expect(stdout).toContain("PROJ 9.6.2");
    },
  );

  it("serves and draws", { timeout: 150_000 }, async () => {
    const folder = await serving(["serve", ".", "--port", "0"]);
    const part = await fetch(new URL("site.copc.laz", folder), { headers: { range: "bytes=0-3" } });
    expect([part.status, await part.text()]).toEqual([206, "LASF"]);

    const address = await serving(["view", "site.copc.laz", "--port", "0"]);
    const notices = await fetch(new URL("THIRD-PARTY-NOTICES.txt", address));
    expect(await notices.text()).toContain("\ncesium 1.");
    const browser = await launch();
    try {
      const { page, watch } = await openPage(browser, { width: 640, height: 480 });
      await page.goto(address);
      const drawn = await page.waitForFunction(
        () => {
          const layer = (
            globalThis as { groma?: { layer?: { settled: boolean; statistics: { pointsDrawn: number } } } }
          ).groma?.layer;
          return layer?.settled && layer.statistics.pointsDrawn;
        },
        undefined,
        { timeout: 120_000 },
      );
      expect(await drawn.jsonValue()).toBeGreaterThan(1_000);
      expect([watch.errors, watch.foreign]).toEqual([[], []]);
      await screenshot(page, "installed");
    } finally {
      await browser.close();
    }
  });

  it("says in one sentence what to do on another platform, and with an old Node", () => {
    const core = [...packed.keys()].find((name) => name.startsWith("@groma/core-"))!;
    const folder = join(place.folder, "node_modules", core);
    renameSync(folder, `${folder}-away`);
    const missing = groma(["convert", "scan.las", "other.copc.laz", "--crs", "EPSG:32632"]);
    renameSync(`${folder}-away`, folder);
    expect(missing.status).toBe(1);
    expect(missing.stderr).toMatch(/^CORE_MISSING: .*: there is no core for this platform \(.*\)/m);
    expect(missing.stderr).toMatch(/cargo build --release/);

    const bin = join(place.folder, "node_modules/@groma/converter/bin/groma.mjs");
    const old = `Object.defineProperty(process, "versions", { value: { ...process.versions, node: "18.20.4" } }); await import(${JSON.stringify(bin)});`;
    const told = spawnSync(process.execPath, ["--input-type=module", "-e", old], { encoding: "utf8" });
    expect(told).toMatchObject({
      status: 1,
      stderr: "NODE_VERSION: groma: this is Node.js 18.20.4. Install Node.js 20.19 or newer.\n",
    });
  });
});
