import { describe, expect, it } from "vitest";
import * as georef from "../index.js";
import { type ControlPoint, GromaError } from "../index.js";

/** Called for each point, with numbers and typed arrays: no call of them may cost more than its arithmetic. */
const FOR_EACH_POINT = [
  ...["coordinate", "cross", "difference", "dot", "unit", "ecefToGeodetic", "geodeticToEcef", "place"],
  ...["placeIntegers", "placePoint", "pointIn", "pointOf", "turnIn", "turnOut", "printable"],
];
/** They take what other functions of this package give, never what a user or a file has given. */
const BETWEEN_OTHERS = [
  ...["areOverlapping", "areaOf", "areaOfDomain", "aroundPoints", "boundsInWords", "boundsOfPlaces"],
  ...["countriesIn", "cutWindow", "distanceTo", "domainAround", "domainOf", "eastNorthUp", "egm96Step"],
  ...[
    "everyStep",
    "extentOf",
    "guessHeight",
    "isAboveGeoid",
    "isAboveOwnEllipsoid",
    "isInside",
    "isOwnPlane",
    "levelFrame",
  ],
  ...["ownLevel", "ownLevelNote", "pointTransform", "publishedAccuracy", "requireSame", "sourceTransform"],
  ...["spread", "truthOnMap", "truthOnWebMercator", "undulationOf", "withHeights", "withWorthThere"],
];

const exported = Object.entries(georef).flatMap(([name, value]) => {
  if (typeof value !== "function" || /^class /.test(Function.prototype.toString.call(value))) return [];
  return [[name, value as (...given: unknown[]) => unknown] as const];
});
const checked = exported.filter(([name]) => ![...FOR_EACH_POINT, ...BETWEEN_OTHERS].includes(name));

describe("wrong arguments", () => {
  it("are looked for in most functions, and the others are named here", () => {
    const names = exported.map(([name]) => name);
    expect(names).toEqual(expect.arrayContaining([...FOR_EACH_POINT, ...BETWEEN_OTHERS]));
    expect(checked.length).toBeGreaterThan(45);
  });

  it.each(checked)("are no TypeError in %s", async (_name, call) => {
    for (const given of [undefined, null, {}, Number.NaN, "", [], () => 0]) {
      try {
        await call(given);
      } catch (error) {
        expect(error, String(error)).toBeInstanceOf(GromaError);
      }
    }
  });

  it.each([
    [
      "resolveCrs",
      () => georef.resolveCrs(undefined as never),
      "resolveWithNotes: sources",
      "it is undefined, and has to be an object",
    ],
    [
      "decodeRecord",
      () => georef.decodeRecord(null as never, "a.laz"),
      "decodeRecord: bytes",
      "it is null, and has to be a Uint8Array",
    ],
    [
      "anchorSimilarity",
      () => georef.anchorSimilarity({} as never),
      "anchorSimilarity: anchor.longitude",
      "it is undefined, and has to be a finite number",
    ],
    [
      "a CRS as text",
      () => georef.exactTransform("EPSG:2056" as never),
      "exactTransform: crs",
      "it is EPSG:2056, and has to be an object",
    ],
    [
      "a list of texts",
      () => georef.fitPlane(["1"] as never),
      "fitPlane: points",
      "it is an array, and has to be an array of numbers",
    ],
  ])("are told by name: %s", (_, call, file, cause) => {
    expect(call).toThrow(
      expect.objectContaining({ name: "ArgumentError", code: "ARGUMENT_INVALID", file, cause }),
    );
  });

  it("are none where a field may be left out", () => {
    const points: ControlPoint[] = [];
    expect(() => georef.fitSimilarity(points, "control.txt")).toThrow("CONTROL_TOO_FEW");
    expect(() => georef.resolveCrs({ file: "a.laz" })).toThrow("CRS_MISSING");
  });
});
