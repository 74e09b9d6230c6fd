import { describe, expect, it } from "vitest";
import { NODES } from "../approximation/chebyshev.js";
import { random } from "../cartesian/points.fixture.js";
import { eastNorthUp } from "../ellipsoid/frame.js";
import type { ExactTransform } from "../engines/exact.js";
import { fitBound, storageBound, tailBound } from "./certificate.js";
import { type Expansion, expand } from "./expansion.js";
import { fitPlacement } from "./fit.js";
import { place } from "./place.js";

/** Metres that every bound has in addition, for the noise of projections. */
const FLOOR = 5e-6;
const ORIGIN = [4e6, 7e5, 4.9e6];
const box = { x: 0, y: 0, z: 0, halfX: 1, halfY: 1, halfZ: 1 };

/** An expansion with the coefficients given: degree in u, degree in v, function (0 … 5), value in metres. */
function expansionOf(
  ...terms: readonly (readonly [k: number, l: number, c: number, value: number])[]
): Expansion {
  const coefficients = new Float64Array(NODES * NODES * 6);
  for (const [k, l, c, value] of terms) coefficients[(k * NODES + l) * 6 + c] = value;
  return { box, frame: eastNorthUp(ORIGIN), coefficients };
}

describe("the bound of a fit", () => {
  it("is the floor where nothing is left out", () => {
    expect(fitBound(expansionOf([0, 0, 0, 7], [1, 0, 1, 7], [0, 0, 3, 7]), "affine", 0)).toBe(FLOOR);
  });

  it("counts the length of every coefficient that the scheme leaves out, of P and of n", () => {
    const left = expansionOf([2, 0, 0, 3], [2, 0, 1, 4], [1, 1, 2, 0.5], [1, 0, 4, 0.25], [8, 8, 5, 0.125]);
    expect(fitBound(left, "affine", 0)).toBeCloseTo(5 + 0.5 + 0.25 + 0.125 + FLOOR, 12);
    expect(fitBound(left, "affineLinearNormal", 0)).toBeCloseTo(5 + 0.5 + 0.125 + FLOOR, 12);
    expect(fitBound(left, "quadratic", 0)).toBeCloseTo(0.125 + FLOOR, 12);
    expect(fitBound(expansionOf([6, 6, 0, 1], [7, 0, 0, 2], [0, 7, 3, 4]), "tensor6", 0)).toBeCloseTo(
      6 + FLOOR,
      12,
    );
  });

  it("counts the tail", () => {
    expect(fitBound(expansionOf(), "affine", 0.75)).toBe(0.75 + FLOOR);
  });
});

describe("the tail of an expansion", () => {
  /** What nine samples make of a series Σ value · r^k · T_k(u): T_(18−k) looks like −T_k on their nodes. */
  const sampled = (r: number, c: number, value = 1) =>
    [0, 1, 2, 3, 4, 5, 6, 7, 8].map((k) => [k, 0, c, value * (r ** k - r ** (18 - k))] as const);

  it.each([0.01, 0.1, 0.5, 0.8])("of a series of ratio %d is twice all its terms beyond degree 8", (r) => {
    const tail = tailBound(expansionOf(...sampled(r, 0)));
    expect(tail / ((2 * r ** 9) / (1 - r))).toBeCloseTo(1, 9);
    expect(tailBound(expansionOf(...sampled(r, 0), ...sampled(r, 5))) / tail).toBeCloseTo(2, 9);
  });

  it("takes the axes of P, and those of n, for a length", () => {
    const lengths = [0, 1, 2, 3, 4, 5].flatMap((c) => sampled(0.2, c, [3, 0, 4, 0, 5, 12][c]));
    expect(tailBound(expansionOf(...lengths)) / ((2 * 0.2 ** 9) / 0.8)).toBeCloseTo(5 + 13, 9);
  });

  it("looks at the last shell but two where that falls less: series of even terms", () => {
    const even = sampled(0.5, 0).filter(([k]) => k % 2 === 0);
    const tail = tailBound(expansionOf(...even));
    expect(tail / ((2 * 0.5 ** 9) / 0.5)).toBeCloseTo(1, 9);
  });

  it("is that of a ratio of 0.9 where terms do not fall, and nothing where there are none", () => {
    const flat = expansionOf([6, 0, 0, 1], [7, 0, 0, 1], [8, 0, 0, 1]);
    expect(tailBound(flat)).toBeCloseTo((2 * 0.9) / (0.19 * 0.1), 9);
    expect(tailBound(expansionOf([8, 0, 0, 1]))).toBeCloseTo(0.002 / ((1 - 1e-6) * 0.999), 9);
    expect(tailBound(expansionOf([7, 0, 0, 1]))).toBe(0);
  });
});

