import { existsSync } from "node:fs";
import { join } from "node:path";
import { GromaError, pointTransform, statedAccuracy, truthOf } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { georeference } from "../../converter/cli/place/georeference.js";
import { makeRecords } from "../../converter/cli/place/records.js";
import { proj, projMissing } from "../proj.js";
import { pythonMissing, runPython } from "../python.js";
import { distance } from "./groma.js";

type Point = readonly [number, number, number];

/** As `spellings.py` prints it. */
interface Spelling {
  readonly system: string;
  readonly spelling: string;
  readonly text: string;
  readonly points: readonly Point[];
  /** Null where PROJ has no way to WGS 84. */
  readonly ecef: readonly Point[] | null;
}

const given = process.env.GROMA_SEED;
const SEED = given === "random" ? Date.now() % 1e6 : Number(given ?? 11);
/** `GROMA_SPELLINGS=100` tries all spellings of the systems that are listed, and of as many of EPSG. */
const COUNT = Number(process.env.GROMA_SPELLINGS ?? 0);
/** Of the listed ones in the suite, a second each. */
const SHARE = process.env.GROMA_SPELLINGS === undefined ? 23 : 1;
/** Metres. */
const SAME = 1e-3;
/** LAS scale factors, source units: small enough for degrees. */
const SCALE = [1e-8, 1e-8, 1e-3];

const missing = projMissing ?? pythonMissing;

/** Folder of PROJ's database, which the referee reads too. */
function database(): string {
  const folder = proj!.directories.find((directory) => existsSync(join(directory, "proj.db")));
  if (folder === undefined) throw new Error("PROJ's database is in none of its folders");
  return folder;
}

/**
 * What is wrong with where a spelling is placed; nothing where the statement holds and, by PROJ, it is PROJ's own place.
 * Without PROJ a refusal is none, and neither is a place that PROJ does not have.
 */
async function faultOf(
  { text, points, ecef }: Spelling,
  engine: "proj" | "proj4js",
): Promise<string | undefined> {
  const file = "scan.las";
  const choice = { engine } as const;
  const byProj = engine === "proj";
  const along = (axis: 0 | 1 | 2) => points.map((point) => point[axis]);
  const corner = (of: (...values: number[]) => number): [number, number, number] => [
    of(...along(0)),
    of(...along(1)),
    of(...along(2)),
  ];
  try {
    const system = await georeference({ file }, { crs: text, ...choice });
    const surroundings = { text: text.startsWith("+") ? text : undefined, file };
    const bounds = { min: corner(Math.min), max: corner(Math.max) };
    const { georeference: record, transformation } = await makeRecords(
      ...([system, bounds, SCALE, choice, surroundings] as const),
    );
    if (!ecef) return byProj ? "placed, though PROJ has no way" : undefined;
    const place = pointTransform(truthOf({ crs: system.crs, transformation }, 0, file));
    // PROJ has heights in metres where a system declares none, Groma in the unit of the plane.
    const { declared, size } = system.crs.verticalUnit;
    const out = new Float64Array(3);
    const off = points.map(([x, y, z], i) => {
      place(x, y, z / (declared ? 1 : size), out, 0);
      return distance([...out], ecef[i]!);
    });
    const worst = Math.max(...off);
    const { total } = statedAccuracy(record.accuracy);
    const said = `${worst} m off, ${total} m stated, by ${record.operation?.name}, ${JSON.stringify(system.crs.height)}`;
    if (total !== null && worst > total) return `broken: ${said}`;
    return byProj && worst > SAME ? said : undefined;
  } catch (error) {
    if (!(error instanceof GromaError)) throw error;
    return byProj && ecef ? `${error.code}: ${error.cause}` : undefined;
  }
}

const named = (engine: "proj" | "proj4js") => async (spellings: readonly Spelling[]) => {
  const faults: string[] = [];
  for (const one of spellings) {
    const fault = await faultOf(one, engine);
    if (fault !== undefined) faults.push(`${one.system}, ${one.spelling}: ${fault}`);
  }
  return faults;
};

describe.skipIf(missing)(`spellings of one system${missing ? ` (skipped: ${missing})` : ""}`, () => {
  it(`are placed where PROJ places them, heights included: one of ${SHARE} and more, seed ${SEED}`, {
    timeout: 120_000 + 20_000 * COUNT,
  }, async () => {
    const spellings = runPython<Spelling[]>("interop/spellings.py", [
      ...[SEED, COUNT, SHARE].map(String),
      database(),
    ]);
    expect(await named("proj")(spellings)).toEqual([]);
    expect(await named("proj4js")(spellings)).toEqual([]);
  });
});
