import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  covariance,
  fitPlane,
  PlacementError,
  planarArea,
  quantise,
  slab,
  symmetricEigen,
} from "../index.js";
import { random } from "./points.fixture.js";

const finite = (min: number, max: number) => fc.double({ min, max, noNaN: true, noDefaultInfinity: true });
const integer = (reach: number) => fc.integer({ min: -reach, max: reach });

describe("planar area", () => {
  it("is that of exact arithmetic for coordinates of 10⁹ in steps of a 64th", () => {
    const vertex = fc.tuple(integer(64e3), integer(64e3));
    fc.assert(
      fc.property(fc.array(vertex, { minLength: 3, maxLength: 20 }), integer(1e9), (ring, far) => {
        const at = (i: number) => ring[i % ring.length].map(BigInt);
        let twice = 0n;
        for (let i = 0; i < ring.length; i++) twice += at(i)[0] * at(i + 1)[1] - at(i + 1)[0] * at(i)[1];
        const area = planarArea(ring.flatMap(([x, y]) => [far + x / 64, y / 64 - far]));
        expect(area).toBe(Number(twice) / 2 / 64 ** 2);
      }),
    );
  });

  it("of fewer than three vertices is zero", () => {
    for (const ring of [[], [5, 5], [5, 5, 6, 7]]) expect(planarArea(ring)).toBe(0);
  });
});

describe("a slab", () => {
  it("decides as exact arithmetic does, borders included, at 5·10⁶ m in steps of 1/1024 m", () => {
    const coordinate = integer(2 ** 20);
    const point = fc.tuple(coordinate, coordinate);
    fc.assert(
      fc.property(point, point, point, fc.nat(2 ** 20), ([ax, ay], [bx, by], [px, py], half) => {
        fc.pre(ax !== bx || ay !== by);
        const [dx, dy, x, y] = [bx - ax, by - ay, px - ax, py - ay].map(BigInt);
        const along = x * dx + y * dy;
        const across = dx * y - dy * x;
        const squared = dx * dx + dy * dy;
        const limit = BigInt(half) ** 2n * squared;
        const inside = along >= 0n && along <= squared && across * across <= limit;
        // What is nearer to the border than the last digit of a square, but not on it, may go either way.
        const gap = across * across > limit ? across * across - limit : limit - across * across;
        fc.pre(gap === 0n || gap * 2n ** 51n > limit);
        const metres = (i: number, base: number) => base + i / 1024;
        const { contains } = slab(
          ...([metres(ax, 5e5), metres(ay, 5e6), metres(bx, 5e5), metres(by, 5e6)] as const),
          half / 1024,
        );
        expect(contains(metres(px, 5e5), metres(py, 5e6))).toBe(inside);
      }),
      { numRuns: 5000 },
    );
  });

  it("of a segment without length holds nothing", () => {
    const { contains, along } = slab(3, 4, 3, 4, 1);
    expect(contains(3, 4)).toBe(false);
    expect(along(3, 4)).toBeNaN();
  });

  it("tells left from right", () => {
    const { across } = slab(0, 0, 10, 0, 1);
    expect([across(5, 2), across(5, -2)]).toEqual([2, -2]);
  });
});

describe("planes and covariance", () => {
  const direction = fc.tuple(finite(-1, 1), finite(-1, 1), finite(0.1, 1));

  it("find a plane at 10⁷ m: normal to a microradian, deviation to a nanometre", () => {
    fc.assert(
      fc.property(direction, finite(-1e7, 1e7), fc.integer(), (given, far, seed) => {
        const length = Math.hypot(...given);
        const normal = given.map((component) => component / length);
        const next = random(seed);
        const points = Array.from({ length: 50 }, () => {
          const [x, y] = [next() - 0.5, next() - 0.5];
          return [far + x, y - far, 100 - (normal[0] * x + normal[1] * y) / normal[2]];
        }).flat();
        const plane = fitPlane(points);
        const dot = normal.reduce((sum, component, axis) => sum + component * plane.normal[axis], 0);
        expect(Math.acos(Math.min(1, dot))).toBeLessThanOrEqual(1e-6);
        // Coordinates of 10⁷ m are themselves rounded to 2 nm, and steep planes multiply it by ten.
        expect(plane.deviation).toBeLessThanOrEqual(2e-8);
      }),
      { numRuns: 500 },
    );
  });

  it("give eigenvectors that make the matrix, for singular matrices too", () => {
    const row = fc.tuple(finite(-1, 1), finite(-1, 1), finite(-1, 1));
    fc.assert(
      fc.property(fc.array(row, { minLength: 1, maxLength: 6 }), (rows) => {
        const matrix = [0, 1, 2].flatMap((i) =>
          [0, 1, 2].map((j) => rows.reduce((sum, r) => sum + r[i] * r[j], 0)),
        );
        const { values, vectors } = symmetricEigen(matrix);
        for (let i = 0; i < 3; i++) {
          for (let j = 0; j < 3; j++) {
            const made = [0, 1, 2].reduce(
              (sum, k) => sum + values[k] * vectors[3 * k + i] * vectors[3 * k + j],
              0,
            );
            expect(Math.abs(made - matrix[3 * i + j])).toBeLessThanOrEqual(1e-14 * (1 + values[2]));
          }
        }
        expect(values[0]).toBeLessThanOrEqual(values[1]);
        expect(values[1]).toBeLessThanOrEqual(values[2]);
      }),
      { numRuns: 2000 },
    );
  });

  it("of a million coincident points are exactly zero", () => {
    const points = new Float64Array(3e6);
    for (let i = 0; i < points.length; i += 3) points.set([4000000.1, 600000.1, 5000000.1], i);
    expect([...covariance(points).matrix]).toEqual(new Array(9).fill(0));
    expect(fitPlane(points).deviation).toBe(0);
  });

  it("of no points are not numbers", () => {
    expect(covariance([]).mean).toEqual(Float64Array.of(Number.NaN, Number.NaN, Number.NaN));
  });
});

describe("quantisation", () => {
  it("gives back every integer of 32 bits, for scales from 1e-9 to 1e3", () => {
    const scale = fc.constantFrom(1e-9, 1e-4, 0.001, 0.01, 0.3048, 1, 1e3);
    fc.assert(
      fc.property(fc.integer(), scale, finite(-1, 1), (i, step, place) => {
        // Offsets of this size leave half a step of room for the rounding of the coordinate.
        const offset = place * step * 2 ** 32;
        expect(quantise(i * step + offset, step, offset)).toBe(i);
      }),
      { numRuns: 20000 },
    );
  });

  it.each([Number.NaN, Number.POSITIVE_INFINITY, 2147483647.5, -2147483648.6])("refuses %d", (value) => {
    expect(() => quantise(value, 1, 0)).toThrow(PlacementError);
  });
});
