import { createHash } from "node:crypto";
import { existsSync, mkdirSync, statSync } from "node:fs";
import { homedir } from "node:os";
import { basename, join, parse, resolve } from "node:path";
import { convert } from "../conversion/convert.js";
import type { ConvertOptions } from "../conversion/options.js";
import { isLas } from "../conversion/sources.js";
import { placeSummary } from "../conversion/summary.js";
import { coreProgram, type Scan, scanFile } from "../core/core.js";
import { installedPage as page } from "../installed/parts.js";
import { crsInWords, heightInWords } from "../place/describe.js";
import { chosenProj } from "../place/engine.js";
import { georeference } from "../place/georeference.js";
import { placed } from "../place/placed.js";
import { mountFile, ServerError, type ServingOptions, serve } from "../server/server.js";
import { interruptible } from "../terminal/interruption.js";
import { count, print } from "../terminal/output.js";
import { createProgress, defaultProgress } from "../terminal/progress.js";

/** Of the options of a conversion, those that `view` takes too say how the file is read and where it is. */
export interface ViewOptions extends ConvertOptions, ServingOptions {}

/**
 * What the page may do: run scripts and workers of its own, none made of text; read scans and terrains from wherever it is
 * told to. Cesium and OpenLayers set styles from scripts.
 */
const PAGE_POLICY = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "worker-src 'self'",
  "style-src 'self' 'unsafe-inline'",
  "img-src 'self' data: blob:",
  "connect-src 'self' data: blob: http: https:",
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'self'",
].join("; ");

/**
 * The `view` command: converts the file if it is no COPC, serves it with the page, prints the address and goes on
 * serving until the process is stopped.
 *
 * @throws CrsError, PlacementError, ProjError, CoreError, PdalError, ServerError
 */
export async function runView(file: string, options: ViewOptions): Promise<void> {
  const scan = options.pipeline === undefined && (await isLas(file)) ? await scanFile(file) : undefined;
  if (!existsSync(join(page, "index.html"))) {
    throw new ServerError({
      ...{ code: "SERVER_PAGE", file: page, cause: "the page is not built" },
      fix: "run npm run setup",
    });
  }
  const ready = scan && isReady(scan, options);
  if (scan && !ready) {
    const { crs } = await georeference(scan, options);
    tell(file, scan, crsInWords(crs), heightInWords(crs));
  }
  const copc = ready ? resolve(file) : await cached(file, options);
  if (!scan || ready) {
    const shown = scan ?? (await scanFile(copc));
    const { crs, geoids } = await placed(shown);
    tell(file, shown, crsInWords(crs), heightInWords(crs, geoids));
  }
  const mounts = [mountFile("/data/", copc), { path: "/", folder: page, policy: PAGE_POLICY }];
  const { address } = await serve(mounts, options);
  print([`globe    ${address}?cloud=${encodeURIComponent(`/data/${basename(copc)}`)}`]);
}

function tell(file: string, { points }: Scan, name: string, height: string): void {
  print([`${basename(file)}  ${count(points)} points  ${name}  height: ${height}`]);
}

/** What the user says of reading, coordinates and engine: it makes a conversion necessary, and another when it changes. */
function wishes(options: ViewOptions) {
  const { crs, vertical, anchor, anchorAt, control, engine, proj, grids, pipeline, pdal, scale } = options;
  return { crs, vertical, anchor, anchorAt, control, engine, proj, grids, pipeline, pdal, scale };
}

/** A COPC is shown as it is, unless the user says something else of its coordinates or the way they are placed. */
function isReady(scan: Scan, options: ViewOptions): boolean {
  return scan.copc && Object.values(wishes(options)).every((wish) => wish === undefined);
}

/**
 * The converted form of a scan in the user's cache; made again when the scan, what is said of it, the converter, or PROJ
 * with its grids has changed.
 */
async function cached(file: string, options: ViewOptions): Promise<string> {
  const { control, pipeline } = options;
  const besides = [control, pipeline].filter((path) => path !== undefined && path !== "-");
  const proj = await chosenProj(options);
  const identity = [
    ...[file, coreProgram, ...besides].map((path) => stateOf(path!)),
    wishes(options),
    proj && [proj.version, proj.directories.map(stateOf)],
  ];
  const digest = createHash("sha256").update(JSON.stringify(identity)).digest("hex").slice(0, 12);
  const folder = join(process.env.XDG_CACHE_HOME || join(homedir(), ".cache"), "groma", digest);
  const copc = join(folder, `${parse(file).name}.copc.laz`);
  if (existsSync(copc)) return copc;
  mkdirSync(folder, { recursive: true });
  const progress = await createProgress(options.progress ?? defaultProgress());
  const converted = await interruptible((signal) =>
    convert([file], copc, { ...options, overwrite: true }, (event) => progress.show(event), signal),
  ).finally(() => progress.stop());
  print([`convert  ${copc}  ${converted.seconds.toFixed(1)} s`, ...placeSummary(converted)]);
  return copc;
}

/** Path, size and time of change; a folder changes when a file is added to it. */
function stateOf(path: string): unknown {
  const found = statSync(path, { throwIfNoEntry: false });
  return [resolve(path), found?.size, found?.mtimeMs];
}
