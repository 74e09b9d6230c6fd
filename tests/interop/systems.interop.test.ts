import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { compileTransformation, type Domain, ecefToGeodetic, GromaError } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { engineTransformation } from "../../converter/cli/place/engine.js";
import { georeference } from "../../converter/cli/place/georeference.js";
import { proj, projMissing } from "../proj.js";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing } from "./core.js";
import { distance, gromaJson, locate } from "./groma.js";

/** As `systems.py` prints it. */
interface System {
  readonly code: number;
  readonly name: string;
  readonly kind: string;
  readonly points: readonly (readonly [number, number, number])[];
  readonly operations: readonly {
    readonly name: string;
    readonly accuracy: number | null;
    readonly ballpark: boolean;
    readonly ecef: readonly (readonly (number | null)[])[];
  }[];
  readonly refused?: string;
}

const SEED = process.env.GROMA_SEED === "random" ? Date.now() % 1e6 : 2015;
/** Systems in the suite, a second each; `GROMA_SYSTEMS=500` tries as many. */
const COUNT = Number(process.env.GROMA_SYSTEMS ?? 100);
/** Metres. */
const SAME = 1e-3;

const missing = projMissing ?? pythonMissing;

interface Outcome {
  readonly system: System;
  readonly what: "placed" | "otherwise" | "stand-in" | "refused" | "refused by PROJ" | "wrong";
  readonly why: string;
}

function domainOf(points: System["points"]): Domain {
  const along = (axis: number) => points.map((point) => point[axis]);
  const [minX, minY, minZ] = [0, 1, 2].map((axis) => Math.min(...along(axis)));
  const [maxX, maxY, maxZ] = [0, 1, 2].map((axis) => Math.max(...along(axis)));
  return { minX, minY, minZ, maxX, maxY, maxZ };
}

/** Metres between two places, in plane and in height. */
function apart(a: readonly number[], b: readonly number[]): { flat: number; high: number } {
  const place = (ecef: readonly number[]) => {
    const out = new Float64Array(3);
    ecefToGeodetic(ecef[0], ecef[1], ecef[2], out);
    return out;
  };
  const high = Math.abs(place(a)[2] - place(b)[2]);
  return { high, flat: Math.sqrt(Math.max(0, distance(a, b) ** 2 - high ** 2)) };
}

async function outcomeOf(system: System): Promise<Outcome> {
  const { points, operations } = system;
  const usable = operations.filter(({ ecef }) => ecef.flat().every((value) => value !== null));
  const file = `EPSG:${system.code}`;
  const choice = { engine: "proj", proj: undefined, grids: undefined } as const;
  // PROJ has heights in metres where a system declares none, Groma in the unit of the plane.
  let metres = 1;
  const own = (list: System["points"]) => list.map(([x, y, z]) => [x, y, z / metres] as const);
  const result = await (async () => {
    const { crs } = await georeference({ file }, { crs: file, ...choice });
    if (!crs.verticalUnit.declared) metres = crs.verticalUnit.size;
    return engineTransformation(crs, domainOf(own(points)), choice, { file, text: file });
  })().catch((error) => {
    if (error instanceof GromaError) return `${error.code}: ${error.cause}`;
    throw error;
  });
  if (typeof result === "string") {
    return { system, what: usable.length === 0 ? "refused by PROJ" : "refused", why: result };
  }
  const { evaluate } = compileTransformation(result.transformation);
  const ecef = new Float64Array(3);
  const placed = own(points).map(([x, y, z]) => {
    evaluate(x, y, z, ecef, 0);
    return [...ecef];
  });
  const farthest = (ecef: readonly (readonly (number | null)[])[]) => {
    const off = placed.map((place, i) => apart(place, ecef[i] as number[]));
    return { flat: Math.max(...off.map(({ flat }) => flat)), high: Math.max(...off.map(({ high }) => high)) };
  };
  const off = usable.map(({ ecef }) => farthest(ecef));
  const said = `${result.report.operation}, ${result.report.accuracy} m`;
  const why = `${said}; PROJ: ${off.map(({ flat, high }, i) => `${usable[i].accuracy} m: ${flat.toExponential(1)} ${high.toExponential(1)}`).join(", ")}`;
  const egm96 = result.report.notes.some((note) => note.includes("EGM96"));
  const same = ({ flat, high }: { flat: number; high: number }) => flat <= SAME && (egm96 || high <= SAME);
  if (off.length === 0) return { system, what: "wrong", why: `${said}; PROJ has no operation` };
  if (same(off[0])) return { system, what: egm96 ? "stand-in" : "placed", why };
  return { system, what: off.some(same) ? "otherwise" : "wrong", why };
}

