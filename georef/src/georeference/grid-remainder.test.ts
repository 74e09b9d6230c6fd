import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { addCreases, QUADRATIC_TERMS, turnedCreases, turnedTerms, unfoldAll } from "./creases.js";
import { addRemainder, type GridRemainder, remainderOf, turned } from "./grid-remainder.js";
import { addRelief, reliefOf } from "./relief.js";

/** A grid of displacements over a node, and what it was made from. */
interface Sample {
  readonly columns: number;
  readonly rows: number;
  /** Three axes per node of the grid, row by row. */
  readonly nodes: Float64Array;
  readonly position: Float64Array;
  readonly remainder: GridRemainder;
}

const metres = fc.double({ min: -1, max: 1, noNaN: true });
const little = fc.double({ min: -0.02, max: 0.02, noNaN: true });

/**
 * @param most cells along each direction
 * @param bent whether the position is curved
 */
function samples(most: number, bent: boolean): fc.Arbitrary<Sample> {
  return fc
    .record({ columns: fc.integer({ min: 1, max: most }), rows: fc.integer({ min: 1, max: most }) })
    .chain(({ columns, rows }) => {
      const count = 3 * (columns + 1) * (rows + 1);
      return fc.record({
        columns: fc.constant(columns),
        rows: fc.constant(rows),
        values: fc.array(metres, { minLength: count, maxLength: count }),
        bends: fc.array(bent ? little : fc.constant(0), { minLength: 8, maxLength: 8 }),
      });
    })
    .map(({ columns, rows, values, bends }) => {
      const [a, b, c, d, e, f, g, h] = bends;
      // The node fills the grid, or all of it but a margin, within which it is turned and bent.
      const margin = bent ? 0.1 : 0;
      const position = Float64Array.of(
        ...[columns / 2, columns / 2 - margin, a, b, c, d],
        ...[rows / 2, e, rows / 2 - margin, f, g, h],
      );
      const nodes = Float64Array.from(values);
      return { columns, rows, nodes, position, remainder: remainderOf(nodes, columns, rows, position) };
    });
}

const places = fc.array(fc.tuple(metres, metres), { minLength: 12, maxLength: 12 });

/** Where a place of the node is in the grid, in cells. */
function at({ position: p }: Sample, u: number, v: number): [number, number] {
  const terms = [1, u, v, u * u, u * v, v * v];
  const sum = (from: number) => terms.reduce((total, term, i) => total + term * p[from + i], 0);
  return [sum(0), sum(6)];
}

/** The mean of the four nodes around a place, each weighted by the area opposite to it. */
function interpolated({ columns, rows, nodes }: Sample, x: number, y: number): number[] {
  const inCell = (value: number, cells: number) => Math.max(0, Math.min(cells - 1, Math.floor(value)));
  const [i, j] = [inCell(x, columns), inCell(y, rows)];
  return [0, 1, 2].map((axis) => {
    let sum = 0;
    for (const [di, dj] of [
      [0, 0],
      [1, 0],
      [0, 1],
      [1, 1],
    ]) {
      const weight = (di ? x - i : i + 1 - x) * (dj ? y - j : j + 1 - y);
      sum += weight * nodes[3 * ((j + dj) * (columns + 1) + i + di) + axis];
    }
    return sum;
  });
}

/** What is added to nothing. */
function added(add: (out: Float64Array) => void): Float64Array {
  const out = new Float64Array(3);
  add(out);
  return out;
}

const apart = (a: ArrayLike<number>, b: ArrayLike<number>) =>
  Math.hypot(...[0, 1, 2].map((axis) => a[axis] - b[axis]));

/** Places at the grid's own nodes, where the position is not bent, and others between them. */
function lattice({ columns, rows }: Sample): [number, number][] {
  const along = (cells: number) => Array.from({ length: 4 * cells + 1 }, (_, i) => i / (2 * cells) - 1);
  return along(columns).flatMap((u) => along(rows).map((v): [number, number] => [u, v]));
}

