import { extentOf } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { Operation } from "./operation.js";
import { holds, type Proposal, takenAreas } from "./taken-areas.js";

const WITHIN = { minX: 0, minY: 0, maxX: 30, maxY: 30 };

/** A proposal for longitudes and latitudes that are its source coordinates too. */
function proposal(
  accuracy: number | null,
  [x, y, width, height]: readonly number[],
  area = "somewhere",
): Proposal {
  const operation: Operation = { name: "of one name", accuracy, area, ballpark: false, missingGrids: [] };
  const [maxX, maxY] = [x! + width!, y! + height!];
  return { operation, area: [x!, y!, maxX, maxY], areas: [{ minX: x!, minY: y!, maxX, maxY }] };
}

/** Which of the proposals is taken at a point, by their number. */
function takenAt(list: readonly Proposal[], x: number, y: number): number {
  const found = takenAreas(list, WITHIN).find(({ areas }) => areas.some((area) => holds(area, x, y)));
  return list.findIndex(({ operation }) => operation === found?.operation);
}

const WIDE = [0, 0, 20, 20];
const SMALL = [4, 4, 8, 8];

describe("where PROJ takes which operation", () => {
  it.each([
    ["the more accurate", [proposal(1, SMALL), proposal(0.5, WIDE)], 1],
    ["of equals that for the smaller area", [proposal(1, WIDE), proposal(1, SMALL)], 1],
    ["of equals the first, if it is for the smaller area", [proposal(1, SMALL), proposal(1, WIDE)], 0],
    ["of two unknown ones that for the smaller area", [proposal(null, WIDE), proposal(null, SMALL)], 1],
    ["an unknown one that is listed first", [proposal(null, WIDE), proposal(1, SMALL)], 0],
    ["a known one that is listed first", [proposal(1, WIDE), proposal(null, SMALL)], 0],
    ["none for the sea later", [proposal(1, WIDE), proposal(0.5, SMALL, "France - offshore")], 0],
    [
      "one for the sea that is listed first",
      [proposal(0.5, SMALL, "France - offshore"), proposal(1, WIDE)],
      0,
    ],
    ["no area without a name", [proposal(1, WIDE), proposal(1, SMALL, "unknown domain of validity")], 0],
    ["nothing beyond all of them", [proposal(1, [20, 20, 5, 5])], -1],
  ])("%s", (_, list, expected) => {
    expect(takenAt(list, 6, 6)).toBe(expected);
  });

  it("goes on with worse ones behind one for the sea (ED50)", () => {
    const europe = proposal(10, [0, 0, 30, 30]);
    const north = proposal(6, [0, 0, 20, 20]);
    const sea = proposal(1, [0, 0, 10, 10], "North Sea - offshore");
    const france = proposal(2, [0, 0, 15, 15]);
    const list = [europe, north, sea, france];
    expect([5, 12, 18, 25].map((at) => takenAt(list, at, at))).toEqual([3, 3, 1, 0]);
    expect(takenAreas(list, WITHIN)).toHaveLength(4);
  });

  it("is as PROJ's loop over its list has it, for any list and any point", () => {
    const side = fc.integer({ min: 1, max: 20 });
    const one = fc
      .tuple(
        fc.constantFrom(null, 0.5, 1, 2),
        fc.tuple(fc.nat(20), fc.nat(20), side, side),
        fc.constantFrom("a", "a", "a", "b - offshore", "unknown domain of validity"),
      )
      .map((parts) => proposal(...parts));
    const point = fc.nat(59).map((i) => i / 2 + 0.25);
    fc.assert(
      fc.property(fc.array(one, { minLength: 1, maxLength: 7 }), point, point, (list, x, y) => {
        let best: Proposal | undefined;
        for (const next of list) {
          if (!next.areas.some((area) => holds(area, x, y))) continue;
          const [worth, than] = [next.operation.accuracy ?? -1, best?.operation.accuracy ?? -1];
          const nameless = (which: Proposal) => which.operation.area.startsWith("unknown");
          const better =
            !best ||
            (((worth >= 0 && worth < than) ||
              (worth === than &&
                extentOf(next.area) < extentOf(best.area) &&
                !(nameless(next) && !nameless(best)))) &&
              !next.operation.area.includes("offshore"));
          if (better) best = next;
        }
        expect(takenAt(list, x, y)).toBe(best ? list.indexOf(best) : -1);
      }),
      { numRuns: 500 },
    );
  });
});
