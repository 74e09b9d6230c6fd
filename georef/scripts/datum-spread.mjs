/**
 * Writes src/crs/datum-spread.ts: what the one shift that Groma has for a datum is worth in the parts of its area, by the
 * operations that PROJ takes there. To be run when the table of datums changes, or with a newer database of PROJ:
 *
 *     npx tsc -b && node georef/scripts/datum-spread.mjs PROJ_DATA
 *
 * PROJ_DATA: the folder of PROJ's proj.db. Python with pyproj: that of the tests, or GROMA_PYTHON.
 */
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { DATUM_SHIFTS } from "../dist/crs/datum-table.js";

const root = join(import.meta.dirname, "../..");
const python = process.env.GROMA_PYTHON ?? join(root, "tests/.venv/bin/python");
const [folder] = process.argv.slice(2);
if (folder === undefined) throw new Error("name the folder of PROJ's proj.db");

const script = join(import.meta.dirname, "datum-spread.py");
const input = JSON.stringify(DATUM_SHIFTS);
const { version, spread } = JSON.parse(execFileSync(python, [script, folder], { input, encoding: "utf8" }));

const rows = Object.entries(spread).map(([code, parts]) => `  [${code}, ${JSON.stringify(parts)}],`);
const text = `/** West, south, east, north in degrees; metres. */
export type SpreadPart = readonly [west: number, south: number, east: number, north: number, metres: number];

/**
 * Datums (by EPSG code) whose one shift is farther from the operations for parts of their area than its own accuracy, and how
 * far it is there: the greatest distance from the operation that PROJ takes, and the accuracy that is published for that one.
 * ${version}; written by scripts/datum-spread.mjs.
 */
export const DATUM_SPREAD: ReadonlyMap<number, readonly SpreadPart[]> = new Map<number, readonly SpreadPart[]>([
${rows.join("\n")}
]);
`;
const target = join(root, "georef/src/crs/datum-spread.ts");
writeFileSync(target, text);
execFileSync("npx", ["biome", "format", "--write", target], { cwd: root, stdio: "inherit" });
