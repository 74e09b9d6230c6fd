import { createHash } from "node:crypto";
import { existsSync, mkdirSync, statSync } from "node:fs";
import { homedir } from "node:os";
import { basename, join, parse, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { coreProgram, type Scan, scanFile } from "../core.js";
import { crsInWords, heightInWords } from "../describe.js";
import { type Given, georeference } from "../georeference.js";
import { count } from "../output.js";
import type { ProgressKind } from "../progress.js";
import { mountFile, ServerError, serve } from "../server.js";
import { convert } from "./convert.js";
import type { ServeOptions } from "./serve.js";

export interface ViewOptions extends Given, ServeOptions {
  readonly progress?: ProgressKind;
}

/** The built page; served as files, not imported. */
const page = fileURLToPath(new URL("../../../demo/dist", import.meta.url));

/**
 * The `view` command: converts the file if it is no COPC, serves it with the page, prints the address and goes on
 * serving until the process is stopped.
 *
 * @throws CrsError, CoreError, ServerError
 */
export async function runView(file: string, options: ViewOptions): Promise<void> {
  const scan = await scanFile(file);
  if (!existsSync(join(page, "index.html"))) {
    throw new ServerError({
      ...{ code: "SERVER_PAGE", file: page, cause: "the page is not built" },
      fix: "run npm run setup",
    });
  }
  const { crs } = georeference(scan, options);
  const title = `${basename(file)}  ${count(scan.points)} points  ${crsInWords(crs)}  height: ${heightInWords(crs)}`;
  process.stdout.write(`${title}\n`);
  const copc = isReady(scan, options) ? resolve(file) : await cached(file, options);
  const { address } = await serve([mountFile("/data/", copc), { path: "/", folder: page }], options);
  process.stdout.write(`globe    ${address}?cloud=${encodeURIComponent(`/data/${basename(copc)}`)}\n`);
}

/** A COPC is shown as it is, unless the user says something else of its coordinates. */
function isReady(scan: Scan, { crs, vertical }: Given): boolean {
  return scan.copc && crs === undefined && vertical === undefined;
}

/** The converted form of a scan in the user's cache; made again when the scan, its CRS or the converter has changed. */
async function cached(file: string, options: ViewOptions): Promise<string> {
  const { size, mtimeMs } = statSync(file);
  const identity = [
    resolve(file),
    size,
    mtimeMs,
    options.crs,
    options.vertical,
    statSync(coreProgram).mtimeMs,
  ];
  const digest = createHash("sha256").update(JSON.stringify(identity)).digest("hex").slice(0, 12);
  const folder = join(process.env.XDG_CACHE_HOME || join(homedir(), ".cache"), "groma", digest);
  const copc = join(folder, `${parse(file).name}.copc.laz`);
  if (existsSync(copc)) return copc;
  mkdirSync(folder, { recursive: true });
  const { seconds } = await convert([file], copc, { ...options, overwrite: true });
  process.stdout.write(`convert  ${copc}  ${seconds.toFixed(1)} s\n`);
  return copc;
}
