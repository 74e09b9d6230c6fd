// Notices of third parties, from the lockfiles and the licences that lie in what is installed.
import { execFileSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";

/** @typedef {{ name: string, version: string, license: string, texts: string[], purl: string }} Notice */

const LICENCE_FILE = /^(licen[cs]e|copying|notice|unlicense|copyright)([.-].*)?$/i;
/** A package may be a folder of this size of licences; more is something else. */
const LONGEST = 400_000;

/** Texts of the licence files of a folder, in order of their names. */
function licenceTexts(folder) {
  return readdirSync(folder, { withFileTypes: true })
    .filter((entry) => entry.isFile() && LICENCE_FILE.test(entry.name))
    .map((entry) => readFileSync(join(folder, entry.name), "utf8").replaceAll("\r\n", "\n").trim())
    .filter((text) => text.length > 0 && text.length < LONGEST)
    .sort();
}

/** Where Node finds a package from another one, as the lockfile has it; nothing where it is not installed. */
function resolveInLock(packages, from, name) {
  for (
    let folder = from;
    ;
    folder = folder.includes("/node_modules/")
      ? folder.replace(/\/node_modules\/(?!.*\/node_modules\/).*$/, "")
      : ""
  ) {
    const place = folder === "" ? `node_modules/${name}` : `${folder}/node_modules/${name}`;
    if (packages[place]) return place;
    if (folder === "") return undefined;
  }
}

/**
 * Every package that the ones named need to run, whoever of them needs it; the project's own are walked through and left
 * out.
 *
 * @param {string} root the project's folder
 * @param {{ workspaces?: string[], packages?: string[] }} from packages of the project, and others by name
 * @returns {Notice[]} in order of names
 */
export function npmNotices(root, { workspaces = [], packages: named = [] }) {
  const { packages } = JSON.parse(readFileSync(join(root, "package-lock.json"), "utf8"));
  /** @type {Map<string, Notice>} */
  const found = new Map();
  const visit = (place) => {
    const entry = packages[place];
    if (entry.link) return visit(entry.resolved);
    if (found.has(place)) return;
    const own = !place.includes("node_modules/");
    const folder = join(root, place);
    if (!own && !existsSync(folder)) return;
    const description = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const { name, version } = description;
    const license = entry.license ?? description.license ?? "";
    const purl = `pkg:npm/${name.replace("@", "%40")}@${version}`;
    found.set(place, own ? undefined : { name, version, license, texts: licenceTexts(folder), purl });
    for (const other of Object.keys({ ...entry.dependencies, ...entry.optionalDependencies })) {
      const target = resolveInLock(packages, place, other);
      if (target) visit(target);
      else if (entry.dependencies?.[other])
        throw new Error(`${other}, which ${name} needs, is not in the lockfile`);
    }
  };
  for (const workspace of workspaces) visit(workspace);
  for (const name of named) visit(`node_modules/${name}`);
  return inOrder([...found.values()].filter(Boolean));
}

/**
 * Every crate that is built into the core, or into another crate of the project, by Cargo's lockfile.
 *
 * @param {string} root the project's folder
 * @param {{ crate?: string, platform?: string }} of folder of the crate, and for what it is built; default: this machine
 * @returns {Notice[]} in order of names
 */
export function cargoNotices(root, { crate = "converter", platform } = {}) {
  const host = /^host: (.*)$/m.exec(execFileSync("rustc", ["-vV"], { encoding: "utf8" }))[1];
  const args = ["metadata", "--locked", "--format-version", "1", "--filter-platform", platform ?? host];
  const { packages, resolve } = JSON.parse(
    execFileSync("cargo", [...args, "--manifest-path", join(root, crate, "Cargo.toml")], {
      encoding: "utf8",
      maxBuffer: 1 << 28,
    }),
  );
  const nodes = new Map(resolve.nodes.map((node) => [node.id, node]));
  const built = new Set();
  const visit = (id) => {
    if (built.has(id)) return;
    built.add(id);
    for (const { pkg, dep_kinds } of nodes.get(id).deps) {
      if (dep_kinds.some(({ kind }) => kind === null)) visit(pkg);
    }
  };
  visit(resolve.root);
  built.delete(resolve.root);
  return inOrder(
    packages
      .filter(({ id }) => built.has(id))
      .map(({ name, version, license, manifest_path }) => ({
        ...{ name, version, license: license ?? "", texts: licenceTexts(dirname(manifest_path)) },
        purl: `pkg:cargo/${name}@${version}`,
      })),
  );
}

/**
 * Every crate in the WebAssembly of the page: LAZ, and the core that indexes scans.
 *
 * @param {string} root the project's folder
 * @returns {Notice[]} in order of names, each once
 */
export function pageCargoNotices(root) {
  const all = [
    ...cargoNotices(root, { crate: "converter/wasm", platform: "wasm32-unknown-unknown" }),
    ...cargoNotices(root, { crate: "converter", platform: "wasm32-wasip1" }),
  ];
  return inOrder([...new Map(all.map((notice) => [notice.purl, notice])).values()]);
}

/**
 * What is linked into the PROJ of `converter/scripts/build-proj`.
 *
 * @param {string} folder that it was built into
 * @returns {Notice[]}
 */
export function projNotices(folder) {
  const read = (name) => [readFileSync(join(folder, "licences", name), "utf8").trim()];
  const versions = JSON.parse(readFileSync(join(folder, "licences/versions.json"), "utf8"));
  const one = (name, license, texts) => {
    const version = versions[name];
    return { name, version, license, texts, purl: `pkg:generic/${name.toLowerCase()}@${version}` };
  };
  return [
    one("PROJ", "MIT", read("PROJ")),
    one("SQLite", "blessing", ["SQLite is in the public domain: https://www.sqlite.org/copyright.html"]),
    one("libtiff", "libtiff", read("libtiff")),
    one("zlib", "Zlib", read("zlib")),
  ];
}

function inOrder(notices) {
  return notices.sort((a, b) => (a.purl < b.purl ? -1 : 1));
}

const DATA = `EPSG Geodetic Parameter Dataset: tables of coordinate reference systems are made from it. It is owned by the
International Association of Oil & Gas Producers (IOGP) and is used under its terms of use, https://epsg.org/terms-of-use.html.

EGM96: the geoid model is a product of the United States government (NGA, NASA) and in the public domain.`;

/**
 * The notices as a text.
 *
 * @param {string} what that they belong to
 * @param {Notice[]} notices
 */
export function noticesText(what, notices) {
  const parts = notices.map(({ name, version, license, texts }) =>
    [`${name} ${version}`, `Licence: ${license || "see below"}`, ...texts.map((text) => `\n${text}`)].join(
      "\n",
    ),
  );
  const rule = `\n\n${"-".repeat(80)}\n\n`;
  const head = `Third-party notices of ${what}\n\nWhat it contains of others, or needs to run, each with its licence.`;
  return `${[head, ...parts, DATA].join(rule)}\n`;
}
