import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { random } from "../../../../../georef/src/cartesian/points.fixture.js";
import { cutAndFill } from "./cut-and-fill.js";
import { Tin } from "./tin.js";

const next = random(2015);
const normal = () => Math.sqrt(-2 * Math.log(1 - next())) * Math.cos(2 * Math.PI * next());

/** Points of a surface over a square, a grid that is shaken by a part of its spacing. */
function surface(
  half: number,
  spacing: number,
  height: (x: number, y: number) => number,
  shake = 0.4,
): Float64Array {
  const points: number[] = [];
  for (let x = -half; x <= half; x += spacing) {
    for (let y = -half; y <= half; y += spacing) {
      const [px, py] = [x + shake * spacing * (next() - 0.5), y + shake * spacing * (next() - 0.5)];
      points.push(px, py, height(px, py));
    }
  }
  return Float64Array.from(points);
}

const ringOf = (...corners: (readonly [number, number, number?])[]) =>
  Float64Array.from(corners.flatMap(([x, y, z = 0]) => [x, y, z]));
const square = (half: number, z = 0) =>
  ringOf([-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]);
const circle = (radius: number, count = 720) =>
  ringOf(
    ...Array.from({ length: count }, (_, i): [number, number] => {
      const angle = (2 * Math.PI * i) / count;
      return [radius * Math.cos(angle), radius * Math.sin(angle)];
    }),
  );

