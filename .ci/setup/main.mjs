// The set-up of `npm start` and `npm test`: plain Node, so that it runs before anything is installed.
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { SetupError } from "./command.mjs";
import { forStart, forTest } from "./steps.mjs";

export const root = join(dirname(fileURLToPath(import.meta.url)), "../..");

/**
 * Runs the steps, each as soon as those that it comes after are done, with a line for each; what is done already is
 * skipped by the step itself. On failure it prints one line that says what is missing and ends the process with exit code 1.
 *
 * @param {import("./steps.mjs").Step[]} steps
 */
export async function setup(steps) {
  /** @type {Map<import("./steps.mjs").Step, Promise<void>>} */
  const begun = new Map();
  const running = new Set();
  let done = 0;
  const show = (line) => {
    if (!process.stdout.isTTY) return process.stdout.write(line);
    const names = [...running].map(({ name }) => name).join(", ");
    const now = names && `setup …     ${names}`.slice(0, (process.stdout.columns || 80) - 1);
    process.stdout.write(`\r\x1b[K${line}${now}`);
  };
  const runAfter = async (step) => {
    await Promise.all((step.after ?? []).map((before) => begun.get(before)));
    running.add(step);
    show("");
    const began = performance.now();
    try {
      const outcome = await step.run(root);
      running.delete(step);
      const seconds = ((performance.now() - began) / 1000).toFixed(1);
      const label = `setup ${++done}/${steps.length}`.padEnd(11);
      show(`${label} ${step.name.padEnd(22)} ${outcome} (${seconds} s)\n`);
    } catch (error) {
      if (!(error instanceof SetupError)) throw error;
      process.stderr.write(`${process.stdout.isTTY ? "\n" : ""}setup: ${step.name}: ${error.message}\n`);
      process.exit(1);
    }
  };
  // In their order each stands after those that it comes after.
  for (const step of steps) begun.set(step, runAfter(step));
  await Promise.all(begun.values());
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await setup(process.argv.includes("--test") ? forTest : forStart);
}
