import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { isAtJoint, isBeside } from "../exact/exact.js";
import { Corridor } from "./corridor.js";

type Vertex = readonly [number, number];

/** Whether a point lies in the strip, segment by segment and without rounding. */
function exactly(line: readonly Vertex[], width: number, [x, y]: Vertex): boolean {
  const parts = line.slice(1).flatMap((end, index) => {
    const start = line[index];
    return start[0] === end[0] && start[1] === end[1] ? [] : [[...start, ...end] as const];
  });
  return parts.some((segment, index) => {
    const next = parts[index + 1];
    const joint = next && ([...segment, next[2], next[3]] as const);
    return isBeside(x, y, segment, width / 2) || (joint !== undefined && isAtJoint(x, y, joint, width / 2));
  });
}

function located(corridor: Corridor, x: number, y: number) {
  const out = new Float64Array(2);
  const segment = corridor.locate(x, y, out);
  return { segment, chainage: out[0], offset: out[1] };
}

/** Coordinates on a coarse lattice, where points often lie exactly on an edge, and far from the origin. */
const lattice = fc.integer({ min: -40, max: 40 }).map((step) => 600000 + step * 0.25);
const vertex = fc.tuple(lattice, lattice);
const lines = fc
  .array(vertex, { minLength: 2, maxLength: 12 })
  .filter((line) => line.some(([x, y]) => x !== line[0][0] || y !== line[0][1]));
const widths = fc.integer({ min: 1, max: 40 }).map((steps) => steps * 0.25);

