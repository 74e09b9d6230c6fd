import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { projectRoot } from "../project.js";
import { openRegistry } from "./registry.js";

/** PROJ as `converter/scripts/build-proj` builds it; a package of the core is made without it where it was not built. */
export const builtProj = join(projectRoot, ".groma/proj");
export const projMissing = existsSync(join(builtProj, "share/proj/proj.db"))
  ? undefined
  : "PROJ is not built: converter/scripts/build-proj .groma/proj";

/** A tarball that was packed. */
export interface Packed {
  readonly path: string;
  readonly files: readonly string[];
  readonly description: {
    readonly name: string;
    readonly version: string;
    readonly dependencies?: Readonly<Record<string, string>>;
    readonly optionalDependencies?: Readonly<Record<string, string>>;
    readonly exports?: Readonly<Record<string, unknown>>;
  };
  /** The text of a file of it. */
  read(file: string): string;
}

/** Packs all packages of the project. */
export function pack(out: string): Map<string, Packed> {
  const script = join(projectRoot, ".ci/pack/main.mjs");
  const told = execFileSync(process.execPath, [script, "--out", out], {
    ...{ encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] },
  });
  const packed = new Map<string, Packed>();
  for (const line of told.trim().split("\n")) {
    const path = /\S+\.tgz$/.exec(line)![0];
    const tar = (...args: string[]) => execFileSync("tar", args, { encoding: "utf8", maxBuffer: 1 << 28 });
    const read = (file: string) => tar("-xzOf", path, `package/${file}`);
    const files = tar("-tzf", path)
      .trim()
      .split("\n")
      .map((name) => name.replace(/^package\//, ""));
    const description = JSON.parse(read("package.json")) as Packed["description"];
    packed.set(description.name, { path, files, description, read });
  }
  return packed;
}

/** A folder with nothing but what npm installed from tarballs, far from the project, and the surroundings to run in. */
export interface Installation {
  readonly folder: string;
  readonly environment: NodeJS.ProcessEnv;
  /** Packages that npm asked for and did not get. */
  readonly missing: readonly string[];
  remove(): void;
}

/** Runs `npm install` of the packages named in an empty folder, with no other registry than the tarballs. */
export async function install(
  packed: ReadonlyMap<string, Packed>,
  names: readonly string[],
): Promise<Installation> {
  const base = mkdtempSync(join(tmpdir(), "groma-install-"));
  const folder = join(base, "somewhere");
  mkdirSync(folder);
  writeFileSync(join(folder, "package.json"), '{ "name": "somewhere", "private": true, "type": "module" }\n');
  const environment: NodeJS.ProcessEnv = {
    HOME: base,
    XDG_CACHE_HOME: join(base, "cache"),
    // npm and its shell, no compiler and no PROJ of the system that would be current.
    PATH: [dirname(process.execPath), "/usr/bin", "/bin"].join(":"),
  };
  const registry = await openRegistry(packed);
  try {
    const flags = [
      "--no-audit",
      "--no-fund",
      "--no-update-notifier",
      "--loglevel=error",
      `--cache=${join(base, "npm")}`,
    ];
    const child = spawn("npm", ["install", `--registry=${registry.address}`, ...flags, ...names], {
      ...{ cwd: folder, env: environment, stdio: ["ignore", "pipe", "pipe"] },
    });
    let output = "";
    for (const stream of [child.stdout, child.stderr]) stream.on("data", (chunk) => (output += chunk));
    const code = await new Promise((resolve) => child.on("close", resolve));
    if (code !== 0) throw new Error(`npm install ended with ${code}:\n${output}`);
  } finally {
    registry.close();
  }
  rmSync(join(base, "npm"), { recursive: true, force: true });
  return {
    ...{ folder, environment, missing: [...registry.missing] },
    remove: () => rmSync(base, { recursive: true, force: true }),
  };
}
