import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import { createRequire } from "node:module";
import type { AddressInfo } from "node:net";
import { dirname, join } from "node:path";
import pixelmatch from "pixelmatch";
import type { Browser, Page } from "playwright-core";
import { PNG } from "pngjs";
import send from "send";
import { convert } from "../converted.js";
import { locked } from "../lock.js";
import { projectRoot } from "../project.js";
import { runPython } from "../python.js";
import { openPage, sharedBrowser, type Watch } from "./harness.js";

/** Pages of tests: a scene of the globe, a map, and both in step. */
const PAGES = ["stage", "map-stage", "link-stage"] as const;
type Which = (typeof PAGES)[number];

const builtFolder = (which: Which) => join(projectRoot, "tests/artifacts", which);
const rootFolder = (which: Which) => join(projectRoot, "tests/browser", which);
const clouds = join(projectRoot, "tests/artifacts/clouds");
const pictures = join(projectRoot, "tests/artifacts/pictures");
const expected = join(projectRoot, "tests/browser/expected");
const cesium = join(
  dirname(createRequire(import.meta.url).resolve("cesium/package.json")),
  "Build",
  "Cesium",
);

/** A page in a real browser with a small scene that draws when it is told to. */
export interface StagePage {
  readonly page: Page;
  readonly browser: Browser;
  readonly watch: Watch;
  close(): Promise<void>;
}

/** Writes the scans of `stage/clouds.py` as COPC where they are not there yet. */
function makeClouds(): void {
  const script = join(rootFolder("stage"), "clouds.py");
  const done = join(clouds, "cliff.copc.laz");
  if (existsSync(done) && statSync(done).mtimeMs > statSync(script).mtimeMs) return;
  mkdirSync(clouds, { recursive: true });
  const paths = runPython<Record<string, string>>("browser/stage/clouds.py", [clouds]);
  for (const path of Object.values(paths)) {
    // Regular samples of regular scans: what is drawn of them can be told beforehand, whatever the default becomes.
    const options = ["--vertical", "ellipsoidal", "--sampling", "grid"];
    convert(path, path.replace(/\.las$/, ".copc.laz"), options);
  }
}

/** A scan of `stage/clouds.py` as COPC. */
export function cloudPath(name: string): string {
  return join(clouds, `${name}.copc.laz`);
}

/** Builds the page where anything that it is made of is newer than it. */
async function buildPage(which: Which): Promise<void> {
  const root = rootFolder(which);
  const built = builtFolder(which);
  const page = join(built, "index.html");
  // A page may be made of parts of another one.
  const sources = [
    ...PAGES.map(rootFolder),
    join(projectRoot, "layer/dist"),
    join(projectRoot, "georef/dist"),
  ];
  if (existsSync(page) && statSync(page).mtimeMs > Math.max(...sources.map(newest))) return;
  const { build } = await import("vite");
  await build({
    root,
    base: "./",
    logLevel: "error",
    configFile: false,
    worker: { format: "es" },
    build: {
      outDir: built,
      emptyOutDir: true,
      target: "es2022",
      minify: false,
      // Cesium is served as it was built by its makers.
      rollupOptions: { external: ["cesium"] },
    },
  });
}

/** Time at which something in a folder changed last, milliseconds. */
function newest(folder: string): number {
  const entries = readdirSync(folder, { recursive: true, withFileTypes: true });
  return Math.max(...entries.map(({ parentPath, name }) => statSync(join(parentPath, name)).mtimeMs));
}

/**
 * Opens a page.
 * @param further folders that it is served, by the beginning of their addresses
 */
export async function openStage(
  which: Which = "stage",
  further: Readonly<Record<string, string>> = {},
): Promise<StagePage> {
  await locked(`${clouds}.lock`, makeClouds);
  await locked(`${builtFolder(which)}.lock`, () => buildPage(which));
  const server = await serve(which, further);
  const browser = await sharedBrowser();
  const { page, watch } = await openPage(browser, { width: 820, height: 640 });
  await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/index.html`);
  await page.waitForSelector("body[data-ready]", { state: "attached", timeout: 60_000 });
  return {
    page,
    browser,
    watch,
    close: async () => {
      await browser.close();
      server.close();
    },
  };
}

function serve(which: Which, further: Readonly<Record<string, string>>): Promise<Server> {
  const folders: readonly (readonly [string, string])[] = [
    ...Object.entries(further),
    ["/cesium/", cesium],
    ["/clouds/", clouds],
    ["/", builtFolder(which)],
  ];
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? "/", "http://localhost");
    const [prefix, folder] = folders.find(([start]) => pathname.startsWith(start))!;
    send(request, pathname.slice(prefix.length - 1), { root: folder }).pipe(response);
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

/** A picture from the address that the page gives it. */
export function decode(address: string, name: string): PNG {
  const bytes = Buffer.from(address.slice(address.indexOf(",") + 1), "base64");
  mkdirSync(pictures, { recursive: true });
  writeFileSync(join(pictures, `${name}.png`), bytes);
  return PNG.sync.read(bytes);
}

/** Share of pixels in which two pictures differ. */
export function difference(a: PNG, b: PNG, threshold = 0.1): number {
  const options = { threshold, includeAA: true };
  return pixelmatch(a.data, b.data, undefined, a.width, a.height, options) / (a.width * a.height);
}

/**
 * Share of pixels in which a picture differs from the one that is expected. `GROMA_ACCEPT=1` takes the picture for the
 * expected one, to be looked at before it is kept.
 */
export function differenceToExpected(picture: PNG, name: string): number {
  const path = join(expected, `${name}.png`);
  if (process.env.GROMA_ACCEPT === "1") {
    mkdirSync(expected, { recursive: true });
    writeFileSync(path, PNG.sync.write(picture, { deflateLevel: 9 }));
  }
  return difference(picture, PNG.sync.read(readFileSync(path)));
}