/** East, north and up of a place, as rows. */
const ROTATION = Float64Array.of(-0.6, 0.8, 0, -0.48, -0.36, 0.8, 0.64, 0.48, 0.6);
const rotate = (vector: ArrayLike<number>) =>
  [0, 1, 2].map((row) => [0, 1, 2].reduce((sum, axis) => sum + ROTATION[3 * row + axis] * vector[axis], 0));

describe("what a grid adds to a node", () => {
  it("is interpolated between its nodes, and goes on beyond them as in the last cell", () => {
    fc.assert(
      fc.property(samples(4, true), places, (sample, all) => {
        for (const [u, v] of [...all, [1.5, -1.5], [-1.5, 1.5]]) {
          const [x, y] = at(sample, u, v);
          const out = Float64Array.of(10, 20, 30);
          addRemainder(sample.remainder, u, v, out);
          const expected = interpolated(sample, x, y);
          expect(apart(out, [10 + expected[0], 20 + expected[1], 30 + expected[2]])).toBeLessThan(1e-11);
        }
      }),
    );
  });

  it("turns with the axes", () => {
    fc.assert(
      fc.property(samples(3, true), places, ({ remainder }, all) => {
        const other = turned(remainder, ROTATION);
        for (const [u, v] of all) {
          const before = added((out) => addRemainder(remainder, u, v, out));
          const after = added((out) => addRemainder(other, u, v, out));
          expect(apart(after, rotate(before))).toBeLessThan(1e-12);
        }
      }),
    );
  });
});

describe("a relief", () => {
  it("is as far from the grid as it says: by what does not lie along up, and by bent positions", () => {
    fc.assert(
      fc.property(samples(4, true), places, (sample, all) => {
        const { relief, error } = reliefOf(sample.remainder);
        for (const [u, v] of [...all, ...lattice(sample)]) {
          const whole = added((out) => addRemainder(sample.remainder, u, v, out));
          const up = added((out) => addRelief(relief, u, v, out));
          expect([up[0], up[1]]).toEqual([0, 0]);
          expect(apart(whole, up)).toBeLessThanOrEqual(error + 1e-12);
        }
      }),
    );
  });

  it("is no farther from it than that: straight positions cost nothing", () => {
    fc.assert(
      fc.property(samples(4, false), (sample) => {
        const { relief, error } = reliefOf(sample.remainder);
        let worst = 0;
        for (const [u, v] of lattice(sample)) {
          const whole = added((out) => addRemainder(sample.remainder, u, v, out));
          const up = added((out) => addRelief(relief, u, v, out));
          worst = Math.max(worst, apart(whole, up));
          expect(up[2]).toBeCloseTo(whole[2], 11);
        }
        expect(error).toBeCloseTo(worst, 11);
      }),
    );
  });

  it("says what bends cost at most: slope times bend, of each direction", () => {
    // One cell that rises by 3 m from west to east in the north, by 1 m in the south, and by 5 m at most to the north.
    const nodes = Float64Array.of(0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 6);
    const bends = [
      [0.01, 0.02, -0.03, 0, 0, 0],
      [0, 0, 0, -0.04, 0.01, 0.005],
    ];
    const errors = bends.map(([a, b, c, d, e, f]) => {
      const position = Float64Array.of(0.5, 0.5, 0, a, b, c, 0.5, 0, 0.5, d, e, f);
      return reliefOf(remainderOf(nodes, 1, 1, position)).error;
    });
    expect(errors[0]).toBeCloseTo(3 * 0.06, 12);
    expect(errors[1]).toBeCloseTo(5 * 0.055, 12);
  });

  it("has cells up to a power of two, so that each look-up finds something", () => {
    fc.assert(
      fc.property(samples(4, true), ({ columns, rows, remainder }) => {
        const { length } = reliefOf(remainder).relief.cells;
        expect(Math.log2(length) % 1).toBe(0);
        expect(length).toBeGreaterThanOrEqual(4 * (columns + 1) * (rows + 1));
        expect(length).toBeLessThan(8 * (columns + 1) * (rows + 1));
      }),
    );
  });
});

