// `npm start [-- scan.laz]`: all set-up, then a scan on the globe; without a scan, the generated sample.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdir } from "node:fs/promises";
import { join, resolve } from "node:path";
import { root, setup } from "../.ci/setup/main.mjs";
import { digest, isDone, markDone } from "../.ci/setup/stamp.mjs";
import { forStart } from "../.ci/setup/steps.mjs";

const groma = join(root, "converter/dist/main.js");

/** Runs a Node program with this terminal as its own; ends this process with its exit code if it fails. */
function node(program, args) {
  return new Promise((done) => {
    const child = spawn(process.execPath, [program, ...args], { stdio: "inherit" });
    for (const signal of ["SIGINT", "SIGTERM"]) process.on(signal, () => child.kill(signal));
    child.on("close", (code) => (code === 0 ? done() : process.exit(code ?? 1)));
  });
}

/** The sample scan, made once for each version of its generator. */
async function sample() {
  const folder = join(root, ".groma");
  const scan = join(folder, "sample.las");
  const stamp = join(folder, "sample.stamp");
  const generator = digest(root, ["demo/sample"]);
  if (!existsSync(scan) || !isDone(stamp, generator)) {
    console.log("sample   making a scan of two million points");
    await mkdir(folder, { recursive: true });
    await node(join(root, "demo/sample/dist/generate.js"), [scan]);
    markDone(stamp, generator);
  }
  return scan;
}

// npm's shell hands no SIGTERM on. Where the shell is gone, nobody is left who could stop the server.
const shell = process.ppid;
setInterval(() => {
  if (process.ppid !== shell) process.kill(process.pid, "SIGTERM");
}, 500).unref();

await setup(forStart);
const given = process.argv.slice(2);
const scans = given[0]?.startsWith("-") === false ? given.splice(0, 1) : [];
// npm runs scripts in the project's root; a path is meant from where the user stands.
const from = process.env.INIT_CWD ?? process.cwd();
const [scan = await sample()] = scans.map((path) => resolve(from, path));
await node(groma, ["view", scan, ...given]);
