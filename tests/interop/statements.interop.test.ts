import { existsSync } from "node:fs";
import { join } from "node:path";
import {
  type AccuracyPart,
  ecefToGeodetic,
  GromaError,
  pointTransform,
  statedAccuracy,
  truthOf,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { georeference } from "../../converter/cli/place/georeference.js";
import { makeRecords } from "../../converter/cli/place/records.js";
import { proj, projMissing } from "../proj.js";
import { pythonMissing, runPython } from "../python.js";
import { distance } from "./groma.js";

/** As `statements.py` prints it. */
interface System {
  readonly code: number;
  readonly name: string;
  readonly places: readonly {
    readonly source: readonly [number, number, number];
    readonly ecef: readonly [number, number, number];
    readonly operation: string;
    readonly accuracy: number | null;
  }[];
}

const given = process.env.GROMA_SEED;
const SEED = given === "random" ? Date.now() % 1e6 : Number(given ?? 1984);
/** Systems in the suite, half a second each; `GROMA_STATEMENTS=2000` tries as many. */
const COUNT = Number(process.env.GROMA_STATEMENTS ?? 30);
/** Of the same kind by PROJ itself, whose programs take a second a place. */
const BY_PROJ = { share: 0.1, places: 3 };
const PLACES = 20;
/** Systems that one run of the referee is asked for: seconds of its time. */
const AT_ONCE = 25;
/** LAS scale factors, source units: small enough for degrees. */
const SCALE = [1e-7, 1e-7, 1e-3];

/** Operations that are wrong as they are registered (converter/cli/proj/faulty.ts): no truth to hold statements against. */
const FAULTY = /MGI 1901 to (WGS 84 \(14\)|KOSOVAREF01 \(1\))/;

const missing = projMissing ?? pythonMissing;

/** Folder of PROJ's database, which the referee reads too. */
function database(): string {
  const folder = proj!.directories.find((directory) => existsSync(join(directory, "proj.db")));
  if (folder === undefined) throw new Error("PROJ's database is in none of its folders");
  return folder;
}

/** Metres between two places, in plane and in height. */
function apart(a: readonly number[], b: readonly number[]): { flat: number; high: number } {
  const height = (ecef: readonly number[]) => {
    const out = new Float64Array(3);
    ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, out);
    return out[2]!;
  };
  const high = Math.abs(height(a) - height(b));
  return { high, flat: Math.sqrt(Math.max(0, distance(a, b) ** 2 - high ** 2)) };
}

/** A statement that is less than the error, both in metres. */
interface Broken {
  readonly what: string;
  readonly stated: number;
  readonly error: number;
}

interface Judgement {
  /** Of the places of a system the one whose statement is farthest from the error. */
  readonly broken?: string;
  readonly places: number;
  /** Places whose plane has no stated accuracy. */
  readonly unstated: number;
  readonly refused: boolean;
}

/** The sum of all parts but one, metres; `null` where one of them is not known. */
function sumWithout(parts: readonly AccuracyPart[], without?: string): number | null {
  return statedAccuracy(parts.filter(({ name }) => name !== without)).total;
}

async function judge({ code, name, places }: System, engine: "proj4js" | "proj"): Promise<Judgement> {
  const file = `EPSG:${code}`;
  const choice = { engine, proj: undefined, grids: undefined } as const;
  const broken: Broken[] = [];
  let unstated = 0;
  try {
    const system = await georeference({ file }, { crs: file, ...choice });
    // PROJ has heights in metres where a system declares none, Groma in the unit of the plane.
    const { declared, size } = system.crs.verticalUnit;
    for (const { source, ecef, operation } of places) {
      if (FAULTY.test(operation)) continue;
      const [x, y, z] = [source[0], source[1], source[2] / (declared ? 1 : size)];
      const min = [x, y, z] as [number, number, number];
      const records = await makeRecords(system, { min, max: min }, SCALE, choice, { file, text: file });
      const { accuracy } = records.georeference;
      const own = new Float64Array(3);
      const { transformation } = records;
      pointTransform(truthOf({ crs: system.crs, transformation }, z, file))(x, y, z, own, 0);
      const { flat, high } = apart([...own], ecef);
      const [plane, whole] = [sumWithout(accuracy, "height"), sumWithout(accuracy)];
      const what = `at ${x}, ${y}, PROJ by ${operation}`;
      if (plane === null) unstated++;
      else if (flat > plane) broken.push({ what: `in plane ${what}`, stated: plane, error: flat });
      if (whole !== null && Math.hypot(flat, high) > whole) {
        broken.push({ what: `in all ${what}`, stated: whole, error: Math.hypot(flat, high) });
      }
    }
  } catch (error) {
    if (!(error instanceof GromaError)) throw error;
    return { places: 0, unstated: 0, refused: true };
  }
  const [worst] = broken.sort((a, b) => b.error / b.stated - a.error / a.stated);
  const text = worst && `${file} ${name}, ${worst.what}: ${worst.stated} m stated, ${worst.error} m off`;
  return { ...(text && { broken: text }), places: places.length, unstated, refused: false };
}

/** All systems, of which the referee is asked for some at a time. */
function* systems(count: number, places: number): Generator<System> {
  for (let done = 0; done < count; done += AT_ONCE) {
    const args = [SEED + done, Math.min(AT_ONCE, count - done), places, database()].map(String);
    yield* runPython<System[]>("interop/statements.py", args);
  }
}

describe.skipIf(missing)(`random EPSG systems${missing ? ` (skipped: ${missing})` : ""}`, () => {
  it.each([
    ["proj4js", COUNT, PLACES],
    ["proj", Math.ceil(COUNT * BY_PROJ.share), BY_PROJ.places],
  ] as const)(
    `are by %s no farther from PROJ than stated: %i, seed ${SEED}, %i places each`,
    {
      timeout: 20_000 * COUNT,
    },
    async (engine, count, places) => {
      const judgements: Judgement[] = [];
      for (const system of systems(count, places)) {
        const judgement = await judge(system, engine);
        judgements.push(judgement);
        // A run of 2,000 takes an hour: what is broken is told when it is found.
        if (judgement.broken) console.info(judgement.broken);
        if (judgements.length % AT_ONCE === 0) console.info(`${judgements.length} systems judged`);
      }
      const sum = (key: "places" | "unstated") => judgements.reduce((all, one) => all + one[key], 0);
      const refused = judgements.filter((one) => one.refused).length;
      console.info(
        `${sum("places")} places judged, ${sum("unstated")} of unknown accuracy, ${refused} systems refused`,
      );
      expect(judgements.flatMap(({ broken }) => broken ?? [])).toEqual([]);
      expect(sum("places") - sum("unstated")).toBeGreaterThan(0.3 * count * places);
    },
  );
});
