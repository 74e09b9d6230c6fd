import { describe, expect, it } from "vitest";
import { DATUM_AREAS } from "./datum-areas.js";
import { DATUM_SPREAD } from "./datum-spread.js";
import { DATUM_SHIFTS, findDatumShift } from "./datum-table.js";
import { resolveCrs } from "./resolve.js";
import { accuracyIn, publishedAccuracy, shiftAccuracy } from "./shift-worth.js";

const NAD27 = findDatumShift("NAD27", 6267)!;
const ALASKA = [-159.5, 56, -159, 56.5] as const;
const KANSAS = [-99, 38, -98, 39] as const;

describe("what the one shift of a datum is worth", () => {
  it("is more than published where other operations hold, by the place", () => {
    // EPSG:1176, "NAD27 to WGS 84 (7)", lies 25.5 m away there and is published with 12 m.
    expect(shiftAccuracy(NAD27, ALASKA)).toBeGreaterThan(37.5);
    expect(shiftAccuracy(NAD27, KANSAS)).toBeLessThan(20);
    expect(shiftAccuracy(NAD27)).toBeGreaterThanOrEqual(shiftAccuracy(NAD27, ALASKA));
  });

  it("is the greatest of all where the place is in none of the parts", () => {
    expect(shiftAccuracy(NAD27, [10, -50, 11, -49])).toBe(shiftAccuracy(NAD27));
  });

  it("is never less than published", () => {
    for (const [code, parts] of DATUM_SPREAD) {
      const published = findDatumShift("", code)!.accuracy;
      for (const [, , , , metres] of parts) expect(metres).toBeGreaterThanOrEqual(published);
    }
  });

  it("is the published accuracy of a datum with one operation", () => {
    expect(shiftAccuracy({ code: 6150, accuracy: 1 }, [7, 46, 8, 47])).toBe(1);
  });
});

describe("the accuracy of a CRS", () => {
  const wkt = `GEOGCS["NAD27",DATUM["North_American_Datum_1927",SPHEROID["Clarke 1866",6378206.4,294.978698213898],AUTHORITY["EPSG","6267"]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4267"]]`;
  const datum = resolveCrs({ file: "scan.las", wkt }).datum!;

  it("counts for all of its datum's area as long as no place is known", () => {
    expect(datum.accuracy).toBe(shiftAccuracy(NAD27));
    expect(publishedAccuracy(datum)).toBe(10);
  });

  it("counts for the place of a data set where that is known", () => {
    expect(accuracyIn(datum, KANSAS)).toBe(shiftAccuracy(NAD27, KANSAS));
    expect(accuracyIn(datum, undefined)).toBe(shiftAccuracy(NAD27));
    expect(accuracyIn({ operation: "its own", accuracy: null }, KANSAS)).toBeNull();
  });

  it("is not known outside of its datum's area, which every datum with a shift has", () => {
    expect(accuracyIn(datum, [5, 52, 6, 53])).toBeNull();
    for (const { code } of DATUM_SHIFTS) expect(DATUM_AREAS.has(code), `${code}`).toBe(true);
  });
});
