import { type AreaOfUse, CrsError } from "@groma/georef";
import { withCurrentNames } from "./grids/current-names.js";
import type { Proj } from "./program/find.js";
import { failed, run } from "./program/run.js";
import { type CrsText, withArgument } from "./source.js";

/** An operation that PROJ proposes. */
export interface Operation {
  /** The steps' names, joined by PROJ with " + ". */
  readonly name: string;
  /** Metres as published; `null` when nobody has stated it. */
  readonly accuracy: number | null;
  /** Where it is meant for, in words. */
  readonly area: string;
  /** It passes over a difference of datums that it knows nothing about. */
  readonly ballpark: boolean;
  /** Without those that its CRS calls optional (`@name`). */
  readonly missingGrids: readonly string[];
  /** Absent when PROJ cannot write it as a pipeline. */
  readonly pipeline?: string;
}

/** Degrees. `west` exceeds `east` where the antimeridian lies between. */
export interface DegreeBox {
  readonly west: number;
  readonly south: number;
  readonly east: number;
  readonly north: number;
}

/** Which operations are listed. */
export interface ListOptions {
  /** Where the data are; operations for elsewhere are left out. */
  readonly box?: DegreeBox | undefined;
  /** Only operations that go to the target without another CRS between: quick, for a first look. */
  readonly direct?: boolean;
  readonly signal?: AbortSignal | undefined;
}

/** EPSG:4978, WGS 84 geocentric: what every transformation here ends in. */
const TARGET = "EPSG:4978";
/** Accuracy as `projinfo` writes it: `, 1.5 m, ` or `, unknown accuracy, `. */
const ACCURACY = /, (?:(\d+(?:\.\d+)?(?:e[-+]?\d+)?) m|unknown accuracy), /i;

/**
 * What PROJ proposes for the way from a CRS to EPSG:4978, the best first, as it would choose for the area. From a CRS
 * without heights it goes by `push v_3` and `pop v_3`: z passes for a height above the WGS 84 ellipsoid unchanged.
 *
 * @throws CrsError CRS_UNKNOWN when PROJ does not know the CRS
 * @throws ProjError PROJ_FAILED
 */
export async function listOperations(
  proj: Proj,
  source: CrsText,
  options: ListOptions = {},
): Promise<Operation[]> {
  const operations = readOperations(await ask(proj, source, "PROJ", options));
  if (!operations) throw failed(proj.projinfo, "its list of operations cannot be read");
  return Promise.all(operations.map((operation) => withCurrentNames(operation, proj.directories)));
}

/** The answer of `projinfo` for a way from a CRS. */
async function ask(
  proj: Proj,
  source: CrsText,
  notation: "PROJ" | "PROJJSON",
  { box, direct, signal }: ListOptions,
): Promise<string> {
  const area = box ? ["--bbox", [box.west, box.south, box.east, box.north].map(decimal).join(",")] : [];
  return withArgument(source, async (argument) => {
    const outcome = await run(
      proj.projinfo,
      [
        ...["-s", argument, "-t", TARGET],
        ...["--spatial-test", "intersects", ...area],
        ...(direct ? ["--pivot-crs", "never"] : []),
        ...["-o", notation, "--single-line"],
      ],
      { environment: proj.environment, signal },
    );
    if (outcome.status !== 0) throw unknownCrs(source, outcome.stderr);
    return outcome.stdout;
  });
}

/**
 * The rectangles around the areas of use of the operations that {@link listOperations} lists, in the same order: names do not
 * tell them apart. Undefined of those that PROJ cannot write as PROJJSON.
 *
 * @throws CrsError CRS_UNKNOWN; ProjError PROJ_FAILED
 */
export async function operationAreas(
  proj: Proj,
  source: CrsText,
  options: ListOptions,
): Promise<(AreaOfUse | undefined)[]> {
  return readAreas(await ask(proj, source, "PROJJSON", options));
}

/** Reads the answer of `projinfo -s … -t … -o PROJJSON --single-line`. */
export function readAreas(text: string): (AreaOfUse | undefined)[] {
  return sectionsOf(text).map((section) => {
    const line = section.split("\n").find((one) => one.startsWith("{"));
    const { bbox } = line === undefined ? {} : parsed(line);
    if (!bbox) return undefined;
    const { west_longitude: west, south_latitude: south, east_longitude: east, north_latitude: north } = bbox;
    const area: AreaOfUse = [west, south, east, north];
    return area.every(Number.isFinite) ? area : undefined;
  });
}

/** The parts of an answer of `projinfo`, one for each operation. */
function sectionsOf(text: string): string[] {
  return text.split(/^Operation No\. \d+:\s*$/m).slice(1);
}

/** The area of use of PROJJSON, degrees. */
type Box = Readonly<
  Record<"west_longitude" | "south_latitude" | "east_longitude" | "north_latitude", number>
>;

/** What is read here of an operation in PROJJSON; nothing of a line that is none. */
function parsed(line: string): { readonly bbox?: Box } {
  try {
    return JSON.parse(line);
  } catch {
    return {};
  }
}

/** Reads the answer of `projinfo -s … -t … -o PROJ --single-line`; nothing when it is no such answer. */
export function readOperations(text: string): Operation[] | undefined {
  const count = /^Candidate operations found: (\d+)/m.exec(text);
  if (!count) return undefined;
  const operations = sectionsOf(text)
    .map(readOperation)
    .filter((operation) => operation !== undefined);
  return operations.length === Number(count[1]) ? operations : undefined;
}

function readOperation(text: string): Operation | undefined {
  const lines = text.split(/\r?\n/).map((line) => line.trim());
  const summary = lines.find((line) => line !== "") ?? "";
  const accuracy = ACCURACY.exec(summary);
  const name = /^(?:unknown id|[^,]+:[^,]+), /.exec(summary);
  if (!accuracy || !name || name[0].length > accuracy.index) return undefined;
  const rest = summary.slice(accuracy.index + accuracy[0].length);
  const marks = /(?:, (?:at least one grid missing|has ballpark transformation|time-dependent operation))*$/;
  const pipeline = lines[lines.indexOf("PROJ string:") + 1];
  const missing = lines.map((line) => /^Grid ([^@\s]\S*) needed but not found/.exec(line)?.[1]);
  return {
    name: summary.slice(name[0].length, accuracy.index),
    accuracy: accuracy[1] === undefined ? null : Number(accuracy[1]),
    area: rest.replace(marks, ""),
    ballpark: rest.includes(", has ballpark transformation"),
    missingGrids: missing.filter((grid) => grid !== undefined),
    ...(pipeline?.startsWith("+proj=") ? { pipeline } : {}),
  };
}

function decimal(degrees: number): string {
  return degrees.toFixed(6);
}

function unknownCrs(source: CrsText, stderr: string): CrsError {
  const said = stderr.trim().split("\n")[0].replace(/\.$/, "").slice(0, 200);
  return new CrsError({
    code: "CRS_UNKNOWN",
    file: source.name,
    cause: `PROJ does not understand this coordinate reference system${said === "" ? "" : ` (${said})`}`,
    fix: "name it with --crs, as an EPSG code or as WKT",
  });
}
