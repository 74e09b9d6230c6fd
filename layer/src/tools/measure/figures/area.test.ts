import { geodesicBetween } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { measureArea, placeVertex } from "../index.js";
import { beside, DEGREE, finite, utm } from "./places.fixture.js";

/** Star-shaped rings anywhere: each vertex by distance from the middle. */
const ring = fc
  .tuple(
    fc.oneof(finite(-Math.PI, Math.PI), fc.constantFrom(Math.PI, -Math.PI)),
    fc.oneof(finite(-Math.PI / 2, Math.PI / 2), fc.constantFrom(Math.PI / 2, -Math.PI / 2)),
    fc.array(finite(0.5, 1), { minLength: 3, maxLength: 12 }),
    finite(0, 4),
  )
  .map(([longitude, latitude, radii, exponent]) =>
    radii.map((radius, i) => {
      const angle = (2 * Math.PI * i) / radii.length;
      const size = radius * 10 ** exponent;
      return beside(longitude, latitude, 0, size * Math.cos(angle), size * Math.sin(angle), 0);
    }),
  );

describe("areas", () => {
  it("do not depend on the first vertex, nor on the direction", () => {
    fc.assert(
      fc.property(ring, fc.nat(), (vertices, at) => {
        const first = at % vertices.length;
        const turned = [...vertices.slice(first), ...vertices.slice(0, first)].reverse();
        const [one, other] = [measureArea(vertices), measureArea(turned)];
        const close = 0.1 + 1e-9 * one.geodesic.value;
        expect(Math.abs(one.geodesic.value - other.geodesic.value)).toBeLessThan(close);
        expect(Math.abs(one.planar.value - other.planar.value)).toBeLessThan(1e-9 * one.planar.value + 1e-6);
        expect(Math.abs(one.perimeter.space.value - other.perimeter.space.value)).toBeLessThan(1e-6);
      }),
      { numRuns: 500 },
    );
  });

  it("add up when a polygon is cut in two", () => {
    const at = (e: number, n: number) => beside(-1, 0.7, 0, e, n, 0);
    const whole = [at(0, 0), at(30, 0), at(40, 25), at(10, 30), at(-10, 10)];
    const halves = [whole.slice(0, 4), [whole[0], ...whole.slice(3)]];
    for (const of of ["geodesic", "planar"] as const) {
      const sum = halves.reduce((total, half) => total + measureArea(half)[of].value, 0);
      expect(sum).toBeCloseTo(measureArea(whole)[of].value, 4);
    }
  });

  it("in a sloping plane and in the grid", () => {
    const vertices = [
      [500000, 0],
      [500010, 10],
      [500010, 10],
      [500000, 0],
    ].map(([x, z], i) => utm.vertex(x, 5300000 + (i > 1 ? 20 : 0), z));
    const { planar, plane, grid, geodesic } = measureArea(vertices);
    const ground = 1 / 0.9996;
    expect(planar.value / (20 * ground * Math.hypot(10 * ground, 10))).toBeCloseTo(1, 5);
    expect(plane?.slope.value).toBeCloseTo(Math.PI / 4, 3);
    expect(plane?.deviation.value).toBeLessThan(1e-5);
    expect(grid?.area.value).toBeCloseTo(200, 6);
    expect(grid!.area.value / geodesic.value).toBeCloseTo(grid!.scaleFactor ** 2, 7);
  });

  it("take the closing vertex or not, and vertices in one place or on a line", () => {
    const at = (e: number, n: number) => beside(2, 0.1, 0, e, n, 0);
    const square = [at(0, 0), at(10, 0), at(10, 10), at(0, 10)];
    expect(measureArea([...square, square[0]]).planar.value).toBeCloseTo(100, 6);
    expect(measureArea([...square.slice(0, 2), square[1], ...square.slice(2)]).planar.value).toBeCloseTo(
      100,
      6,
    );
    expect(measureArea([at(0, 0), at(5, 0), at(10, 0)]).planar.value).toBeCloseTo(0, 6);
  });

  it("of rings that cross themselves are refused, and say where", () => {
    const at = (e: number, n: number) => beside(3, -1.2, 0, e, n, 0);
    const bow = [at(0, 0), at(10, 10), at(10, 0), at(0, 10)];
    expect(() => measureArea(bow)).toThrow(/MEASURE_CROSSING: .*vertex 1 .*vertex 3 cross/);
    expect(() => measureArea(bow.slice(0, 2))).toThrow("MEASURE_VERTICES");
  });

  it("around the pole hold the pole", () => {
    const cap = Array.from({ length: 36 }, (_, i) => placeVertex((i * 10 - 180) * DEGREE, 89 * DEGREE, 0));
    const radius = geodesicBetween(0, 89 * DEGREE, 0, Math.PI / 2).distance;
    expect(measureArea(cap).geodesic.value / (Math.PI * radius ** 2)).toBeCloseTo(0.995, 2);
  });
});
