// The set-up of `npm start` and `npm test`: plain Node, so that it runs before anything is installed.
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { SetupError } from "./command.mjs";
import { forStart, forTest } from "./steps.mjs";

export const root = join(dirname(fileURLToPath(import.meta.url)), "../..");

/**
 * Runs the steps in order, a line each; what is done already is skipped by the step itself.
 * On failure it prints one line that says what is missing and ends the process with exit code 1.
 */
export async function setup(steps) {
  for (const [index, step] of steps.entries()) {
    const label = `setup ${index + 1}/${steps.length}  ${step.name.padEnd(22)}`;
    if (process.stdout.isTTY) process.stdout.write(`${label} …`);
    const began = performance.now();
    try {
      const outcome = await step.run(root);
      const seconds = ((performance.now() - began) / 1000).toFixed(1);
      process.stdout.write(`${process.stdout.isTTY ? "\r" : ""}${label} ${outcome} (${seconds} s)\n`);
    } catch (error) {
      if (!(error instanceof SetupError)) throw error;
      process.stderr.write(`${process.stdout.isTTY ? "\n" : ""}setup: ${step.name}: ${error.message}\n`);
      process.exit(1);
    }
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await setup(process.argv.includes("--test") ? forTest : forStart);
}
