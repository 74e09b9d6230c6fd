import { describe, expect, it } from "vitest";
import { distance, random } from "../cartesian/points.fixture.js";
import {
  compileTransformation,
  cutWindow,
  fitPlacement,
  type Grid,
  type GridWindow,
  PlacementError,
  place,
  type Step,
  WGS84,
} from "../index.js";

const DEGREE = Math.PI / 180;

/** Degrees from 0° to 1° east and from 45° to 46° north. */
const degrees: Step = {
  kind: "projection",
  patchwork: {
    patches: [
      {
        ...{ minX: 0, minY: 45, maxX: 1, maxY: 46, degree: 1 },
        coefficients: Float64Array.of(0.5, 0, 0.5, 0, 45.5, 0.5, 0, 0).map((degree) => degree * DEGREE),
      },
    ],
    bound: 1e-6,
  },
};
const geocentric: Step = { kind: "geocentric", ellipsoid: WGS84 };

/** A rough grid of 0.1° over the same square with a margin: random heights of 0.3 m, or shifts of 3e-8 radians. */
function roughWindow(channels: number, hole?: number): GridWindow {
  const next = random(channels);
  const [columns, rows] = [15, 15];
  const values = Float32Array.from({ length: columns * rows * channels }, () => 40 + 0.3 * next());
  if (hole !== undefined) values[hole] = -9999;
  return {
    ...{ grid: "rough", west: -0.2 * DEGREE, south: 44.8 * DEGREE, stepLongitude: 0.1 * DEGREE },
    ...{ stepLatitude: 0.1 * DEGREE, columns, rows, channels, values, unit: channels === 1 ? 1 : 1e-7 },
    noData: -9999,
  };
}

function codeOf(run: () => unknown): string | undefined {
  try {
    run();
    return undefined;
  } catch (error) {
    return error instanceof PlacementError ? error.code : String(error);
  }
}