describe("a corridor along a line", () => {
  it("contains just the points that exact arithmetic finds near the line, and places each of them", () => {
    fc.assert(
      fc.property(
        lines,
        widths,
        fc.array(vertex, { minLength: 20, maxLength: 20 }),
        (line, width, points) => {
          const corridor = new Corridor(line, width);
          for (const point of points) {
            const inside = exactly(line, width, point);
            expect(corridor.contains(...point)).toBe(inside);
            if (!inside) continue;
            const { segment, chainage, offset } = located(corridor, ...point);
            expect(segment).toBeGreaterThanOrEqual(0);
            expect(chainage).toBeGreaterThanOrEqual(0);
            expect(chainage).toBeLessThanOrEqual(corridor.length);
            expect(Math.abs(offset)).toBeLessThanOrEqual((width / 2) * (1 + 1e-9));
          }
        },
      ),
    );
  });

  it("decides by exact arithmetic what float64 cannot", () => {
    // At a slope of 3 to 4 a distance of 5 is met exactly, and by rounded products only nearly.
    const line: Vertex[] = [
      [0.1, 0.2],
      [4000.1, 3000.2],
    ];
    const corridor = new Corridor(line, 10);
    let [inside, differing] = [0, 0];
    for (let step = 0; step < 2000; step++) {
      const x = 400 + step * 0.8;
      const y = 0.2 + (x - 0.1) * 0.75 + 6.25;
      expect(corridor.contains(x, y)).toBe(exactly(line, 10, [x, y]));
      inside += corridor.contains(x, y) ? 1 : 0;
      const across = (4000 * (y - 0.2) - 3000 * (x - 0.1)) / 5000;
      if (across <= 5 !== corridor.contains(x, y)) differing++;
    }
    expect(inside).toBeGreaterThan(0);
    expect(inside).toBeLessThan(2000);
    expect(differing).toBeGreaterThan(0);
  });

  it.each([1, 30, 90, 150, 179])("has one side at the outer side of a corner of %d°", (angle) => {
    const turn = Math.PI - (angle * Math.PI) / 180;
    for (const side of [1, -1]) {
      const end: Vertex = [100 * Math.cos(turn), side * 100 * Math.sin(turn)];
      const corridor = new Corridor([[-100, 0], [0, 0], end], 40);
      // From the end of the first segment's strip to the beginning of the second one's, and the way straight on between.
      for (const share of [0.01, 0.25, 0.5, 0.75, 0.99]) {
        const heading = -side * (Math.PI / 2 - share * turn);
        const found = located(corridor, 15 * Math.cos(heading), 15 * Math.sin(heading));
        expect(found.chainage).toBeCloseTo(100, 9);
        expect(found.offset).toBeCloseTo(-15 * side, 9);
      }
      if (turn >= Math.PI / 2) expect(located(corridor, 15, 0).offset).toBe(-15 * side);
    }
  });

  it("keeps the side of points beside a segment that begins or ends at a corner", () => {
    // The middle segment is so short that points on its inner side are nearest to its neighbours.
    const corridor = new Corridor(
      [
        [0, 0],
        [10, 0],
        [10, 0.001],
        [10, 10],
      ],
      8,
    );
    expect(located(corridor, 8, 0.001).offset).toBe(0.001);
    expect(located(corridor, 8, 3).offset).toBeCloseTo(2, 12);
    expect(located(corridor, 13, 0.001).offset).toBe(-3);
    expect(located(corridor, 10, -3).offset).toBe(-3);
  });

  it("gives a point at a corner of 1° or 179° to one segment, the nearest", () => {
    for (const degrees of [1, 179]) {
      const turn = (degrees * Math.PI) / 180;
      const corner: Vertex = [100, 0];
      const end: Vertex = [100 + 100 * Math.cos(turn), 100 * Math.sin(turn)];
      const corridor = new Corridor([[0, 0], corner, end], 4);
      // On the inner side the border is the bisector; on the outer one all is at the corner's station.
      const bisector = (Math.PI + turn) / 2;
      const at = (angle: number) => located(corridor, 100 + Math.cos(angle), Math.sin(angle));
      expect(at(bisector + 1e-3).segment).toBe(0);
      expect(at(bisector - 1e-3).segment).toBe(1);
      const outer = at((turn - Math.PI) / 2);
      expect(outer.chainage).toBeCloseTo(100, 9);
      expect(outer.offset).toBeCloseTo(-1, 9);
    }
  });

  it("gives a point where the line crosses itself to the nearest part, and to the earlier of two as near", () => {
    const corridor = new Corridor(
      [
        [0, 0],
        [10, 0],
        [10, 5],
        [5, 5],
        [5, -5],
      ],
      4,
    );
    expect(located(corridor, 5.5, 0.25)).toEqual({ segment: 0, chainage: 5.5, offset: 0.25 });
    expect(located(corridor, 5.25, 0.5)).toEqual({ segment: 3, chainage: 25 - 0.5, offset: 0.25 });
    expect(located(corridor, 5.5, 0.5)).toEqual({ segment: 0, chainage: 5.5, offset: 0.5 });
    expect(located(corridor, 4, -6)).toMatchObject({ segment: -1, chainage: Number.NaN });
  });

  it("ends squarely, and belongs to the ends", () => {
    const corridor = new Corridor(
      [
        [0, 0],
        [10, 0],
      ],
      4,
    );
    for (const [x, y, inside] of [
      [0, 2, true],
      [10, -2, true],
      [-1e-12, 0, false],
      [10.000000001, 0, false],
      [5, 2.000000001, false],
    ] as const) {
      expect(corridor.contains(x, y)).toBe(inside);
    }
  });

  it("loses no point that is nearest to a place of the line between its ends, and takes none past them", () => {
    let [within, past] = [0, 0];
    const anywhere = fc.tuple(
      fc.double({ min: 599_985, max: 600_015, noNaN: true }),
      fc.double({ min: 599_985, max: 600_015, noNaN: true }),
    );
    fc.assert(
      fc.property(lines, widths, fc.array(anywhere, { minLength: 30 }), (line, width, points) => {
        const corridor = new Corridor(line, width);
        for (const [x, y] of points) {
          const feet = line.slice(1).flatMap((end, index) => {
            const start = line[index]!;
            const [ux, uy] = [end[0] - start[0], end[1] - start[1]];
            const square = ux * ux + uy * uy;
            if (square === 0) return [];
            const share = Math.min(1, Math.max(0, (ux * (x - start[0]) + uy * (y - start[1])) / square));
            return [{ away: Math.hypot(x - start[0] - share * ux, y - start[1] - share * uy), share }];
          });
          const nearest = Math.min(...feet.map(({ away }) => away));
          if (Math.abs(nearest - width / 2) < 1e-6) continue;
          const [first, last] = [feet[0]!, feet[feet.length - 1]!];
          const atEnd =
            (first.share === 0 && first.away < nearest + 1e-6) ||
            (last.share === 1 && last.away < nearest + 1e-6);
          if (!atEnd) {
            within++;
            expect(corridor.contains(x, y)).toBe(nearest < width / 2);
          } else if (!feet.some(({ share, away }) => share > 0 && share < 1 && away < width / 2)) {
            // No part lies beside it; where the line turns about it, it may be at a joint.
            if (feet.length === 1) expect(corridor.contains(x, y)).toBe(false);
            past++;
          }
        }
      }),
    );
    expect(within).toBeGreaterThan(500);
    expect(past).toBeGreaterThan(100);
  });

  it("ends squarely behind a last piece that is shorter than half the width", () => {
    for (const turn of [0, 0.3, -0.5]) {
      const end: Vertex = [100 + 2 * Math.cos(turn), 2 * Math.sin(turn)];
      const line: Vertex[] = [[0, 0], [100, 0], end];
      for (const vertices of [line, line.toReversed()]) {
        const corridor = new Corridor(vertices, 20);
        for (const aside of [-9, -4, 0, 4, 9]) {
          const at = (along: number) => [
            end[0] + along * Math.cos(turn) - aside * Math.sin(turn),
            end[1] + along * Math.sin(turn) + aside * Math.cos(turn),
          ];
          const past = at(0.01) as [number, number];
          // What lies beside the piece before stays.
          expect(corridor.contains(...past)).toBe(past[0] <= 100);
          expect(corridor.contains(...(at(-0.01) as [number, number]))).toBe(true);
        }
      }
    }
  });

  it("passes over vertices that repeat the one before", () => {
    const corridor = new Corridor(
      [
        [0, 0],
        [0, 0],
        [10, 0],
        [10, 0],
        [10, 10],
        [10, 10],
      ],
      4,
    );
    expect(corridor.length).toBe(20);
    expect(located(corridor, 11, 5)).toEqual({ segment: 1, chainage: 15, offset: -1 });
  });

  it("measures along the line by the lengths that it is given", () => {
    const corridor = new Corridor(
      [
        [0, 0],
        [10, 0],
        [10, 0],
        [10, 10],
      ],
      4,
      { lengths: [100, 7, 50], start: 1000 },
    );
    expect(corridor.length).toBe(150);
    expect(corridor.chainages).toEqual([1000, 1100, 1100, 1150]);
    expect(located(corridor, 10.5, 5).chainage).toBe(1125);
  });

  it("agrees with itself on boxes", () => {
    const box = fc.tuple(
      vertex,
      fc.integer({ min: 1, max: 40 }).map((steps) => steps * 0.25),
    );
    fc.assert(
      fc.property(lines, widths, box, (line, width, [[x, y], edge]) => {
        const corridor = new Corridor(line, width);
        const relation = corridor.toBox(Float64Array.of(x, y, 0, x + edge, y + edge, 1));
        if (relation === "crossing") return;
        for (let i = 0; i <= 8; i++) {
          for (let j = 0; j <= 8; j++) {
            expect(corridor.contains(x + (i / 8) * edge, y + (j / 8) * edge)).toBe(relation === "in");
          }
        }
      }),
      { numRuns: 2000 },
    );
    const wide = new Corridor(
      [
        [0, 0],
        [100, 0],
      ],
      50,
    );
    expect(wide.toBox(Float64Array.of(10, -10, 0, 20, 10, 1))).toBe("in");
    expect(wide.toBox(Float64Array.of(10, 26, 0, 20, 30, 1))).toBe("out");
  });

  it("refuses lines without length and widths that are none", () => {
    expect(
      () =>
        new Corridor(
          [
            [1, 1],
            [1, 1],
          ],
          4,
        ),
    ).toThrow("no length");
    expect(() => new Corridor([[1, 1]], 4)).toThrow("no length");
    expect(
      () =>
        new Corridor(
          [
            [1, 1],
            [Number.NaN, 2],
          ],
          4,
        ),
    ).toThrow("not finite");
    for (const width of [0, -1, Number.NaN, Number.POSITIVE_INFINITY]) {
      expect(
        () =>
          new Corridor(
            [
              [0, 0],
              [1, 1],
            ],
            width,
          ),
      ).toThrow("width");
    }
    // Chainages that float64 could not tell apart.
    const from = (start: number, end: number) => () =>
      new Corridor(
        [
          [0, 0],
          [end, 0],
        ],
        1,
        { start },
      );
    expect(from(1e12, 1)).not.toThrow();
    for (const start of [1e300, -1e13, Number.NaN]) expect(from(start, 1)).toThrow("cannot start");
    expect(from(1e12, 1e-9)).toThrow("no length");
  });
});