/** What polynomial and creases add. */
function unfoldedAt(
  { polynomial, creases }: NonNullable<ReturnType<typeof unfoldAll>>,
  u: number,
  v: number,
) {
  const terms = [1, u, v, u * u, u * v, v * v];
  const own = added((out) => addCreases(creases, u, v, out));
  return own.map(
    (value, axis) =>
      value + terms.reduce((sum, term, i) => sum + term * polynomial[QUADRATIC_TERMS * axis + i], 0),
  );
}

describe("creases", () => {
  const few = samples(3, true).filter(({ columns, rows }) => columns + rows <= 4);

  it("are as good as the grid but for their error, which is seldom wider than that takes", () => {
    let [one, wide] = [0, 0];
    fc.assert(
      fc.property(few, places, (sample, all) => {
        const unfolded = unfoldAll([sample.remainder])!;
        let [off, reach] = [0, 0];
        for (const [u, v] of [...all, ...lattice(sample)]) {
          const whole = added((out) => addRemainder(sample.remainder, u, v, out));
          off = Math.max(off, apart(unfoldedAt(unfolded, u, v), whole));
          reach = Math.max(reach, Math.hypot(...added((out) => addCreases(unfolded.creases, u, v, out))));
        }
        expect(off).toBeLessThanOrEqual(unfolded.error + 1e-12);
        expect(reach).toBeLessThanOrEqual(unfolded.reach + 1e-12);
        // Its parts are added up, and now and then they cancel each other.
        if (unfolded.error > 4 * off + 1e-12) wide++;
        expect(unfolded.reach).toBeLessThanOrEqual(8 * reach + 1e-9);
        expect(unfolded.creases.lines).toHaveLength(3 * (sample.columns + sample.rows - 2));
        if (sample.columns + sample.rows === 2) one++;
      }),
      { numRuns: 200 },
    );
    expect(one).toBeGreaterThan(0);
    expect(wide).toBeLessThan(20);
  });

  it("turn with the axes", () => {
    fc.assert(
      fc.property(few, places, ({ remainder }, all) => {
        const { polynomial, creases, ...rest } = unfoldAll([remainder])!;
        const other = {
          ...rest,
          polynomial: turnedTerms(polynomial, QUADRATIC_TERMS, ROTATION),
          creases: turnedCreases(creases, ROTATION),
        };
        for (const [u, v] of all) {
          const before = unfoldedAt({ ...rest, polynomial, creases }, u, v);
          expect(apart(unfoldedAt(other, u, v), rotate(before))).toBeLessThan(1e-12);
        }
      }),
    );
  });

  it("of several grids are added up, as long as they have two lines together", () => {
    fc.assert(
      fc.property(few, few, places, (a, b, all) => {
        const [one, other, both] = [[a], [b], [a, b]].map((of) =>
          unfoldAll(of.map((sample) => sample.remainder)),
        );
        const lines = a.columns + a.rows + b.columns + b.rows - 4;
        expect(both === undefined).toBe(lines > 2);
        if (!both) return;
        expect([both.error, both.reach]).toEqual([one!.error + other!.error, one!.reach + other!.reach]);
        for (const [u, v] of all) {
          const sum = unfoldedAt(one!, u, v).map((value, axis) => value + unfoldedAt(other!, u, v)[axis]);
          expect(apart(unfoldedAt(both, u, v), sum)).toBeLessThan(1e-12);
        }
      }),
    );
  });

  it("are not made of a grid with more lines", () => {
    fc.assert(
      fc.property(samples(4, true), ({ columns, rows, remainder }) => {
        expect(unfoldAll([remainder]) === undefined).toBe(columns + rows > 4);
      }),
    );
  });
});