describe("volumes of solids", () => {
  // Points every hundredth of the width: the densities that docs/measuring.md states.
  it.each<[string, (x: number, y: number) => number, number]>([
    ["a cone", (x, y) => Math.max(0, 10 - Math.hypot(x, y)), (Math.PI * 1000) / 3],
    ["a paraboloid", (x, y) => Math.max(0, 10 - (x * x + y * y) / 10), (Math.PI * 1000) / 2],
    ["half a ball", (x, y) => Math.sqrt(Math.max(0, 100 - x * x - y * y)), (2 * Math.PI * 1000) / 3],
    ["a pyramid", (x, y) => Math.max(0, 10 - Math.max(Math.abs(x), Math.abs(y))), 4000 / 3],
    ["a bell", (x, y) => 10 * Math.exp(-(x * x + y * y) / 8), 10 * Math.PI * 8],
  ])("%s, to a thousandth", (_, height, truth) => {
    const { cut, fill, area, covered } = cutAndFill(surface(13, 0.2, height), square(12), {
      kind: "height",
      height: 0,
    });
    expect(Math.abs(cut / truth - 1)).toBeLessThan(1e-3);
    expect(fill).toBeLessThan(1e-9);
    expect(area).toBeCloseTo(576, 9);
    expect(covered).toBeCloseTo(576, 6);
  });

  it("a plane that is cut by a level, exactly", () => {
    const points = surface(12, 0.7, (x) => x);
    const { cut, fill } = cutAndFill(points, square(10), { kind: "height", height: 0 });
    expect(cut).toBeCloseTo((20 * 100) / 2, 8);
    expect(fill).toBeCloseTo((20 * 100) / 2, 8);
  });

  it("over rings of any shape, in either direction, exactly for a plane", () => {
    const radii = fc.array(fc.double({ min: 0.3, max: 1, noNaN: true }), { minLength: 3, maxLength: 14 });
    const points = surface(12, 0.5, (x, y) => 5 + 0.1 * x - 0.2 * y);
    fc.assert(
      fc.property(radii, fc.boolean(), (shape, turned) => {
        const corners = shape.map((radius, i): [number, number] => {
          const angle = (2 * Math.PI * i) / shape.length;
          return [10 * radius * Math.cos(angle), 10 * radius * Math.sin(angle)];
        });
        const ring = ringOf(...(turned ? corners.reverse() : corners));
        const { cut, fill, area, covered } = cutAndFill(points, ring, { kind: "height", height: 0 });
        let [moment, whole] = [0, 0];
        for (const [i, [x, y]] of corners.entries()) {
          const [u, v] = corners[(i + 1) % corners.length];
          const part = (x * v - u * y) / 2;
          whole += part;
          moment += part * (5 + (0.1 * (x + u) - 0.2 * (y + v)) / 3);
        }
        expect(area).toBeCloseTo(Math.abs(whole), 8);
        expect(covered).toBeCloseTo(area, 6);
        expect(cut - fill).toBeCloseTo(Math.abs(moment), 5);
      }),
      { numRuns: 100 },
    );
  });

  it("against what the base is", () => {
    const hill = surface(12, 0.2, (x, y) => 3 + 0.1 * x + Math.max(0, 5 - Math.hypot(x, y)));
    const cone = (Math.PI * 125) / 3;
    const tilted = ringOf(
      ...(
        [
          [-10, -10],
          [10, -10],
          [10, 10],
          [-10, 10],
        ] as const
      ).map(([x, y]) => [x, y, 3 + 0.1 * x] as const),
    );
    for (const kind of ["plane", "ring"] as const) {
      const { cut, fill } = cutAndFill(hill, tilted, { kind });
      expect(Math.abs(cut / cone - 1)).toBeLessThan(2e-3);
      expect(fill).toBeLessThan(1e-6);
    }
    // From the lowest corner the tilted ground counts too: 400 m² by 1 m in the mean.
    const lowest = cutAndFill(hill, tilted, { kind: "lowest" });
    expect(lowest.cut).toBeCloseTo(cone + 400, 0);
    const highest = cutAndFill(hill, tilted, { kind: "highest" });
    expect(highest.cut - highest.fill).toBeCloseTo(cone - 400, 0);
  });

  it("between two surfaces, each with its own points", () => {
    const before = surface(13, 0.31, (x, y) => 0.05 * x * Math.sin(y / 3));
    const after = surface(
      13,
      0.23,
      (x, y) =>
        0.05 * x * Math.sin(y / 3) +
        Math.max(0, 4 - Math.hypot(x - 2, y)) -
        Math.max(0, 3 - Math.hypot(x + 6, y)),
    );
    const { cut, fill } = cutAndFill(after, circle(12), { kind: "surface", points: before });
    expect(Math.abs(cut / ((Math.PI * 64) / 3) - 1)).toBeLessThan(5e-3);
    expect(Math.abs(fill / ((Math.PI * 27) / 3) - 1)).toBeLessThan(1e-2);
  });

  it("of a surface against itself, and against the half of its points, are nothing at all", () => {
    // Integers of a scan, many of them above each other.
    const points = surface(5, 0.1, (x, y) => 400 + x * y, 0).map((value, i) =>
      i % 3 === 1 ? Math.round(value) : value,
    );
    const same = cutAndFill(points, square(4), { kind: "surface", points: points.slice() });
    expect([same.cut, same.fill]).toEqual([0, 0]);
    expect(same.covered).toBeCloseTo(64, 6);
    // Of a scan that is part of another the points that both have do not differ.
    const flat = surface(5, 0.3, () => 400.123, 0.4);
    const twice = Float64Array.from([...flat, ...flat.map((value, i) => (i % 3 === 2 ? value + 1 : value))]);
    const part = cutAndFill(twice, square(4), { kind: "surface", points: flat });
    expect(part.fill).toBe(0);
    // Of two points above each other one makes the surface, the upper as often as the lower.
    expect(Math.abs(part.cut - 32)).toBeLessThan(4);
  });

  it("say that what lies in a gap of the points is not covered", () => {
    const points = surface(10, 0.25, () => 1);
    const around: number[] = [];
    for (let i = 0; i < points.length; i += 3) {
      if (Math.hypot(points[i], points[i + 1]) > 6) around.push(...points.subarray(i, i + 3));
    }
    const { cut, covered } = cutAndFill(Float64Array.from(around), square(8), { kind: "height", height: 0 });
    expect(cut).toBeCloseTo(256, 6);
    expect(covered).toBeGreaterThan(256 - 36 * Math.PI - 5);
    expect(covered).toBeLessThan(256 - 36 * Math.PI + 25);
  });

  it("say what of the ring the points do not cover", () => {
    const { area, covered } = cutAndFill(
      surface(5, 0.5, () => 1, 0),
      square(10),
      { kind: "height", height: 0 },
    );
    expect(area).toBe(400);
    expect(covered).toBeCloseTo(100, 6);
  });

  it.each<[string, Parameters<typeof cutAndFill>[2]["kind"]]>([
    ["the lowest vertex", "lowest"],
    ["the plane through the vertices", "plane"],
    ["triangles between the vertices", "ring"],
    ["another surface", "surface"],
    ["a height", "height"],
  ])("against %s hold the truth as often as they say", (_, kind) => {
    const points = surface(6, 0.8, (x, y) => 3 + 0.2 * x - 0.1 * y);
    const others = surface(6, 1.1, (x) => 1 + 0.1 * x);
    const ring = ringOf([-5, -5, 1], [5, -4, 2.2], [4, 5, 3], [0, 5.4, 3], [-5, 4, 2]);
    const baseOf = (of: Float64Array) =>
      kind === "surface" ? { kind, points: of } : kind === "height" ? { kind, height: 1 } : { kind };
    const net = (of: Float64Array, around: Float64Array, base: Float64Array) => {
      const { cut, fill, ...rest } = cutAndFill(of, around, baseOf(base));
      return { net: cut - fill, ...rest };
    };
    const truth = net(points, ring, others);
    const { surface: own, base, ring: around } = truth.sensitivities();
    expect([base.up > 0, around.up > 0]).toEqual([kind === "surface", !["surface", "height"].includes(kind)]);
    const deviation = 0.05 * Math.hypot(own.up, own.plan, base.up, base.plan, around.up, around.plan);
    const runs = 1500;
    let held = 0;
    for (let run = 0; run < runs; run++) {
      const noisy = (xyz: Float64Array) => xyz.map((value) => value + 0.05 * normal());
      const seen = net(noisy(points), noisy(ring), noisy(others));
      if (Math.abs(seen.net - truth.net) <= 1.96 * deviation) held++;
    }
    expect(held / runs).toBeGreaterThanOrEqual(0.93);
    expect(held / runs).toBeLessThanOrEqual(0.97);
  });

  it("have rings and surfaces that are none refused", () => {
    const points = surface(2, 1, () => 0);
    for (const base of [
      { kind: "mean" },
      { kind: "height", height: Number.NaN },
      { kind: "height" },
      undefined,
    ]) {
      expect(() => cutAndFill(points, square(1), base as never)).toThrow("MEASURE_OPTION: volume: ");
    }
    const bow = ringOf([0, 0], [1, 1], [1, 0], [0, 1]);
    expect(() => cutAndFill(points, bow, { kind: "lowest" })).toThrow("MEASURE_CROSSING");
    expect(() => cutAndFill(points, bow.slice(0, 6), { kind: "lowest" })).toThrow("MEASURE_VERTICES");
    expect(() => cutAndFill(points.slice(0, 6), square(1), { kind: "lowest" })).toThrow("MEASURE_SURFACE");
    const line = Float64Array.from([0, 0, 0, 1, 1, 0, 2, 2, 0, 3, 3, 0]);
    expect(() => cutAndFill(line, square(1), { kind: "lowest" })).toThrow("MEASURE_SURFACE");
  });
});

describe("a surface of triangles", () => {
  it("has the heights of a plane anywhere, and none outside", () => {
    const tin = new Tin(surface(10, 0.9, (x, y) => 2 * x - y + 1));
    const axis = fc.double({ min: -9, max: 9, noNaN: true });
    fc.assert(
      fc.property(axis, axis, (x, y) => {
        expect(tin.heightAt(x, y)).toBeCloseTo(2 * x - y + 1, 9);
      }),
      { numRuns: 2000 },
    );
    expect(tin.heightAt(11, 0)).toBeNaN();
    expect(tin.heightAt(0, 0)).toBeCloseTo(1, 9);
  });
});
