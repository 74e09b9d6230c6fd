import { existsSync } from "node:fs";
import { join } from "node:path";
import { attempt, available, command, SetupError } from "./command.mjs";
import { digest, isDone, markDone } from "./stamp.mjs";
import { ensurePrograms } from "./system.mjs";

/**
 * @typedef {object} Step
 * @property {string} name
 * @property {Step[]} [after] steps that it needs, or that would hold up each other: cargo, and apt, do one thing at a time
 * @property {(root: string) => Promise<string>} run says in a word or two what it did
 */

const npm = (root, args, advice) => command("npm", args, { cwd: root, advice });

/** @type {Step} */
const node = {
  name: "Node.js",
  async run() {
    const [major, minor] = process.versions.node.split(".").map(Number);
    if (major < 20 || (major === 20 && minor < 19)) {
      throw new SetupError(`Node.js ${process.versions.node} is too old. Install Node.js 20.19 or newer.`);
    }
    return process.versions.node;
  },
};

/** @type {Step} */
const packages = {
  name: "npm packages",
  after: [node],
  async run(root) {
    const stamp = join(root, "node_modules/.groma-lock");
    const lock = digest(root, ["package-lock.json"]);
    if (isDone(stamp, lock)) return "up to date";
    await npm(
      root,
      ["ci", "--no-fund", "--no-audit", "--loglevel=error"],
      "Check the connection to the npm registry.",
    );
    markDone(stamp, lock);
    return "installed";
  },
};

/** @type {Step} */
const core = {
  name: "converter core (Rust)",
  async run(root) {
    if (!(await available("cargo"))) {
      throw new SetupError("cargo was not found. Install a Rust toolchain (rustup).");
    }
    const args = ["build", "--release", "--locked", "--quiet", "--manifest-path", "converter/Cargo.toml"];
    await command("cargo", args, {
      cwd: root,
      advice: "Check the Rust toolchain and the connection to crates.io.",
    });
    return "built";
  },
};

/** Builds a crate of the project as WebAssembly. */
async function buildWasm(root, crate, target) {
  const args = ["build", "--release", "--locked", "--quiet", "--target", target, "--manifest-path"];
  const build = () => attempt("cargo", [...args, join(root, crate, "Cargo.toml")]);
  let { code, said } = await build();
  // Rust of a system has no rustup, and may have the target all the same.
  if (code !== 0 && (await available("rustup"))) {
    await attempt("rustup", ["target", "add", target]);
    ({ code, said } = await build());
  }
  if (code !== 0)
    throw new SetupError(
      `Rust cannot build for ${target} (${said}). Run rustup target add ${target}, or install your system's package of it (libstd-rust-dev-wasm32).`,
    );
  return "built";
}

/** LAZ of the page and of the command, as WebAssembly. @type {Step} */
const laz = {
  name: "LAZ as WebAssembly",
  after: [core],
  run: (root) => buildWasm(root, "converter/wasm", "wasm32-unknown-unknown"),
};

/** The core for the page, which indexes scans in it. It needs files, and so a system: WASI. @type {Step} */
const pageCore = {
  name: "core as WebAssembly",
  after: [laz],
  run: (root) => buildWasm(root, "converter", "wasm32-wasip1"),
};

/** @type {Step} */
const typescript = {
  name: "libraries and page",
  after: [packages, laz, pageCore],
  async run(root) {
    const stamp = join(root, "demo/dist/.groma-built");
    const sources = digest(root, [
      "georef",
      "layer",
      "converter/cli",
      "converter/src",
      "converter/Cargo.lock",
      "converter/wasm/src",
      "converter/wasm/Cargo.lock",
      "demo",
      "package-lock.json",
      "tsconfig.base.json",
    ]);
    const libraries = ["georef/dist/index.js", "layer/dist/index.js", "converter/dist/main.js"];
    if (isDone(stamp, sources) && libraries.every((file) => existsSync(join(root, file))))
      return "up to date";
    await npm(root, ["run", "build"], "Look at the compiler's message above.");
    markDone(stamp, sources);
    return "built";
  },
};

/**
 * The best engine for the places of points, but not one that conversion cannot do without. A PROJ of the system that is
 * older than the one that the script gives is taken only where that one cannot be had. @type {Step}
 */
const proj = {
  name: "PROJ",
  async run(root) {
    const { code, said } = await script(root, "install-proj");
    if (code === 0) return said;
    const need = { program: "projinfo", args: ["EPSG:4326"], package: "proj-bin" };
    try {
      return `${await ensurePrograms([need], root)}; a current one: ${said}`;
    } catch (error) {
      if (!(error instanceof SetupError)) throw error;
      return `not there, proj4js and EGM96 do its work less exactly (${said})`;
    }
  },
};

/** Runs a script of the converter that brings a program. */
async function script(root, name) {
  const shell = process.platform === "win32" ? "bash" : "sh";
  const { code, said } = await attempt(shell, [join(root, "converter/scripts", name)]);
  return { code, said: said.replace(`${name}: `, "") };
}

/** @type {Step} */
const browser = {
  name: "Chromium",
  after: [proj],
  run: (root) => ensurePrograms([{ program: "chromium", args: ["--version"], package: "chromium" }], root),
};

/** @type {Step} */
const referees = {
  name: "Python referees",
  after: [browser],
  async run(root) {
    await ensurePrograms(
      [{ program: "python3", args: ["-c", "import venv, ensurepip"], package: "python3-venv" }],
      root,
    );
    const stamp = join(root, "tests/.venv/.groma-requirements");
    const requirements = digest(root, ["tests/requirements.txt"]);
    if (isDone(stamp, requirements)) return "up to date";
    const advice = "Check Python 3 and the connection to PyPI.";
    await command("python3", ["-m", "venv", "--clear", "tests/.venv"], { cwd: root, advice });
    const pip = [
      "-m",
      "pip",
      "install",
      "--quiet",
      "--disable-pip-version-check",
      "-r",
      "tests/requirements.txt",
    ];
    await command(join(root, "tests/.venv/bin/python"), pip, { cwd: root, advice });
    markDone(stamp, requirements);
    return "installed";
  },
};

/** Reads formats other than LAS; its tests say that they skip where it cannot be had. @type {Step} */
const pdal = {
  name: "PDAL",
  after: [referees],
  async run(root) {
    const { code, said } = await script(root, "install-pdal");
    return code === 0 ? said : `not there (${said})`;
  },
};

/** What `npm start` needs: the libraries, the converter, the page, and PROJ where it can be had. */
export const forStart = [node, packages, core, laz, pageCore, typescript, proj];

/** What `npm test` needs besides: a browser, and readers of LAS and COPC that nobody here wrote. */
export const forTest = [...forStart, browser, referees, pdal];
