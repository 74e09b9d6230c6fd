/**
 * Writes src/crs/datum-areas.ts: the areas of use of the datums that Groma has a shift for. To be run when the table of datums
 * changes, or with a newer database of PROJ:
 *
 *     npx tsc -b && node georef/scripts/datum-areas.mjs PROJ_DATA
 *
 * PROJ_DATA: the folder of PROJ's proj.db. Python: that of the tests, or GROMA_PYTHON.
 */
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { DATUM_SHIFTS } from "../dist/crs/datum-table.js";

const root = join(import.meta.dirname, "../..");
const python = process.env.GROMA_PYTHON ?? join(root, "tests/.venv/bin/python");
const [folder] = process.argv.slice(2);
if (folder === undefined) throw new Error("name the folder of PROJ's proj.db");

const script = `
import json, sqlite3, sys
database = sqlite3.connect(sys.argv[1])
version = dict(database.execute("select key, value from metadata"))
query = """select west_lon, south_lat, east_lon, north_lat from usage join extent
  on extent.auth_name = extent_auth_name and extent.code = extent_code
  where object_table_name = 'geodetic_datum' and object_auth_name = 'EPSG' and object_code = ?"""
rows = [[code, area] for code in json.load(sys.stdin) for area in database.execute(query, (code,))]
print(json.dumps({"version": f"EPSG {version['EPSG.VERSION']}", "rows": rows}))
`;
const input = JSON.stringify(DATUM_SHIFTS.map(({ code }) => code));
const found = execFileSync(python, ["-c", script, join(folder, "proj.db")], { input, encoding: "utf8" });
const { version, rows } = JSON.parse(found);

const text = `import type { AreaOfUse } from "./area-of-use.js";

/**
 * The rectangles around the areas of use of the datums with a shift, by EPSG code. ${version}; written by
 * scripts/datum-areas.mjs.
 */
export const DATUM_AREAS: ReadonlyMap<number, AreaOfUse> = new Map<number, AreaOfUse>([
${rows.map(([code, area]) => `  [${code}, ${JSON.stringify(area)}],`).join("\n")}
]);
`;
const target = join(root, "georef/src/crs/datum-areas.ts");
writeFileSync(target, text);
execFileSync("npx", ["biome", "format", "--write", target], { cwd: root, stdio: "inherit" });
