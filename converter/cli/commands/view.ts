import { createHash } from "node:crypto";
import { existsSync, mkdirSync, statSync } from "node:fs";
import { homedir } from "node:os";
import { basename, join, parse, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { coreProgram, type Scan, scanFile } from "../core.js";
import { crsInWords, heightInWords } from "../describe.js";
import { type Given, georeference } from "../georeference.js";
import { count } from "../output.js";
import { chosenProj, type EngineChoice } from "../place/engine.js";
import { placed } from "../placed.js";
import type { ProgressKind } from "../progress.js";
import { mountFile, ServerError, serve } from "../server.js";
import { convert, placeSummary } from "./convert.js";
import type { ServeOptions } from "./serve.js";

export interface ViewOptions extends Given, EngineChoice, ServeOptions {
  readonly progress?: ProgressKind;
}

/** The built page; served as files, not imported. */
const page = fileURLToPath(new URL("../../../demo/dist", import.meta.url));

/**
 * The `view` command: converts the file if it is no COPC, serves it with the page, prints the address and goes on
 * serving until the process is stopped.
 *
 * @throws CrsError, PlacementError, ProjError, CoreError, ServerError
 */
export async function runView(file: string, options: ViewOptions): Promise<void> {
  const scan = await scanFile(file);
  if (!existsSync(join(page, "index.html"))) {
    throw new ServerError({
      ...{ code: "SERVER_PAGE", file: page, cause: "the page is not built" },
      fix: "run npm run setup",
    });
  }
  const title = (name: string, height: string) =>
    `${basename(file)}  ${count(scan.points)} points  ${name}  height: ${height}\n`;
  let copc = resolve(file);
  if (isReady(scan, options)) {
    const { crs, geoids } = await placed(scan);
    process.stdout.write(title(crsInWords(crs), heightInWords(crs, geoids)));
  } else {
    const { crs } = await georeference(scan, options);
    process.stdout.write(title(crsInWords(crs), heightInWords(crs)));
    copc = await cached(file, options);
  }
  const { address } = await serve([mountFile("/data/", copc), { path: "/", folder: page }], options);
  process.stdout.write(`globe    ${address}?cloud=${encodeURIComponent(`/data/${basename(copc)}`)}\n`);
}

/** What the user says of coordinates and engine: it makes a conversion necessary, and another one when it changes. */
function wishes({ crs, vertical, anchor, anchorAt, control, engine, proj, grids }: ViewOptions) {
  return { crs, vertical, anchor, anchorAt, control, engine, proj, grids };
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
  const { control } = options;
  const proj = await chosenProj(options);
  const identity = [
    ...[file, coreProgram, ...(control === undefined || control === "-" ? [] : [control])].map(stateOf),
    wishes(options),
    proj && [proj.version, proj.directories.map(stateOf)],
  ];
  const digest = createHash("sha256").update(JSON.stringify(identity)).digest("hex").slice(0, 12);
  const folder = join(process.env.XDG_CACHE_HOME || join(homedir(), ".cache"), "groma", digest);
  const copc = join(folder, `${parse(file).name}.copc.laz`);
  if (existsSync(copc)) return copc;
  mkdirSync(folder, { recursive: true });
  const converted = await convert([file], copc, { ...options, overwrite: true });
  process.stdout.write(`convert  ${copc}  ${converted.seconds.toFixed(1)} s\n${placeSummary(converted)}`);
  return copc;
}

/** Path, size and time of change; a folder changes when a file is added to it. */
function stateOf(path: string): unknown {
  const found = statSync(path, { throwIfNoEntry: false });
  return [resolve(path), found?.size, found?.mtimeMs];
}
