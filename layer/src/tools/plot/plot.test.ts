import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { TerrainStation } from "../terrain/terrain-line.js";
import { PlotIndex } from "./plot-index.js";
import { areaBetween, areaToDatum, distanceInPlot, gradesOf, leastClearance } from "./plot-measures.js";
import { PlotView } from "./plot-view.js";

const EXTENT = { from: 100, to: 300, low: 40, high: 60 };

function fitted(): PlotView {
  const view = new PlotView(800, 400);
  view.fit(EXTENT);
  return view;
}

describe("the view of a plot", () => {
  it("shows an extent whole, and keeps to it while the plot is resized", () => {
    const view = fitted();
    expect(view.shown).toEqual({ from: 100, to: 300, low: 39, high: 61 });
    view.resize(400, 300);
    expect(view.shown).toEqual({ from: 100, to: 300, low: 39, high: 61 });
    expect(view.pixelOf(200, 50)).toEqual([200, 150]);
  });

  it("keeps the place under the pointer while it zooms, and the exaggeration, within limits", () => {
    const moves = fc.array(
      fc.tuple(fc.nat(800), fc.nat(400), fc.double({ min: 0.01, max: 100, noNaN: true })),
      {
        maxLength: 12,
      },
    );
    fc.assert(
      fc.property(moves, (all) => {
        const view = fitted();
        const { exaggeration } = view;
        for (const [x, y, factor] of all) {
          const place = view.placeOf(x, y);
          view.zoomAt(x, y, factor);
          const [left, down] = view.pixelOf(...place);
          expect(left).toBeCloseTo(x, 3);
          expect(down).toBeCloseTo(y, 3);
          expect(view.exaggeration / exaggeration).toBeCloseTo(1, 6);
          expect(view.shown.to - view.shown.from).toBeLessThan(200 * 21);
        }
      }),
    );
  });

  it("zooms one axis alone, pans with the pointer, and stretches heights about the middle", () => {
    const view = fitted();
    view.zoomAt(0, 0, 2, "along");
    expect(view.shown).toEqual({ from: 100, to: 200, low: 39, high: 61 });
    view.zoomAt(0, 400, 2, "up");
    expect(view.shown).toEqual({ from: 100, to: 200, low: 39, high: 50 });
    view.panBy(80, 40);
    expect(view.shown).toEqual({ from: 90, to: 190, low: 40.1, high: 51.1 });
    view.exaggeration = 1;
    expect(view.shown.high - view.shown.low).toBeCloseTo(50, 9);
    expect((view.shown.high + view.shown.low) / 2).toBeCloseTo(45.6, 9);
    expect(view.exaggeration).toBeCloseTo(1, 12);
    view.resize(400, 400);
    expect(view.exaggeration).toBeCloseTo(1, 12);
    expect(view.shown.to).toBeCloseTo(140, 9);
    expect(() => {
      view.exaggeration = 0;
    }).toThrow(RangeError);
  });
});

it("the nearest point is that of all of them, in pixels", () => {
  const place = fc.tuple(
    fc.double({ min: 90, max: 310, noNaN: true }),
    fc.double({ min: 35, max: 65, noNaN: true }),
  );
  const parts = fc.array(fc.array(place, { maxLength: 40 }), { maxLength: 4 });
  fc.assert(
    fc.property(parts, fc.nat(800), fc.nat(400), fc.integer({ min: 1, max: 60 }), (all, x, y, reach) => {
      const view = fitted();
      const index = new PlotIndex();
      const squares: number[] = [];
      for (const points of all) {
        const chainage = Float64Array.from(points, ([along]) => along);
        index.add({ chainage, height: Float64Array.from(points, ([, up]) => up) });
        for (const [along, up] of points) {
          const [left, down] = view.pixelOf(along, up);
          squares.push((left - x) ** 2 + (down - y) ** 2);
        }
      }
      const least = Math.min(...squares);
      const found = index.nearest(view, x, y, reach);
      fc.pre(Math.abs(least - reach * reach) > 1e-6);
      if (least > reach * reach) expect(found).toBeUndefined();
      else {
        const [left, down] = view.pixelOf(
          found!.points.chainage[found!.index],
          found!.points.height[found!.index],
        );
        expect((left - x) ** 2 + (down - y) ** 2).toBeCloseTo(least, 6);
      }
    }),
  );
});

/** Stations every 2 from 0 on; NaN is a gap. */
const stationsOf = (heights: readonly number[], spread = 0): TerrainStation[] =>
  heights.map((height, at) => ({
    ...{ chainage: 2 * at, height, mean: height, least: height - spread, greatest: height + spread },
    ...{ deviation: Number.NaN, count: Number.isNaN(height) ? 0 : 1 },
  }));

describe("measuring in a plot", () => {
  it("distances have length, rise, slope and angle, in either direction", () => {
    expect(distanceInPlot([10, 5], [14, 8])).toEqual({
      ...{ along: 4, up: 3, slant: 5, grade: 0.75 },
      angle: Math.atan2(3, 4),
    });
    expect(distanceInPlot([14, 8], [10, 5])).toMatchObject({ along: -4, up: -3, grade: -0.75 });
    expect(distanceInPlot([0, 0], [0, 2]).grade).toBe(Number.POSITIVE_INFINITY);
    expect(distanceInPlot([0, 0], [0, 2]).angle).toBeCloseTo(Math.PI / 2, 12);
  });

  it("areas to a height are split where the ground crosses it, and cut at the chainages", () => {
    const ground = stationsOf([10, 14, 6, 6]);
    // Above 10: the triangles up to the peak and down to the crossing; below: from there on.
    const whole = areaToDatum(ground, 10, 0, 6);
    expect(whole.above).toBeCloseTo(4 + 2, 12);
    expect(whole.below).toBeCloseTo(2 + 8, 12);
    expect(whole.length).toBe(6);
    expect(areaToDatum(ground, 6, 5, 1)).toEqual({ above: 6 + 1 + 8 - 0, below: 0, length: 4 });
    expect(areaToDatum(stationsOf([1, Number.NaN, 1, 1]), 0, 0, 6)).toEqual({
      above: 2,
      below: 0,
      length: 2,
    });
  });

  it("areas between two surveys are fill above and cut below, and nothing over a gap of either", () => {
    const [before, after] = [stationsOf([0, 0, 0, 0, 0]), stationsOf([1, 1, -1, Number.NaN, 5])];
    expect(areaBetween(before, after)).toEqual({ above: 2.5, below: 0.5, length: 4 });
    expect(() => areaBetween(before, after.slice(1))).toThrow(RangeError);
  });

  it("clearance is the least between two classes, with its place", () => {
    const ground = stationsOf([0, 1, Number.NaN, 2], 0.25);
    const wire = stationsOf([12, 9, 1, 11], 0.5);
    expect(leastClearance(ground, wire)).toEqual({ chainage: 2, clearance: 9 - 0.5 - 1.25 });
    expect(leastClearance(ground, stationsOf([Number.NaN, Number.NaN, 1, Number.NaN]))).toBeUndefined();
  });

  it("grades go from station to station, not over gaps", () => {
    expect(gradesOf(stationsOf([0, 1, Number.NaN, 2, 1]))).toEqual([0.5, Number.NaN, Number.NaN, -0.5]);
  });
});
