import { describe, expect, it } from "vitest";
import { type CrsSources, resolveWithNotes } from "../index.js";
import { lookup } from "./epsg-table.fixture.js";

const NAVD88 = "EPSG:5703";
const NAVD88_FEET = "EPSG:8228";
const NAVD88_SURVEY_FEET = "EPSG:6360";
const FOOT = 0.3048;
const SURVEY_FOOT = 1200 / 3937;
const METRE_PLANE = "EPSG:26918";
const FOOT_PLANE = "EPSG:2994";
const DEGREES = "EPSG:4326";
/** A file whose z is in survey feet, whatever else it says. */
const IN_SURVEY_FEET = `COMPD_CS["UTM 18N, feet",${lookup(26918)!.wkt!},${lookup(6360)!.wkt!}]`;

function read(sources: Omit<CrsSources, "file">) {
  const { crs, notes } = resolveWithNotes({ file: "scan.las", ...sources }, lookup);
  return { crs, notes: notes.map(({ code, text }) => `${code} ${text}`) };
}

describe("a given height system changes the reference, not silently the unit", () => {
  it.each([
    [
      "one in metres",
      { givenVertical: NAVD88 },
      /z stays in US survey foot, .*NAVD88 height itself is in metre/,
    ],
    ["one in other feet", { givenVertical: NAVD88_FEET }, /stays in US survey foot, .* itself is in foot/],
    [
      "the ellipsoid",
      { givenVertical: "ellipsoidal" },
      /^CRS_HEIGHT_UNIT z stays in US survey foot, as declared$/,
    ],
    [
      "with a plane",
      { given: METRE_PLANE, givenVertical: NAVD88 },
      /If z is in metre, .*\(EPSG:26918\+5703\)/,
    ],
    [
      "the ellipsoid with a plane",
      { given: METRE_PLANE, givenVertical: "ellipsoidal" },
      /stays in US survey/,
    ],
  ])("of a file that declares one: %s", (_, given, note) => {
    const { crs, notes } = read({ wkt: IN_SURVEY_FEET, ...given });
    expect(crs.verticalUnit).toMatchObject({ size: SURVEY_FOOT, declared: true });
    expect(notes).toEqual([expect.stringMatching(note)]);
  });

  it("of an earlier conversion", () => {
    const recordedHeights = read({ given: "EPSG:26918+6360" }).crs;
    const { crs } = read({ given: METRE_PLANE, givenVertical: NAVD88, recordedHeights });
    expect([crs.height.kind, crs.verticalUnit.size]).toEqual(["geoid", SURVEY_FOOT]);
  });

  it.each([
    [
      "the plane's feet stay, of a system in metres",
      FOOT_PLANE,
      NAVD88,
      FOOT,
      false,
      /taken in foot, .*plane/,
    ],
    [
      "and of the ellipsoid",
      FOOT_PLANE,
      "ellipsoidal",
      FOOT,
      false,
      /taken in foot, .*plane, since none is declared$/,
    ],
    [
      "a system in feet says feet",
      METRE_PLANE,
      NAVD88_SURVEY_FEET,
      SURVEY_FOOT,
      true,
      /taken in US survey foot, the unit of NAVD88/,
    ],
    ["in degrees too", DEGREES, NAVD88_FEET, FOOT, true, /taken in foot, the unit of NAVD88/],
  ])("where none is declared: %s", (_, plane, givenVertical, size, declared, note) => {
    const { crs, notes } = read({ given: plane, givenVertical });
    expect(crs.verticalUnit.size).toBeCloseTo(size, 12);
    expect([crs.verticalUnit.declared, notes]).toEqual([declared, [expect.stringMatching(note)]]);
  });

  it.each([
    [METRE_PLANE, NAVD88, 1],
    [FOOT_PLANE, NAVD88_FEET, FOOT],
    [DEGREES, NAVD88, 1],
    [METRE_PLANE, "ellipsoidal", 1],
  ])("is silent where there is no question: %s, %s", (given, givenVertical, size) => {
    const { crs, notes } = read({ given, givenVertical });
    expect([crs.verticalUnit.size, notes]).toEqual([size, []]);
  });

  it("gives way to a system of plane and heights", () => {
    const { crs, notes } = read({ wkt: IN_SURVEY_FEET, given: "EPSG:26918+5703" });
    expect([crs.verticalUnit.size, notes]).toEqual([1, []]);
  });
});

describe("the code of the plane", () => {
  it.each([
    ["heights above the ellipsoid", { given: METRE_PLANE, givenVertical: "ellipsoidal" }],
    ["of a file with heights", { wkt: IN_SURVEY_FEET, givenVertical: "ellipsoidal" }],
    [
      "a unit alone",
      {
        wkt: `COMPD_CS["a",${lookup(26918)!.wkt!},VERT_CS["b",VERT_DATUM["unknown",2005],UNIT["foot",0.3048]]]`,
      },
    ],
    [
      "heights by a grid",
      {
        wkt: `COMPD_CS["a",${lookup(26918)!.wkt!},VERT_CS["b",VERT_DATUM["c",2005,EXTENSION["PROJ4_GRIDS","g.gtx"]],UNIT["metre",1]]]`,
      },
    ],
  ])("stays: %s", (_, sources) => {
    expect(read(sources).crs.code).toBe(METRE_PLANE);
  });
});
