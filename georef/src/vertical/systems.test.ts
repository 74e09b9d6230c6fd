import { createRequire } from "node:module";
import { describe, expect, it } from "vitest";
import {
  type EpsgRow,
  egm96Grid,
  guessHeight,
  likelySystems,
  resolveCrs,
  verticalLookup,
  verticalSystems,
} from "../index.js";

const table = createRequire(import.meta.url)("epsg-index/all.json") as Record<string, EpsgRow>;
const systems = verticalSystems(Object.values(table));

const FOOT = 0.3048;
/** Place, unit of z, horizontal code, and what its maps are most likely above. */
const PLACES: readonly (readonly [string, number, number, number, number | undefined, string])[] = [
  ["Oregon in feet", -123.07, 44.05, FOOT, 2994, "NAVD88 height (ft)"],
  ["New York in survey feet", -74, 41, 0.3048006096, undefined, "NAVD88 height (ftUS)"],
  ["the Netherlands", 5.2, 52.1, 1, 28992, "NAP height"],
  ["Switzerland", 8.5, 47.3, 1, 2056, "LN02 height"],
  ["Bavaria", 11, 48, 1, 25832, "DHHN92 height"],
  ["Great Britain", -1.5, 52, 1, 27700, "ODN height"],
  ["France", 2, 47, 1, undefined, "NGF-IGN69 height"],
  ["Australia", 151, -33.8, 1, undefined, "AHD height"],
];

describe("likelySystems", () => {
  it.each(PLACES)("in %s", (_, longitude, latitude, unit, horizontal, expected) => {
    const likely = likelySystems(systems, { longitude, latitude, unit, horizontal });
    expect(likely[0]?.name).toBe(expected);
    expect(likely.length).toBeLessThanOrEqual(5);
    expect(likely.some(({ depth }) => depth)).toBe(false);
  });

  it("says nothing where EPSG has no system, and finds areas across the antimeridian", () => {
    const at = (longitude: number, latitude: number) =>
      likelySystems(systems, { longitude, latitude, unit: 1 }).map(({ name }) => name);
    expect(at(-30, -40)).toEqual([]);
    expect(at(178, -18)).toEqual(at(178 - 360, -18));
    expect(at(178, -38)).toContain("NZVD2016 height");
  });
});

describe("verticalLookup", () => {
  const lookup = verticalLookup(systems);

  it.each([
    ["EPSG:5728", "LN02 height", 1],
    ["EPSG:8228", "NAVD88 height (ft)", FOOT],
    ["EPSG:6360", "NAVD88 height (ftUS)", 0.304800609601219],
  ])("knows %s as the whole table does", (givenVertical, model, size) => {
    const given = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0";
    const own = resolveCrs({ file: "a", given, givenVertical }, lookup);
    expect(own).toEqual(resolveCrs({ file: "a", given, givenVertical }, (code) => table[code]));
    expect(own.height).toMatchObject({ kind: "geoid", model });
    expect(own.verticalUnit.size).toBeCloseTo(size, 12);
  });

  it("refuses depths by name, and knows no horizontal system", () => {
    const given = "+proj=longlat +ellps=WGS84 +towgs84=0,0,0";
    expect(() => resolveCrs({ file: "a", given, givenVertical: "EPSG:5861" }, lookup)).toThrow(
      expect.objectContaining({ code: "CRS_UNSUPPORTED", cause: expect.stringContaining("LAT depth") }),
    );
    expect(lookup(2056)).toBeUndefined();
  });
});

describe("guessHeight", () => {
  it("says what is at stake, and which system", () => {
    const oregon = {
      code: "EPSG:2994",
      verticalUnit: { name: "foot", kind: "linear", size: FOOT, declared: false },
    } as const;
    const guess = guessHeight(
      egm96Grid(() => -22.4),
      systems,
      oregon,
      -2.148,
      0.769,
    );
    expect(guess.undulation).toBeCloseTo(-22.4, 6);
    expect(guess.note).toBe(
      "shown as ellipsoidal; if the heights are above sea level, such as NAVD88 height (ft) (EPSG:8228), the points belong 22.4 m lower",
    );
  });
});
