import { EGM96, type OperationReport, resolveCrs } from "@groma/georef";
import { expect, it } from "vitest";
import { accuracyInWords, placeInWords, remarks } from "./describe.js";
import { epsg } from "./epsg.js";

const report: OperationReport = {
  ...{ name: "a way", accuracy: null, ballpark: false, grids: [EGM96], worstDifference: 0, notes: [] },
  lacking: [
    { name: "by the geoid", accuracy: null, grids: ["nl_nsgi_nlgeo2018.tif"] },
    { name: "by the shift", accuracy: 0.5, grids: ["nl_nsgi_rdtrans2018.tif"] },
  ],
};
const crs = resolveCrs({ file: "scan.las", given: "EPSG:28992+5709" }, epsg);

it("what is lacking is called more accurate only where that is published", () => {
  const [geoid, shift, way] = remarks(report);
  expect(geoid).toBe(
    "with nl_nsgi_nlgeo2018.tif, the country's own geoid is used; its accuracy is not published: by the geoid",
  );
  expect(shift).toBe("more accurate with nl_nsgi_rdtrans2018.tif: by the shift (50 cm)");
  expect(way).toMatch(/^missing grids: get them with `projsync --file nl_nsgi_nlgeo2018.tif`, /);
});

it("a ballpark is a missing transformation", () => {
  const engine = { name: "PROJ", version: "9" } as const;
  const place = { crs, engine, operation: { ...report, ballpark: true }, fitBound: undefined, accuracy: [] };
  expect(placeInWords(place)).toMatch(/, no datum transformation available$/);
});

it("an unknown total says which system is out of its place", () => {
  const parts = [{ name: "height", metres: null, note: "LN02 height: not in use at this place" }];
  expect(accuracyInWords(parts, crs)).toBe("total accuracy unknown: height system not in use at this place");
  const doubted = { height: { kind: "ellipsoidal", doubt: "declared as shifted" } } as const;
  expect(accuracyInWords(parts, doubted)).toBe("total accuracy unknown: heights declared as shifted");
});
