import { spawn } from "node:child_process";

/** What runs, and is not to run on where set-up is given up. */
const children = new Set();
process.on("exit", () => {
  for (const child of children) child.kill();
});

/** Starts a program, which ends with this process at the latest. */
function start(program, args, options) {
  const child = spawn(program, args, options);
  children.add(child);
  child.on("close", () => children.delete(child));
  return child;
}

/** A set-up step could not be done; the message is the one line that a person needs. */
export class SetupError extends Error {}

/**
 * Runs a program to its end, its output kept back and shown only on failure (set-up is quiet when it works).
 *
 * @param {string} program
 * @param {string[]} args
 * @param {{ cwd: string, advice: string, env?: Record<string, string> }} options advice: what to do on failure
 * @returns {Promise<string>} standard output
 * @throws {SetupError} when the program is missing or fails
 */
export function command(program, args, { cwd, advice, env = {} }) {
  return new Promise((resolve, reject) => {
    const child = start(program, args, {
      cwd,
      env: { ...process.env, ...env },
      stdio: ["ignore", "pipe", "pipe"],
      shell: process.platform === "win32",
    });
    let output = "";
    let errors = "";
    child.stdout.on("data", (chunk) => {
      output += chunk;
    });
    child.stderr.on("data", (chunk) => {
      errors += chunk;
    });
    child.on("error", () => reject(new SetupError(`${program} was not found. ${advice}`)));
    child.on("close", (code) => {
      if (code === 0) return resolve(output);
      process.stderr.write(`${output}${errors}`);
      reject(new SetupError(`${program} ${args.join(" ")} failed (exit ${code}). ${advice}`));
    });
  });
}

/** Whether a program can be started at all. */
export async function available(program, args = ["--version"]) {
  return new Promise((resolve) => {
    const child = start(program, args, { stdio: "ignore", shell: process.platform === "win32" });
    child.on("error", () => resolve(false));
    child.on("close", (code) => resolve(code === 0));
  });
}

/**
 * Runs a program that set-up can do without.
 *
 * @param {string} program
 * @param {string[]} args
 * @returns {Promise<{ code: number, said: string }>} its exit code and the last line of what it said on standard error
 */
export async function attempt(program, args) {
  return new Promise((resolve) => {
    const child = start(program, args, { stdio: ["ignore", "ignore", "pipe"] });
    let errors = "";
    child.stderr.on("data", (chunk) => {
      errors += chunk;
    });
    child.on("error", () => resolve({ code: 1, said: `${program} was not found` }));
    child.on("close", (code) => resolve({ code: code ?? 1, said: errors.trim().split("\n").at(-1) ?? "" }));
  });
}
