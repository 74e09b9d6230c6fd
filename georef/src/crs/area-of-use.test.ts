import { describe, expect, it } from "vitest";
import { areaOf, areOverlapping, countriesIn, distanceTo, extentOf, isInside } from "./area-of-use.js";

const NETHERLANDS = [3.2, 50.75, 7.22, 53.7] as const;
const FIJI = [172, -25, -175, -10] as const;
const at = (longitude: number, latitude: number) => ({ longitude, latitude });

describe("an area of use", () => {
  it("holds its edges, and places given in another turn", () => {
    expect(isInside(NETHERLANDS, at(3.2, 53.7))).toBe(true);
    expect(isInside(NETHERLANDS, at(5 - 360, 52))).toBe(true);
    expect(isInside(NETHERLANDS, at(5, 53.8))).toBe(false);
    expect(isInside(NETHERLANDS, at(3.1, 52))).toBe(false);
  });

  it("may lie across the antimeridian", () => {
    expect([179, -179, 185].map((longitude) => isInside(FIJI, at(longitude, -17)))).toEqual([
      true,
      true,
      true,
    ]);
    expect(isInside(FIJI, at(-170, -17))).toBe(false);
    expect(extentOf(FIJI)).toBe(13 * 15);
  });

  it("is read from a row of the table, if it has one", () => {
    expect(areaOf({ bbox: [53.7, 3.2, 50.75, 7.22] })).toEqual(NETHERLANDS);
    expect(areaOf({})).toBeUndefined();
    expect(areaOf({ bbox: [1, 2, 3, Number.NaN] })).toBeUndefined();
  });

  it.each([
    ["Netherlands - onshore and offshore.", ["Netherlands"]],
    ["Liechtenstein; Switzerland.", ["Liechtenstein", "Switzerland"]],
    ["Europe between 6°E and 12°E: Austria; Germany - onshore and offshore.", ["Austria", "Germany"]],
    ["Mexico - onshore. United States (USA) - CONUS and Alaska - Alabama.", ["Mexico", "United States"]],
    ["Europe - onshore - Andorra; Gibraltar, Hungary; Spain - mainland.", ["Andorra", "Gibraltar", "Spain"]],
    ["Austria east of 14°50'E of Greenwich (32°30'E of Ferro).", ["Austria"]],
    ["", []],
  ])("names its countries: %s", (text, countries) => {
    expect(countriesIn(text)).toEqual(countries);
  });

  it("overlaps another one", () => {
    expect(areOverlapping(NETHERLANDS, [6, 38, 12, 84])).toBe(true);
    expect(areOverlapping([6, 38, 12, 84], NETHERLANDS)).toBe(true);
    expect(areOverlapping(NETHERLANDS, [12, 38, 18, 84])).toBe(false);
    expect(areOverlapping(FIJI, [-178, -20, -170, -5])).toBe(true);
    expect(areOverlapping(FIJI, [-180, -90, 180, 90])).toBe(true);
  });

  it("has a distance: along a meridian, along the equator, round the antimeridian", () => {
    const degree = (Math.PI / 180) * 6_371_008.8;
    expect(distanceTo(NETHERLANDS, at(5, 52))).toBe(0);
    expect(distanceTo(NETHERLANDS, at(5, 4.06))).toBeCloseTo((50.75 - 4.06) * degree, 3);
    expect(distanceTo([0, -10, 10, 10], at(12, 0))).toBeCloseTo(2 * degree, 3);
    expect(distanceTo(FIJI, at(-174, -17))).toBeLessThan(degree);
    // From beside an area the nearest point of its edge is not on the same parallel.
    expect(distanceTo([0, 0, 10, 80], at(60, 70))).toBeLessThan(distanceTo([0, 0, 10, 70], at(60, 70)));
  });
});
