// `npm run mutants ROOM [--lines N] [FILE …]`: changes the sources of a room in small ways, one at a time, and says how
// many of the changes its tests notice. Not part of `npm test`: a room takes an hour and more, a file minutes. `--lines`
// takes a sample of a room of TypeScript: what can be changed within N lines, drawn by GROMA_SEED among those with code.
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const root = join(fileURLToPath(new URL(".", import.meta.url)), "..");
const artifacts = join(root, "tests/artifacts/mutants");

/** A room of TypeScript, by Stryker: every source of a folder against the tests of these places. */
const typescript = (folder, ...tests) => ({ tool: stryker, folder, tests: [folder, ...tests] });

/** A room of the core, by cargo-mutants: every source of a folder against the tests in it. */
const rust = (folder) => ({ tool: cargoMutants, folder });

/** Rooms by name. */
const ROOMS = new Map([
  ["georeference", typescript("georef/src/georeference")],
  ["transformation", typescript("georef/src/transformation", "georef/src/georeference")],
  ["crs", typescript("georef/src/crs", "georef/src/georeference")],
  ["octree", typescript("layer/src/octree")],
  ["query", typescript("layer/src/query")],
  ["cloud", typescript("layer/src/cloud")],
  ["clips", typescript("layer/src/clips")],
  ["effects", typescript("layer/src/effects")],
  ["options", typescript("layer/src/options", "layer/src/effects")],
  ["sampling", rust("src/sampling")],
  ["cells", rust("src/octree")],
]);

/** Changes that no test can notice: texts for people. */
const SILENT = ["StringLiteral"];

/** Files of a room's sources, or single lines of them (`file:7-7`). */
function sourcesOf(folder, files, lines) {
  const sources = readdirSync(join(root, folder), { recursive: true, encoding: "utf8" })
    .filter(
      (name) => /(?<!\.(test|fixture|d))\.ts$/.test(name) && (files.length === 0 || files.includes(name)),
    )
    .map((name) => `${folder}/${name}`);
  if (lines === undefined) return sources;
  const all = sources.sort().flatMap((path) =>
    readFileSync(join(root, path), "utf8")
      .split("\n")
      .flatMap((text, at) =>
        /^\s*(\/\/|\/?\*|import |export \{|\}?$)/.test(text) ? [] : `${path}:${at + 1}-${at + 1}`,
      ),
  );
  const drawn = (line) => createHash("sha256").update(`${process.env.GROMA_SEED} ${line}`).digest("hex");
  return all
    .map((line) => [drawn(line), line])
    .sort(([a], [b]) => (a < b ? -1 : 1))
    .slice(0, lines)
    .map(([, line]) => line);
}

/**
 * @param files names within the room's folder, such as `certificate.ts`; none stands for all
 * @param lines number of lines to be drawn among those of the files; undefined: all of the files
 * @returns mutants by what became of them
 */
async function stryker({ folder, tests }, files, lines) {
  const { Stryker } = await import("@stryker-mutator/core");
  process.env.GROMA_MUTANTS_TESTS = tests.join(",");
  process.env.GROMA_SEED ??= "20150217";
  process.env.GROMA_FUZZ_RUNS ??= "200";
  const results = await new Stryker({
    mutate: sourcesOf(folder, files, lines),
    mutator: { excludedMutations: SILENT },
    testRunner: "vitest",
    plugins: ["@stryker-mutator/vitest-runner"],
    vitest: { configFile: "tests/mutants.config.ts", related: false },
    coverageAnalysis: "perTest",
    ignoreStatic: true,
    concurrency: Number(process.env.GROMA_MUTANTS_CONCURRENCY ?? 2),
    timeoutMS: 20_000,
    reporters: ["clear-text", "progress-append-only"],
    clearTextReporter: { allowColor: false, reportTests: false, reportMutants: false },
    tempDirName: "tests/artifacts/mutants/sandbox",
    ignorePatterns: ["dist", "target", ".venv", "/tests/artifacts", "/docs"],
    allowEmpty: false,
  }).runMutationTest();
  return results.map(({ status, fileName, location, mutatorName, replacement }) => ({
    ...{ status, file: fileName.replace(`${root}/`, ""), line: location.start.line },
    ...{ change: mutatorName, replacement },
  }));
}

/** What cargo-mutants calls what became of a mutant, and Stryker's word for it. */
const STATUS = new Map([
  ["CaughtMutant", "Killed"],
  ["Timeout", "Timeout"],
  ["MissedMutant", "Survived"],
  ["Unviable", "CompileError"],
]);

/**
 * Needs `cargo install cargo-mutants --locked` (27.1 or newer).
 *
 * @param files names within the room's folder, such as `lattice.rs`; none stands for all
 * @returns mutants by what became of them
 */
function cargoMutants({ folder }, files) {
  const named = files.length > 0 ? files.map((file) => `${folder}/${file}`) : [`${folder}/*.rs`];
  const { error } = spawnSync(
    "cargo",
    [
      ...["mutants", "--dir", join(root, "converter"), "--output", artifacts, "--no-shuffle"],
      ...["--jobs", process.env.GROMA_MUTANTS_CONCURRENCY ?? "1", "--timeout", "120"],
      ...named.flatMap((file) => ["--file", file]),
      // What only tests use.
      ...["properties", "scene"].flatMap((file) => ["--exclude", `${folder}/${file}.rs`]),
      ...["--", "--lib", folder.split("/").at(-1)],
    ],
    { stdio: "inherit", env: { ...process.env, PROPTEST_CASES: process.env.PROPTEST_CASES ?? "64" } },
  );
  if (error) throw error;
  const { outcomes } = JSON.parse(readFileSync(join(artifacts, "mutants.out/outcomes.json"), "utf8"));
  return outcomes.flatMap(({ scenario: { Mutant: mutant }, summary }) => {
    if (mutant === undefined) return [];
    const { file, span, genre, replacement } = mutant;
    const status = STATUS.get(summary) ?? summary;
    return [{ status, file: `converter/${file}`, line: span.start.line, change: genre, replacement }];
  });
}

const { values, positionals } = parseArgs({ allowPositionals: true, options: { lines: { type: "string" } } });
const [name, ...files] = positionals;
const room = ROOMS.get(name);
if (!room) {
  console.error(
    `npm run mutants ROOM [--lines N] [FILE …]: no room "${name ?? ""}"; there are ${[...ROOMS.keys()].join(", ")}`,
  );
  process.exit(1);
}
const mutants = await room.tool(room, files, values.lines && Number(values.lines));
const count = (...statuses) => mutants.filter(({ status }) => statuses.includes(status)).length;
const killed = count("Killed", "Timeout");
const lived = mutants.filter(({ status }) => status === "Survived" || status === "NoCoverage");
for (const { file, line, change, replacement } of lived) {
  console.log(`${file}:${line} lives: ${change} → ${(replacement ?? "").replace(/\s+/g, " ").slice(0, 80)}`);
}
mkdirSync(artifacts, { recursive: true });
writeFileSync(join(artifacts, `${name}.json`), JSON.stringify(mutants, null, 1));
const share = ((100 * killed) / Math.max(1, killed + lived.length)).toFixed(1);
console.log(`\n${name}: ${killed} of ${killed + lived.length} mutants killed (${share} %)`);