describe("the bound of storing as float32", () => {
  it("is half a unit in the last place of the farthest coordinate, axis by axis", () => {
    const wide = expansionOf([0, 0, 0, 600], [3, 1, 0, -300], [1, 0, 1, 100], [0, 1, 3, -90], [0, 0, 2, 1]);
    // 600 + 300 + 90 m to the east, 100 m to the north, 1 m up.
    const axes = [2 ** (9 - 24), 2 ** (6 - 24), 2 ** (0 - 24)];
    expect(storageBound(wide, 0)).toBeCloseTo(Math.hypot(...axes), 12);
  });

  it("counts what is added beyond the expansion", () => {
    expect(storageBound(expansionOf(), 1)).toBeCloseTo(Math.sqrt(3) * 2 ** -24, 15);
    expect(storageBound(expansionOf(), 4)).toBeCloseTo(Math.sqrt(3) * 2 ** -22, 15);
  });
});

/**
 * A place 4 m up at most, by a function whose Chebyshev series has terms of all degrees, all of one sign at the corner:
 * amplitude · (1 − r²) / (1 − 2r·u + r²) = amplitude · (1 + 2 Σ r^k T_k(u)).
 */
function poisson(r: number, amplitude: number, along: (x: number, y: number) => number): ExactTransform {
  const { rotation } = eastNorthUp(ORIGIN);
  return (x, y, out, offset) => {
    const up = (amplitude * (1 - r * r)) / (1 - 2 * r * along(x, y) + r * r);
    for (let axis = 0; axis < 3; axis++) {
      const [east, north, upward] = [rotation[axis], rotation[3 + axis], rotation[6 + axis]];
      out[offset + axis] = ORIGIN[axis] + 100 * x * east + 100 * y * north + up * upward;
      out[offset + axis + 3] = upward;
    }
  };
}

describe("a placement by a series that goes on", () => {
  const domain = { minX: -1, minY: -1, minZ: -1, maxX: 1, maxY: 1, maxZ: 1 };
  const cases = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6].flatMap((r) =>
    [0.001, 0.01, 0.1].map((tolerance) => ({ r, tolerance })),
  );

  it.each(cases)(
    "of ratio $r stays within its bound of $tolerance m, corners included",
    ({ r, tolerance }) => {
      const next = random(Math.round(1000 * r));
      const [got, parts] = [new Float64Array(3), new Float64Array(6)];
      for (const along of [(x: number) => x, (_: number, y: number) => -y]) {
        for (let exponent = -6; exponent <= 1; exponent++) {
          const exact = poisson(r, 10 ** exponent, along);
          const placement = fitPlacement(exact, domain, tolerance);
          if (placement.scheme === "exact") continue;
          for (let i = 0; i < 60; i++) {
            const [x, y, z] = [0, 1, 2].map((axis) => (i < 8 ? ((i >> axis) & 1 ? 1 : -1) : 2 * next() - 1));
            exact(x, y, parts, 0);
            place(placement, x, y, z, got);
            const off = Math.hypot(...[0, 1, 2].map((a) => got[a] - parts[a] - z * parts[a + 3]));
            expect(off).toBeLessThanOrEqual(placement.fitBound);
            expect(placement.fitBound).toBeLessThanOrEqual(tolerance);
          }
        }
      }
    },
  );

  it("would leave its bound without the tail (negative control)", () => {
    const exact = poisson(0.6, 0.3, (x) => x);
    const expansion = expand(exact, domain, "test");
    const placement = fitPlacement(exact, domain, 0.1);
    expect(placement.scheme).toBe("tensor6");
    const [got, parts] = [new Float64Array(3), new Float64Array(6)];
    exact(1, 0, parts, 0);
    place(placement, 1, 0, 0, got);
    const off = Math.hypot(...[0, 1, 2].map((axis) => got[axis] - parts[axis]));
    expect(off).toBeLessThanOrEqual(placement.fitBound);
    expect(off).toBeGreaterThan(fitBound(expansion, "tensor6", 0));
  });
});
