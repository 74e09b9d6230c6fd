#!/usr/bin/env node
import { renameSync, rmSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { ORIGIN } from "./area.js";
import { LasWriter } from "./las-writer.js";
import { createRandom } from "./random.js";
import { scan } from "./scanner.js";
import { createScene } from "./scene.js";
import { LV95_LN02_WKT } from "./wkt.js";

/** Options of {@link generateSample}, each with its default. */
export interface SampleOptions {
  /** About how many points: 2,000,000. The valley stays the same, the pulses lie wider apart. */
  points?: number;
  /** Seed of valley and scan: 1. */
  seed?: number;
}

/**
 * The sample scan as the bytes of an uncompressed LAS 1.4 file: an alpine valley in EPSG:2056+5728, flown in
 * five lines. The same options give the same bytes.
 */
export function generateSample({ points = 2_000_000, seed = 1 }: SampleOptions = {}): Uint8Array {
  const writer = new LasWriter(
    {
      wkt: LV95_LN02_WKT,
      offset: [ORIGIN.east, ORIGIN.north, 0],
      scale: 0.001,
      systemIdentifier: "Groma simulated scanner",
      generatingSoftware: "Groma sample generator",
      created: { day: 163, year: 2025 },
    },
    points,
  );
  scan(createScene(seed), createRandom(seed + 1), points, (point) => writer.add(point));
  return writer.finish();
}

/** Command: `node demo/sample/dist/generate.js OUT.las [POINTS]`. The output stands whole or not at all. */
function main([out, points]: string[]): void {
  const count = points === undefined ? 2_000_000 : Number(points);
  if (out === undefined || !Number.isInteger(count) || count < 1000 || count > 50_000_000) {
    const cause = out === undefined ? "no output file is named" : `${points} is not 1000 to 50000000 points`;
    fail(`OPTION_INVALID: generate: ${cause}. Call it as: generate.js OUT.las [POINTS].`);
    return;
  }
  const part = `${out}.part`;
  try {
    writeFileSync(part, generateSample({ points: count }));
    renameSync(part, out);
  } catch (error) {
    rmSync(part, { force: true });
    fail(`OUTPUT_WRITE: ${out}: ${(error as Error).message}. Name a file in a folder with room to write.`);
  }
}

function fail(message: string): void {
  console.error(message);
  process.exitCode = 1;
}

if (process.argv[1] !== undefined && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) {
  main(process.argv.slice(2));
}
