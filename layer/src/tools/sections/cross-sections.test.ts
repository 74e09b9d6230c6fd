import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { Corridor } from "../profile/corridor.js";
import { CrossSections } from "./cross-sections.js";

/** Coordinates on a coarse lattice, where points often lie exactly on an edge, and far from the origin. */
const lattice = fc.integer({ min: -40, max: 40 }).map((step) => 600000 + step * 0.25);
const vertex = fc.tuple(lattice, lattice);
const lines = fc
  .array(vertex, { minLength: 2, maxLength: 6 })
  .filter((line) => line.some(([x, y]) => x !== line[0][0] || y !== line[0][1]));
const width = fc.integer({ min: 0, max: 20 }).map((steps) => steps * 0.25);

const BENT = new Corridor(
  [
    [0, 0],
    [10, 0],
    [10, 10],
  ],
  1,
);

describe("cross-sections of a line", () => {
  it("find just the points that each strip alone contains, whichever of them overlap", () => {
    fc.assert(
      fc.property(
        lines,
        width,
        width,
        fc.array(vertex, { minLength: 20, maxLength: 20 }),
        fc.array(fc.double({ min: 0, max: 1, noNaN: true }), { minLength: 1, maxLength: 8 }),
        (line, left, right, points, shares) => {
          fc.pre(left + right > 0);
          const along = new Corridor(line, 1);
          const chainages = shares.map((share) => share * along.length);
          const sections = new CrossSections(along, chainages, { left, right, thickness: 2 });
          const out = new Uint32Array(sections.count);
          for (const [x, y] of points) {
            const expected = sections.sections.flatMap(({ strip }, part) =>
              strip.contains(x, y) ? [part] : [],
            );
            expect([...out.subarray(0, sections.partsAt(x, y, 0, out))]).toEqual(expected);
            expect(sections.contains(x, y)).toBe(expected.length > 0);
            const box = Float64Array.of(x, y, 0, x, y, 0);
            if (expected.length > 0) expect(sections.toBox(box)).not.toBe("out");
          }
        },
      ),
      { numRuns: 60 },
    );
  });

  it("lie at right angles to the line, at a corner between both of its sides, and count from the left", () => {
    const { sections } = new CrossSections(BENT, [4, 10, 20], { left: 3, right: 2, thickness: 1 });
    expect(sections.map(({ strip }) => strip.vertices)).toEqual([
      [
        [4, 3],
        [4, -2],
      ],
      [
        [10 - 3 * Math.SQRT1_2, 3 * Math.SQRT1_2],
        [10 + 2 * Math.SQRT1_2, -2 * Math.SQRT1_2],
      ].map((place) => place.map((number) => expect.closeTo(number, 12))),
      [
        [7, 10],
        [12, 10],
      ],
    ]);
    expect(sections[0].strip.chainages).toEqual([-3, 2]);
    const place = new Float64Array(2);
    sections[0].strip.locate(4.25, 1, place);
    expect([...place]).toEqual([-1, 0.25]);
  });

  it("take the direction of the earlier side where a line turns back on itself", () => {
    const back = new Corridor(
      [
        [0, 0],
        [10, 0],
        [0, 0],
      ],
      1,
    );
    expect(back.at(10)).toEqual({ x: 10, y: 0, direction: [1, 0] });
    expect(back.at(15)).toEqual({ x: 5, y: 0, direction: [-1, 0] });
    expect(back.at(20.001)).toBeUndefined();
    expect(back.at(-0.001)).toBeUndefined();
  });

  it.each([
    [[5], { left: 0, right: 0, thickness: 1 }],
    [[5], { left: -1, right: 3, thickness: 1 }],
    [[5], { left: 1, right: 1, thickness: 0 }],
    [[21], { left: 1, right: 1, thickness: 1 }],
    [[], { left: 1, right: 1, thickness: 1 }],
  ])("are refused at %j with %j", (chainages, widths) => {
    expect(() => new CrossSections(BENT, chainages, widths)).toThrow(RangeError);
  });
});
