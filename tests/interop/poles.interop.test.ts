import {
  compileTransformation,
  decodeTransformation,
  domainAround,
  encodeTransformation,
  fitPlacement,
  place,
} from "@groma/georef";
import { beforeAll, describe, expect, it } from "vitest";
import { engineTransformation } from "../../converter/cli/place/engine.js";
import { georeference } from "../../converter/cli/place/georeference.js";
import { random } from "../../georef/src/cartesian/points.fixture.js";
import { projMissing } from "../proj.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { distance } from "./groma.js";

const grids = data("grids");
const missing = projMissing ?? pythonMissing ?? grids.missing;

/** Data sets that contain a pole or cross the antimeridian, and points that lie just there. */
const SETS: readonly (readonly [crs: string, low: number[], high: number[], there: number[][]])[] = [
  [
    "EPSG:3413",
    [-20e3, -15e3, 0],
    [21e3, 15e3, 100],
    [
      [0, 0, 50],
      [0.001, 0, 9],
      [0, -1e-6, 0],
    ],
  ],
  [
    "EPSG:3413+5773",
    [-500, -15e3, 0],
    [20e3, 20, 100],
    [
      [0, 0, 50],
      [-3, -3, 50],
    ],
  ],
  [
    "EPSG:3031",
    [-1.2e6, -1.2e6, 0],
    [1.2e6, 1.2e6, 3000],
    [
      [0, 0, 2800],
      [0, -5e5, 9],
    ],
  ],
  [
    "EPSG:3031+5773",
    [-90e3, -80e3, 0],
    [90e3, 80e3, 3000],
    [
      [0, 0, 2800],
      [0, -5e4, 9],
    ],
  ],
  // PROJ itself loses digits near the pole of this projection: 4 µm at a kilometre, 4 mm at a metre.
  ["EPSG:6931", [-3000, -3000, 0], [3000, 3000, 100], [[0, 0, 50]]],
  [
    "EPSG:5041",
    [1.99e6, 1.995e6, 0],
    [2.02e6, 2.02e6, 100],
    [
      [2e6, 2e6, 4],
      [2e6, 2.01e6, 4],
    ],
  ],
  [
    "EPSG:4326",
    [-180, 80, 0],
    [180, 90, 100],
    [
      [-180, 90, 5],
      [7, 90, 5],
      [77.3, 89.9999999, 4],
      [-120, 89.99, 1],
      [180, 85, 5],
    ],
  ],
  [
    "EPSG:4326",
    [-180, -90, 0],
    [180, 90, 100],
    [
      [0, -90, 5],
      [-180, 0, 5],
      [180, 0, 5],
    ],
  ],
  [
    "EPSG:4326+5773",
    [-180, -17, 0],
    [180, -16.9, 100],
    [
      [-180, -16.95, 5],
      [180, -16.95, 5],
    ],
  ],
  ["EPSG:4326+5773", [179.9, -17, 0], [180.1, -16.9, 100], [[180, -16.95, 5]]],
  ["EPSG:4326+5773", [-180.1, 88, 0], [-179.9, 90, 100], [[-180, 90, 5]]],
];

/** Points of a data set, its corners and what is singular in it. */
function pointsOf(index: number): number[][] {
  const [, low, high, there] = SETS[index]!;
  const next = random(index + 1);
  const inside = Array.from({ length: 200 }, () =>
    low.map((from, axis) => from + next() * (high[axis]! - from)),
  );
  return [low, high, ...there, ...inside];
}

describe.skipIf(missing)("poles and the antimeridian", () => {
  let truth: number[][][];
  beforeAll(() => {
    const jobs = SETS.map(([crs], index) => ({ crs, points: pointsOf(index) }));
    truth = runPython("interop/to_ecef.py", [grids.path], JSON.stringify(jobs));
  }, 60_000);

  it.each(SETS.map(([crs, low, high], index) => [crs, low.join(" "), high.join(" "), index] as const))(
    "%s from %s to %s is placed within 1 mm, and found again within 1 µm",
    { timeout: 60_000 },
    async (code, _low, _high, index) => {
      const [, low, high] = SETS[index]!;
      const choice = { engine: "proj", grids: grids.path } as const;
      const { crs } = await georeference({ file: code }, { crs: code, ...choice });
      const step = crs.horizontalUnit.kind === "angular" ? 1e-7 : 1e-3;
      const domain = domainAround({ min: low, max: high }, [step, step, 1e-3], crs.horizontalUnit);
      const { transformation } = await engineTransformation(crs, domain, choice, { file: code });
      const carried = compileTransformation(decodeTransformation(encodeTransformation(transformation), code));
      const points = pointsOf(index);
      const [ecef, back, drawn] = [0, 0, 0].map(() => new Float64Array(3));
      let [worst, worstBack, worstDrawn] = [0, 0, 0];
      const edge = (axis: number) =>
        Math.min((high[axis]! - low[axis]!) / 100, code.startsWith("EPSG:4326") ? 0.01 : 1000);
      for (const [i, point] of points.entries()) {
        const [x, y, z] = point as [number, number, number];
        carried.forward(x, y, z, ecef);
        worst = Math.max(worst, distance([...ecef], truth[index]![i]!));
        // Which longitude a pole is given is all the same.
        carried.inverse(ecef[0]!, ecef[1]!, ecef[2]!, back);
        const there = new Float64Array(3);
        carried.forward(back[0]!, back[1]!, back[2]!, there);
        worstBack = Math.max(worstBack, distance([...there], [...ecef]));
        if (i >= 40) continue;
        const within = (axis: number, by: number) =>
          Math.max(low[axis]!, Math.min(high[axis]!, point[axis]! + by));
        const node = {
          ...{ minX: within(0, -edge(0)), minY: within(1, -edge(1)), minZ: z, maxZ: z },
          ...{ maxX: within(0, edge(0)), maxY: within(1, edge(1)) },
        };
        const placement = fitPlacement(carried, node, 1e-3, code);
        place(placement, x, y, z, drawn);
        worstDrawn = Math.max(worstDrawn, distance([...drawn], truth[index]![i]!));
        expect(placement.bound).toBeLessThanOrEqual(1e-3);
      }
      expect(worst).toBeLessThanOrEqual(1e-4);
      expect(worstBack).toBeLessThanOrEqual(1e-6);
      expect(worstDrawn).toBeLessThanOrEqual(1e-3);
    },
  );
});