const systemsOf = (seed: number, count: number) =>
  runPython<System[]>("interop/systems.py", [`${seed}`, `${count}`, database()]);

/** Folder of PROJ's database, which the referee reads too. */
function database(): string {
  const folder = proj!.directories.find((directory) => existsSync(join(directory, "proj.db")));
  if (folder === undefined) throw new Error("PROJ's database is in none of its folders");
  return folder;
}

describe.skipIf(missing)(`random EPSG systems${missing ? ` (skipped: ${missing})` : ""}`, () => {
  it(`are placed as PROJ places them, or refused where PROJ refuses too: ${COUNT}, seed ${SEED}`, {
    timeout: 20_000 * COUNT,
  }, async () => {
    const outcomes: Outcome[] = [];
    const queue = systemsOf(SEED, COUNT);
    const work = async () => {
      for (let next = queue.shift(); next; next = queue.shift()) outcomes.push(await outcomeOf(next));
    };
    await Promise.all([work(), work(), work(), work()]);
    const counts = new Map<string, number>();
    for (const { what } of outcomes) counts.set(what, (counts.get(what) ?? 0) + 1);
    console.info([...counts].map(([what, count]) => `${count} ${what}`).join(", "));
    for (const { system, what, why } of outcomes) {
      if (what === "placed" || what === "stand-in") continue;
      console.info(`${what}: EPSG:${system.code} ${system.name} (${system.kind}): ${why}`);
    }
    const named = (wanted: Outcome["what"]) =>
      outcomes.flatMap(({ what, system, why }) => (what === wanted ? [`EPSG:${system.code}: ${why}`] : []));
    expect(named("wrong")).toEqual([]);
    expect(named("refused").length, named("refused").join("\n")).toBeLessThanOrEqual(0.02 * COUNT);
    expect(named("placed").length).toBeGreaterThan(0.5 * COUNT);
  });

  it.skipIf(coreMissing)(
    "are converted and located, those too that PROJ alone knows",
    { timeout: 60_000 },
    async () => {
      const folder = mkdtempSync(join(tmpdir(), "groma-systems-"));
      try {
        const [las, copc] = [join(folder, "scan.las"), join(folder, "scan.copc.laz")];
        // Xian 1980, whose datum has no shift in the table, and Laborde, which proj4js does not have.
        for (const [code, x, y] of [
          [2385, 500_000, 3_300_000],
          [29701, 400_000, 800_000],
        ]) {
          const rows = [0, 1, 2, 3].map((i) => [x + 400 * (i & 1), y + 300 * (i >> 1), 10 * i]);
          runPython(
            "interop/make_las.py",
            [],
            JSON.stringify([{ path: las, scale: 0.001, rows, wkt: `EPSG:${code}` }]),
          );
          const done = gromaJson<{ centre: { longitude: number; latitude: number } | null }>([
            "convert",
            las,
            copc,
            "--progress",
            "json",
            "--overwrite",
          ]);
          const [{ geodetic: middle }, ...located] = locate(copc, [[x + 200, y + 150, 15], ...rows]);
          const best = await outcomeOf({
            ...{ code, name: "", kind: "", points: rows as unknown as System["points"] },
            operations: [
              {
                name: "groma locate",
                accuracy: 1,
                ballpark: false,
                ecef: located.map(({ ecef }) => ecef),
              },
            ],
          });
          expect(best).toMatchObject({ what: "placed" });
          expect(done.centre?.longitude).toBeCloseTo(middle[0], 4);
          expect(done.centre?.latitude).toBeCloseTo(middle[1], 4);
          const record = gromaJson<{ crs: { code: string } }>(["info", copc, "--json"]);
          expect(JSON.stringify(record)).toContain(`EPSG:${code}`);
        }
      } finally {
        rmSync(folder, { recursive: true, force: true });
      }
    },
  );
});