describe("transformations over grids", () => {
  it("gives the smooth derivative of a bilinear cell exactly", () => {
    const steps: Step[] = [
      degrees,
      { kind: "verticalShift", multiplier: 2, window: roughWindow(1) },
      geocentric,
    ];
    const compiled = compileTransformation({ steps });
    const jacobian = new Float64Array(9);
    const [plus, minus] = [new Float64Array(3), new Float64Array(3)];
    compiled.jacobian(0.537, 45.243, 10, jacobian);
    compiled.forward(0.537 + 1e-5, 45.243, 10, plus);
    compiled.forward(0.537 - 1e-5, 45.243, 10, minus);
    for (let row = 0; row < 3; row++) {
      expect(Math.abs((plus[row] - minus[row]) / 2e-5 - jacobian[3 * row])).toBeLessThan(1e-3);
    }
  });

  it("leaves nodes without data out of heights, and refuses shifts beside them", () => {
    const at = 15 * 5 + 5;
    const [x, y] = [0.33, 45.34];
    const out = new Float64Array(3);
    const ground = new Float64Array(3);
    const height = compileTransformation({
      steps: [degrees, { kind: "verticalShift", multiplier: 1, window: roughWindow(1, at) }, geocentric],
    });
    height.forward(x, y, 0, out);
    compileTransformation({ steps: [degrees, geocentric] }).forward(x, y, 0, ground);
    const { values } = roughWindow(1);
    const others = [values[at + 1], values[at + 15], values[at + 16]];
    // The point is 0.3 of a cell east and 0.4 north of the hole.
    const weights = [0.3 * 0.6, 0.7 * 0.4, 0.3 * 0.4];
    const mean =
      others.reduce((sum, value, i) => sum + value * weights[i], 0) / (weights[0] + weights[1] + weights[2]);
    expect(distance(out, ground)).toBeCloseTo(mean, 6);

    const shift = compileTransformation({
      steps: [
        degrees,
        { kind: "horizontalShift", direction: "forward", window: roughWindow(2, at) },
        geocentric,
      ],
    });
    expect(codeOf(() => shift.forward(x, y, 0, out))).toBe("PLACE_DOMAIN");
  });

  it("is placed point by point where nodes without data are near", () => {
    const compiled = compileTransformation({
      steps: [
        degrees,
        { kind: "verticalShift", multiplier: 1, window: roughWindow(1, 15 * 5 + 5) },
        geocentric,
      ],
    });
    const domain = { minX: 0.3, minY: 45.3, minZ: 0, maxX: 0.5, maxY: 45.5, maxZ: 100 };
    const placement = fitPlacement(compiled, domain, 0.001);
    expect(placement.scheme).toBe("exact");
    const [got, want] = [new Float64Array(3), new Float64Array(3)];
    place(placement, 0.33, 45.34, 50, got);
    compiled.forward(0.33, 45.34, 50, want);
    expect(distance(got, want)).toBeLessThanOrEqual(placement.bound);
  });

  it.each(["forward", "inverse"] as const)(
    "keeps its certificate over rough grids, shift %s",
    (direction) => {
      const compiled = compileTransformation({
        steps: [
          degrees,
          { kind: "horizontalShift", direction, window: roughWindow(2) },
          { kind: "verticalShift", multiplier: -1, window: roughWindow(1) },
          geocentric,
        ],
      });
      const next = random(9);
      const [got, want] = [new Float64Array(3), new Float64Array(3)];
      const schemes = new Set<string>();
      let remainders = 0;
      for (let i = 0; i < 250; i++) {
        const edge = 10 ** (-4.5 + 3.5 * next());
        const [minX, minY] = [next() * (1 - edge), 45 + next() * (1 - edge)];
        const domain = { minX, minY, minZ: -50, maxX: minX + edge, maxY: minY + edge, maxZ: 300 * next() };
        const placement = fitPlacement(compiled, domain, 0.01);
        schemes.add(placement.scheme);
        remainders += placement.remainders.length;
        for (let k = 0; k < 100; k++) {
          const x = minX + next() * edge;
          const y = minY + next() * edge;
          const z = domain.minZ + next() * (domain.maxZ - domain.minZ);
          place(placement, x, y, z, got);
          compiled.forward(x, y, z, want);
          expect(distance(got, want)).toBeLessThanOrEqual(placement.fitBound);
        }
      }
      expect(schemes.size).toBeGreaterThan(2);
      expect(remainders).toBeGreaterThan(30);
    },
  );

  it("is cut to the cells that bounds touch and a margin, or refused by name", () => {
    const whole: Grid = {
      ...{ grid: "whole", west: 0, south: 45 * DEGREE, stepLongitude: DEGREE, stepLatitude: DEGREE },
      ...{ columns: 20, rows: 10, channels: 1, unit: 1, value: (_, row, column) => 100 * row + column },
    };
    const box = { west: 5.5 * DEGREE, south: 47.5 * DEGREE, east: 6.5 * DEGREE, north: 48.2 * DEGREE };
    const cut = cutWindow(whole, box);
    expect([cut.columns, cut.rows]).toEqual([5, 5]);
    expect(cut.values.slice(0, 5)).toEqual(Float32Array.of(104, 105, 106, 107, 108));
    const shifted = cutWindow(whole, { ...box, west: box.west - 2 * Math.PI, east: box.east - 2 * Math.PI });
    expect(shifted).toEqual(cut);
    const edge = cutWindow(whole, { ...box, north: 60 * DEGREE });
    expect([edge.columns, edge.rows]).toEqual([5, 9]);
    expect(codeOf(() => cutWindow(whole, { ...box, west: DEGREE * 100, east: DEGREE * 101 }))).toBe(
      "PLACE_DOMAIN",
    );
    expect(codeOf(() => cutWindow(whole, { ...box, north: Number.NaN }))).toBe("PLACE_DOMAIN");
  });
});
