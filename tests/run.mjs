// `npm test [-- room …]`: set-up, then every check of the project; ends with "N passed, N failed, N skipped".
import { spawn } from "node:child_process";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { root, setup } from "../.ci/setup/main.mjs";
import { forTest } from "../.ci/setup/steps.mjs";

/** Properties are tried with the same numbers on every run; `GROMA_SEED=random` looks elsewhere, an integer repeats such a run. */
const seed = process.env.GROMA_SEED ?? "20150217";
const environment = {
  ...process.env,
  GROMA_SEED: seed,
  ...(seed === "random" ? {} : { PROPTEST_RNG_SEED: seed }),
  ...(process.stdout.isTTY ? {} : { NO_COLOR: "1" }),
};

/** Runs a program with its output returned, and shown as it comes unless it is held back. */
function run(program, args, { held = false } = {}) {
  return new Promise((done) => {
    const child = spawn(program, args, { cwd: root, env: environment, stdio: ["ignore", "pipe", "pipe"] });
    let output = "";
    for (const stream of [child.stdout, child.stderr]) {
      stream.on("data", (chunk) => {
        output += chunk;
        if (!held) process.stdout.write(chunk);
      });
    }
    child.on("error", (error) => done({ code: 1, output: String(error) }));
    child.on("close", (code) => done({ code: code ?? 1, output }));
  });
}

const node = (program, args, how) =>
  run(process.execPath, [join(root, "node_modules", program), ...args], how);
const npx = (program, ...args) => node(program, args);
const cargo = (...args) =>
  run("cargo", [args[0], "--manifest-path", "converter/Cargo.toml", ...args.slice(1)]);

/** A check that either holds or does not. */
const holds = (check) => async () => {
  const { code } = await check();
  return { passed: code === 0 ? 1 : 0, failed: code === 0 ? 0 : 1, skipped: 0 };
};

/** Rust's own tests, counted from cargo's closing lines; a build that fails counts as one failure. */
async function rust() {
  const { code, output } = await cargo("test", "--profile", "tested", "--locked", "--tests");
  const counts = { passed: 0, failed: 0, skipped: 0 };
  for (const [, passed, failed, ignored] of output.matchAll(
    /^test result: .*? (\d+) passed; (\d+) failed; (\d+) ignored/gm,
  )) {
    counts.passed += Number(passed);
    counts.failed += Number(failed);
    counts.skipped += Number(ignored);
  }
  if (code !== 0 && counts.failed === 0) counts.failed = 1;
  return counts;
}

/** Tests of the TypeScript suite in some rooms; a file that cannot be loaded counts as one failure. */
async function vitest(rooms, how) {
  const report = join(root, `tests/artifacts/vitest-${rooms.join("-")}.json`);
  rmSync(report, { force: true });
  const { code, output } = await node(
    "vitest/vitest.mjs",
    [
      ...["run", ...rooms.flatMap((room) => ["--project", room])],
      ...["--reporter=default", "--reporter=json", `--outputFile.json=${report}`],
    ],
    how,
  );
  try {
    const result = JSON.parse(readFileSync(report, "utf8"));
    const failed = Math.max(result.numFailedTests, code === 0 ? 0 : 1);
    const skipped = result.numPendingTests + result.numTodoTests;
    return { passed: result.numPassedTests, failed, skipped, output };
  } catch {
    return { passed: 0, failed: 1, skipped: 0, output };
  }
}

const checks = {
  "format and lint (TypeScript)": holds(() => npx("@biomejs/biome/bin/biome", "ci", ".")),
  "types of the tests": holds(() => npx("typescript-native/bin/tsc", "-p", "tests")),
  "format (Rust)": holds(() => cargo("fmt", "--check")),
  "format (Rust for the page)": holds(() =>
    run("cargo", ["fmt", "--check", "--manifest-path", "converter/wasm/Cargo.toml"]),
  ),
  "lint (Rust)": holds(() =>
    cargo("clippy", "--release", "--all-targets", "--locked", "--quiet", "--", "-D", "warnings"),
  ),
  "tests (Rust)": rust,
  "tests (TypeScript)": () => vitest(["unit", "architecture", "numerics", "faults", "interop", "install"]),
};

const total = { passed: 0, failed: 0, skipped: 0 };

/** Adds up what a check came to. */
function count(counts) {
  for (const key of Object.keys(total)) total[key] += counts[key];
}

/**
 * Tests in the browser, which wait for a picture more often than not: beside all else they take what it leaves of the
 * processor. What they say is shown at their end.
 */
async function browser() {
  const counts = await vitest(["browser"], { held: true });
  console.log(`\n── tests (TypeScript, in the browser)\n${counts.output}`);
  count(counts);
}

/** All other checks, one after the other. */
async function others() {
  for (const [name, check] of Object.entries(checks)) {
    console.log(`\n── ${name}`);
    count(await check());
  }
}

mkdirSync(join(root, "tests/artifacts"), { recursive: true });
await setup(forTest);
const rooms = process.argv.slice(2);
if (rooms.length > 0) count(await vitest(rooms));
else await Promise.all([browser(), others()]);
console.log(`\n${total.passed} passed, ${total.failed} failed, ${total.skipped} skipped`);
process.exitCode = total.failed === 0 && total.passed > 0 ? 0 : 1;
