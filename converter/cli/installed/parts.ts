// What is installed beside the command: the core and PROJ for this platform, and the page. In a clone they lie where they
// are built; an installation has the page in its own package, and the rest in one for the platform.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

/** The folder of the package `@groma/converter`. */
const own = fileURLToPath(new URL("../..", import.meta.url));

/** This platform as the packages of the core are called: `linux-x64-gnu`, `darwin-arm64`, `win32-x64-msvc`. */
export const platform = platformName(process.platform, process.arch, process.report);

/**
 * @param report where the C library is told: on Linux a program runs with the one that it was built for only
 */
export function platformName(
  system: string,
  processor: string,
  report: { getReport(): object } | undefined,
): string {
  if (system === "win32") return `${system}-${processor}-msvc`;
  if (system !== "linux") return `${system}-${processor}`;
  const { header } = (report?.getReport() ?? {}) as { header?: { glibcVersionRuntime?: string } };
  return `${system}-${processor}-${header?.glibcVersionRuntime === undefined ? "musl" : "gnu"}`;
}

/** The folder of the package of this platform; nothing where there is none, as in a clone. */
const platformPackage = (() => {
  try {
    return dirname(createRequire(import.meta.url).resolve(`@groma/core-${platform}/package.json`));
  } catch {
    return undefined;
  }
})();

/** Whether the command runs where it is developed. */
export const isClone = existsSync(join(own, "Cargo.toml"));

/** The core for this platform, whether it is there or not. */
export const installedCore = join(
  platformPackage ?? join(own, "target/release"),
  `groma-core${process.platform === "win32" ? ".exe" : ""}`,
);

/** The folder of PROJ, with its `bin` and its `share/proj`; nothing where none came with the package of the platform. */
export const installedProj =
  platformPackage !== undefined && existsSync(join(platformPackage, "proj/share/proj/proj.db"))
    ? join(platformPackage, "proj")
    : undefined;

/** The folder of the built page, whether it is there or not. */
export const installedPage = isClone ? join(own, "../demo/dist") : join(own, "page");
