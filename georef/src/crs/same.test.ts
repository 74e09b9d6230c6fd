import { describe, expect, it } from "vitest";
import type { Crs } from "./crs.js";
import { sameHeights, samePlane } from "./same.js";

const METRE = { name: "metre", kind: "linear", size: 1 } as const;
const crs = (proj4: string, more: Partial<Crs> = {}): Crs => ({
  ...{ name: "a", proj4, horizontalUnit: METRE, verticalUnit: { ...METRE, declared: false } },
  ...{ height: { kind: "unknown" }, ...more },
});
const UTM =
  "+proj=tmerc +lat_0=0 +lon_0=9 +k=0.9996 +x_0=500000 +y_0=0 +a=6378137 +rf=298.257222101 +no_defs";

describe("samePlane", () => {
  it("compares numbers, not spellings", () => {
    expect(samePlane(crs(UTM), crs(UTM.replace("298.257222101", "298.257222101004")))).toBe(true);
    expect(samePlane(crs(UTM), crs(`${UTM} +type=crs`.replace("+lat_0=0", "+lat_0=0.0")))).toBe(true);
  });

  it.each([
    ["another zone", "+lon_0=9", "+lon_0=15"],
    ["a metre of false easting", "+x_0=500000", "+x_0=500001"],
    ["the other ellipsoid", "298.257222101", "298.257223563"],
    ["a meridian", "+no_defs", "+pm=2.337 +no_defs"],
  ])("tells %s", (_, from, to) => {
    expect(samePlane(crs(UTM), crs(UTM.replace(from, to)))).toBe(false);
  });

  it("tells units and datums apart", () => {
    const foot = { name: "foot", kind: "linear", size: 0.3048 } as const;
    expect(samePlane(crs(UTM), crs(UTM, { horizontalUnit: foot }))).toBe(false);
    const shifted = (shift: string, code: string) =>
      crs(`${UTM} +towgs84=${shift}`, { code, datum: { operation: shift, accuracy: 1 } });
    expect(samePlane(shifted("1,2,3", "EPSG:25832"), shifted("1,2,4", "EPSG:25832+7837"))).toBe(true);
    expect(samePlane(shifted("1,2,3", "EPSG:25832"), shifted("1,2,4", "EPSG:32632"))).toBe(false);
    expect(samePlane(crs(`${UTM} +towgs84=1,2,3`), crs(`${UTM} +towgs84=1,2,3,0,0,0,0`))).toBe(true);
    expect(samePlane(crs(`${UTM} +towgs84=1,2,3`), crs(`${UTM} +towgs84=1,2,3,0,0,1,0`))).toBe(false);
    const datum = (operation: string) => crs(UTM, { datum: { operation, accuracy: 1 } });
    expect(samePlane(datum("NAD83 to WGS 84"), datum("NAD83(2011) to WGS 84"))).toBe(false);
  });
});

describe("sameHeights", () => {
  const above = (model: string, epsg?: number) =>
    crs(UTM, { height: { kind: "geoid", model, ...(epsg !== undefined && { epsg }) } });

  it("goes by codes, else by names", () => {
    expect(sameHeights(above("NAP height", 5709), above("Normaal Amsterdams Peil", 5709))).toBe(true);
    expect(sameHeights(above("NAP height", 5709), above("NAP height", 5703))).toBe(false);
    expect(sameHeights(above("NAP height", 5709), above("NAP_Height"))).toBe(true);
    expect(sameHeights(above("NAP height"), crs(UTM))).toBe(false);
  });

  it("minds the unit, not how many digits a foot has", () => {
    const feet = (size: number) =>
      crs(UTM, { verticalUnit: { name: "foot", kind: "linear", size, declared: true } });
    expect(sameHeights(feet(1200 / 3937), feet(0.3048006))).toBe(true);
    expect(sameHeights(feet(1200 / 3937), feet(0.3048))).toBe(false);
  });
});
