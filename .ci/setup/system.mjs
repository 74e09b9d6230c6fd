import { existsSync, readFileSync } from "node:fs";
import { available, command, SetupError } from "./command.mjs";

/** Debian or a child of it, and the right to install: only then does the set-up call apt. */
function canInstall() {
  if (process.getuid?.() !== 0 || !existsSync("/etc/os-release")) return false;
  return /^ID(_LIKE)?=.*(debian|ubuntu)/m.test(readFileSync("/etc/os-release", "utf8"));
}

/**
 * Makes sure that programs of the operating system are there: as root on Debian by apt, else by one line that
 * says what to install.
 *
 * @param {{ program: string, args?: string[], package: string }[]} needs
 * @param {string} root the project's folder
 */
export async function ensurePrograms(needs, root) {
  const missing = [];
  for (const need of needs) {
    if (!(await available(need.program, need.args))) missing.push(need);
  }
  if (missing.length === 0) return "there";
  const packages = missing.map((need) => need.package);
  const advice = `Install ${packages.join(" and ")} (Debian: apt-get install ${packages.join(" ")}).`;
  if (!canInstall()) {
    throw new SetupError(`${missing.map((need) => need.program).join(", ")}: not found. ${advice}`);
  }
  const env = { DEBIAN_FRONTEND: "noninteractive" };
  await command("apt-get", ["update", "-qq"], { cwd: root, advice, env });
  await command("apt-get", ["install", "-y", "-qq", "--no-install-recommends", ...packages], {
    cwd: root,
    advice,
    env,
  });
  return `installed ${packages.join(", ")}`;
}
