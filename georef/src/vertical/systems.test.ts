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

  /** Each in the middle of its area, with a horizontal system that EPSG joins it with: it would come first. */
  it.each([
    [9303, "HS2-VRF height"],
    [9923, "GNTRANS height"],
    [9927, "GNTRANS2016 height"],
    [5597, "FCSVR10 height"],
  ])("leaves out the system of one railway or tunnel: %i, %s", (code, name) => {
    const own = systems.find((system) => system.code === code)!;
    expect(own.name).toBe(name);
    const [west, south, east, north] = own.area;
    const place = { longitude: (west + east) / 2, latitude: (south + north) / 2 };
    const clues = { ...place, unit: 1, horizontal: own.partners[0] };
    const names = likelySystems(systems, clues).map((system) => system.name);
    expect(names).not.toContain(name);
    expect(names.length).toBeGreaterThan(0);
    expect(likelySystems([{ ...own, code: 1 }], clues)).toHaveLength(1);
  });

  // In the corner of a country's rectangle, where those of its neighbours overlap.
  it.each([
    ["Basel", 7.6, 47.56, ["Switzerland"], ["France", "Germany"]],
    ["Geneva", 6.14, 46.2, ["Switzerland"], ["France"]],
    ["Salzburg", 13, 47.8, ["Austria"], ["Germany", "Czechia"]],
  ])("leaves out those of neighbours where the plane system is a country's: %s", (_, x, y, own, others) => {
    const place = { longitude: x, latitude: y, unit: 1 };
    const countries = (of?: readonly string[]) =>
      likelySystems(systems, { ...place, countries: of }).map((system) => system.countries);
    const foreign = (all: readonly (readonly string[])[]) =>
      all.filter((of) => !own.some((country) => of.includes(country)));
    // Without that clue, and with a system of many countries, such as a zone of UTM, they are there.
    for (const vague of [undefined, [], [...own, "A", "B", "C"]]) {
      expect(foreign(countries(vague)).flat()).toEqual(expect.arrayContaining(others));
    }
    expect(foreign(countries(own))).toEqual([]);
    expect(countries(own).length).toBeGreaterThan(0);
    // As many countries as may still share it.
    expect(foreign(countries([...own, "A", "B"]))).toEqual([]);
  });

  it("keeps a system of no country in particular", () => {
    const [system] = systems.filter(({ name }) => name === "LN02 height");
    const clues = { longitude: 8, latitude: 47, unit: 1, countries: ["Germany"] };
    expect(likelySystems([system], clues)).toEqual([]);
    expect(likelySystems([{ ...system, countries: [] }], clues)).toHaveLength(1);
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

  it("has depths that count downwards, and knows no horizontal system", () => {
    const given = "+proj=longlat +ellps=WGS84 +towgs84=0,0,0";
    const own = resolveCrs({ file: "a", given, givenVertical: "EPSG:5861" }, lookup);
    expect(own).toMatchObject({ verticalUnit: { size: -1 }, height: { model: "LAT depth" } });
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
      "shown as ellipsoidal; if the heights are above sea level, such as NAVD88 height (ft) (EPSG:8228), the points should be 22.4 m lower",
    );
  });
});
