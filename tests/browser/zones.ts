import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { locked } from "../lock.js";
import { projectRoot } from "../project.js";
import { runPython } from "../python.js";

/** Scans of the same places in two UTM zones: point i of both is the place i (metres, EPSG:4978), and has the intensity i. */
export interface Twins {
  zones: { file: string; zone: number }[];
  ecef: [x: number, y: number, z: number][];
}

const folder = join(projectRoot, "tests/artifacts/zones");

/** The scans of `zones.py`, written where they are not there yet. */
export function twins(): Promise<Twins> {
  const script = join(projectRoot, "tests/browser/zones.py");
  const told = join(folder, "twins.json");
  return locked(`${folder}.lock`, () => {
    if (!existsSync(told) || statSync(told).mtimeMs < statSync(script).mtimeMs) {
      mkdirSync(folder, { recursive: true });
      writeFileSync(told, JSON.stringify(runPython<Twins>("browser/zones.py", ["write", folder])));
    }
    return JSON.parse(readFileSync(told, "utf8")) as Twins;
  });
}
