import {
  type Bounds,
  compileTransformation,
  cutWindow,
  type Step,
  type Transformation,
  WGS84,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { distance, random } from "../../georef/src/cartesian/points.fixture.js";
import { data, dataFolder } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { openGrid } from "./pipelines.js";

const DEGREE = Math.PI / 180;
const BESSEL = { a: 6377397.155, f: 1 / 299.1528128 };

/** Degrees to radians as a patchwork: exact, so that only the steps after it are looked at. */
function degrees(minX: number, minY: number, maxX: number, maxY: number): Step {
  const [x, y] = [(minX + maxX) / 2, (minY + maxY) / 2];
  const longitude = [x * DEGREE, 0, ((maxX - minX) / 2) * DEGREE, 0];
  const latitude = [y * DEGREE, ((maxY - minY) / 2) * DEGREE, 0, 0];
  const coefficients = Float64Array.from([...longitude, ...latitude]);
  return {
    kind: "projection",
    patchwork: { patches: [{ minX, minY, maxX, maxY, degree: 1, coefficients }], bound: 1e-9 },
  };
}

function bounds([west, south, east, north]: readonly number[]): Bounds {
  return { west: west * DEGREE, south: south * DEGREE, east: east * DEGREE, north: north * DEGREE };
}

async function window(grid: string, box: readonly number[]) {
  return cutWindow(await openGrid(grid), bounds(box));
}

interface Case {
  readonly name: string;
  /** West, south, east, north in degrees. */
  readonly box: readonly [number, number, number, number];
  readonly grid?: string;
  /** PROJ's steps between degrees and geocentric coordinates. */
  readonly proj: string;
  readonly steps: (grid: (name: string) => ReturnType<typeof window>) => Promise<Step[]>;
}

const CHENYX = "ch_swisstopo_CHENyx06a.tif";
const EGM96 = "us_nga_egm96_15.tif";
const NLGEO = "nl_nsgi_nlgeo2018.tif";

const cases: readonly Case[] = [
  {
    name: "a horizontal grid forward",
    box: [6.5, 46, 10, 47.5],
    grid: CHENYX,
    proj: `+step +proj=hgridshift +grids=${CHENYX} +step +proj=cart +ellps=bessel`,
    steps: async (grid) => [
      { kind: "horizontalShift", direction: "forward", window: await grid(CHENYX) },
      { kind: "geocentric", ellipsoid: BESSEL },
    ],
  },
  {
    name: "a horizontal grid inverse",
    box: [6.5, 46, 10, 47.5],
    grid: CHENYX,
    proj: `+step +inv +proj=hgridshift +grids=${CHENYX} +step +proj=cart +ellps=bessel`,
    steps: async (grid) => [
      { kind: "horizontalShift", direction: "inverse", window: await grid(CHENYX) },
      { kind: "geocentric", ellipsoid: BESSEL },
    ],
  },
  {
    name: "a vertical grid, subtracted, to its outermost row",
    box: [3, 52, 7, 56],
    grid: NLGEO,
    proj: `+step +proj=vgridshift +grids=${NLGEO} +multiplier=-1 +step +proj=cart +ellps=WGS84`,
    steps: async (grid) => [
      { kind: "verticalShift", multiplier: -1, window: await grid(NLGEO) },
      { kind: "geocentric", ellipsoid: WGS84 },
    ],
  },
  {
    name: "a vertical grid round the earth, across its seam and the antimeridian",
    box: [177.3, -20, 182.6, -10],
    grid: EGM96,
    proj: `+step +proj=vgridshift +grids=${EGM96} +multiplier=1 +step +proj=cart +ellps=WGS84`,
    steps: async (grid) => [
      { kind: "verticalShift", multiplier: 1, window: await grid(EGM96) },
      { kind: "geocentric", ellipsoid: WGS84 },
    ],
  },
  {
    name: "a datum shift that keeps the height, in feet",
    box: [3, 50, 8, 54],
    proj:
      "+step +proj=unitconvert +z_in=us-ft +z_out=m +step +proj=push +v_3 +step +proj=cart +ellps=bessel " +
      "+step +proj=helmert +x=565.4 +y=50.3 +z=465.5 +step +inv +proj=cart +ellps=WGS84 +step +proj=pop +v_3 " +
      "+step +proj=cart +ellps=WGS84",
    steps: async () => [
      { kind: "height", metresPerUnit: 1200 / 3937 },
      {
        ...{ kind: "datumShift", from: BESSEL, to: WGS84, translation: [565.4, 50.3, 465.5] },
        ...{ matrix: [1, 0, 0, 0, 1, 0, 0, 0, 1], keepHeight: true },
      },
      { kind: "geocentric", ellipsoid: WGS84 },
    ],
  },
];

/** PROJ's own way back from ECEF to geodetic coordinates is 10 nm off at the heights tried. */
describe("steps against PROJ", () => {
  for (const { name, box, grid, proj, steps } of cases) {
    const reason = pythonMissing ?? (grid ? data(`grids/${grid}`).missing : undefined);
    it.skipIf(reason)(`${name}: ≤ 20 nm in ECEF`, async () => {
      const next = random(box[1] + 500);
      const points = Array.from({ length: 2000 }, () => [
        box[0] + (box[2] - box[0]) * next(),
        box[1] + (box[3] - box[1]) * next(),
        -100 + 4000 * next(),
      ]);
      const want = runPython<(number[] | null)[]>(
        "numerics/pipeline_referee.py",
        [],
        JSON.stringify({
          pipeline: `+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad ${proj}`,
          grids: `${dataFolder}/grids`,
          points,
        }),
      );
      const transformation: Transformation = {
        steps: [degrees(...box), ...(await steps((file) => window(file, box)))],
      };
      const compiled = compileTransformation(transformation, name);
      const got = new Float64Array(3);
      const back = new Float64Array(3);
      let worst = 0;
      points.forEach(([x, y, z], i) => {
        const expected = want[i];
        expect(expected).not.toBeNull();
        compiled.forward(x, y, z, got);
        worst = Math.max(worst, distance(got, expected ?? []));
        compiled.inverse(got[0], got[1], got[2], back);
        compiled.forward(back[0], back[1], back[2], back);
        expect(distance(back, got)).toBeLessThan(1e-6);
      });
      expect(worst).toBeLessThan(2e-8);
    });
  }
});
