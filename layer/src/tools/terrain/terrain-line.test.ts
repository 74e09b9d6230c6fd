import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { TerrainLine, type TerrainStatistic } from "./terrain-line.js";

/** By the definition: all heights of a station at once. */
function referee(heights: readonly number[], statistic: TerrainStatistic): number {
  const sorted = [...heights].sort((a, b) => a - b);
  if (statistic === "min") return sorted[0];
  if (statistic === "max") return sorted[sorted.length - 1];
  if (statistic === "mean") return heights.reduce((sum, height) => sum + height, 0) / heights.length;
  const at = ((sorted.length - 1) * statistic) / 100;
  const below = sorted[Math.floor(at)];
  return below + (at % 1) * (sorted[Math.ceil(at)] - below);
}

describe("a terrain line", () => {
  it("has the statistic of just the points of each station, in whatever order they come", () => {
    const points = fc.array(
      fc.tuple(fc.double({ min: 95, max: 125, noNaN: true }), fc.double({ min: -50, max: 900, noNaN: true })),
      { minLength: 1, maxLength: 60 },
    );
    const statistics = fc.oneof(
      fc.constantFrom<TerrainStatistic>("min", "max", "mean", 0, 50, 100),
      fc.double({ min: 0, max: 100, noNaN: true }),
    );
    fc.assert(
      fc.property(points, statistics, (all, statistic) => {
        const line = new TerrainLine(100, 120, { interval: 2.5, statistic });
        for (const [chainage, height] of all) line.add(chainage, height);
        const stations = line.stations();
        expect(stations).toHaveLength(9);
        for (const { chainage, height, least, greatest, count, deviation } of stations) {
          const own = all.filter(([at]) => at >= chainage - 1.25 && at < chainage + 1.25).map(([, z]) => z);
          expect(count).toBe(own.length);
          if (count === 0) expect(height).toBeNaN();
          else expect(height).toBeCloseTo(referee(own, statistic), 8);
          if (count > 0) expect([least, greatest]).toEqual([Math.min(...own), Math.max(...own)]);
          if (count < 2) expect(deviation).toBeNaN();
          else {
            const mean = referee(own, "mean");
            const square = own.reduce((sum, z) => sum + (z - mean) ** 2, 0) / (count - 1);
            expect(deviation).toBeCloseTo(Math.sqrt(square), 8);
          }
        }
      }),
    );
  });

  it("is not drawn through gaps", () => {
    const line = new TerrainLine(0, 6, { interval: 1, statistic: "mean" });
    for (const [chainage, height] of [
      [1, 10],
      [2.2, 11],
      [5, 9],
      [1.4, 12],
    ])
      line.add(chainage, height);
    expect(line.runs()).toEqual([
      [
        [1, 11],
        [2, 11],
      ],
      [[5, 9]],
    ]);
  });

  it("refuses intervals and percentiles that are none", () => {
    for (const interval of [0, -1, Number.NaN, 1e-9]) {
      expect(() => new TerrainLine(0, 1000, { interval })).toThrow("the interval of the terrain line");
    }
    expect(() => new TerrainLine(0, 10, { interval: 1, statistic: 101 })).toThrow(
      "there is no percentile 101",
    );
  });
});
