import { resolveCrs, resolveWithNotes, sameHeights, samePlane } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { epsg } from "./epsg.js";
import type { Georeferenced } from "./georeference.js";
import { outputWkt } from "./output-wkt.js";

const UTM32 = epsg(25832)!.wkt!;
const WKT2 =
  'PROJCRS["RD",BASEGEOGCRS["Amersfoort",DATUM["Amersfoort",ELLIPSOID["Bessel 1841",6377397.155,299.1528128]]],CONVERSION["RD",METHOD["Oblique Stereographic"],PARAMETER["Latitude of natural origin",52.1561605555556],PARAMETER["Longitude of natural origin",5.38763888888889],PARAMETER["Scale factor at natural origin",0.9999079],PARAMETER["False easting",155000],PARAMETER["False northing",463000]],CS[Cartesian,2],AXIS["x",east],AXIS["y",north],LENGTHUNIT["metre",1]]';
const AWKWARD = `COMPD_CS["a ] [ ""b""",${UTM32},${epsg(5783)!.wkt}]`;
const OWN = `COMPD_CS["a",${epsg(21781)!.wkt},VERT_CS["e",VERT_DATUM["Ellipsoid",2002],UNIT["metre",1],AXIS["Up",UP]]]`;

function settled(sources: Omit<Parameters<typeof resolveWithNotes>[0], "file">): Georeferenced {
  return resolveWithNotes({ file: "scan.las", ...sources }, epsg);
}

describe("the WKT of an output", () => {
  it.each([
    ["a code", { given: "EPSG:25832" }],
    ["two codes", { given: "EPSG:28992+5709" }],
    ["a compound code", { given: "EPSG:7415" }],
    ["the WKT of the file", { wkt: UTM32 }],
    ["a height system added to it", { wkt: UTM32, givenVertical: "EPSG:7837" }],
    ["a height system that replaces that of the file", { wkt: AWKWARD, givenVertical: "EPSG:7837" }],
    ["heights above the ellipsoid", { wkt: UTM32, givenVertical: "ellipsoidal" }],
    ["heights above the ellipsoid of the plane's datum", { wkt: OWN }],
    ["WKT 2 with a height system", { wkt: WKT2, givenVertical: "EPSG:5709" }],
    ["depths", { given: "EPSG:25832", givenVertical: "EPSG:5861" }],
    ["depths in feet, by codes", { given: "EPSG:26918+6358" }],
    ["depths in the feet of the plane", { given: "EPSG:2994", givenVertical: "EPSG:5715" }],
    ["WKT 2 with depths", { wkt: WKT2, givenVertical: "EPSG:5715" }],
    [
      "a PROJ string",
      { given: "+proj=sterea +lat_0=52 +lon_0=5 +k=0.9999 +x_0=1 +y_0=2 +ellps=bessel +towgs84=565,50,465" },
    ],
    ["a PROJ string in degrees", { given: "+proj=longlat +ellps=bessel +towgs84=565,50,465 +pm=2.5" }],
    ["a PROJ string in feet", { given: "+proj=tmerc +lon_0=9 +a=6378137 +b=6356752.3 +units=us-ft" }],
  ])("says what was settled: %s", (_, sources) => {
    const georeferenced = settled(sources);
    const again = resolveCrs({ file: "output.laz", wkt: outputWkt(georeferenced) }, epsg);
    const { datum: _datum, ...plane } = georeferenced.crs;
    expect(samePlane(again, plane)).toBe(true);
    expect(sameHeights(again, georeferenced.crs)).toBe(true);
    expect(again.verticalUnit.declared || !georeferenced.crs.verticalUnit.declared).toBe(true);
  });

  it("does not give heights above WGS 84 away as those above the ellipsoid of another datum", () => {
    const wkt = outputWkt(settled({ given: "EPSG:21781", givenVertical: "ellipsoidal" }));
    expect(wkt).not.toContain("2002");
    expect(resolveCrs({ file: "output.laz", wkt }, epsg).height).toEqual({ kind: "unknown" });
  });

  it.each([
    ["WKT 1", { given: "EPSG:2994", givenVertical: "EPSG:5703" }],
    [
      "WKT 2",
      {
        wkt: WKT2.replaceAll('LENGTHUNIT["metre",1]', 'LENGTHUNIT["foot",0.3048]'),
        givenVertical: "EPSG:5709",
      },
    ],
  ])("has no code of heights in another unit: %s", (_, sources) => {
    const georeferenced = settled(sources);
    const wkt = outputWkt(georeferenced);
    expect(wkt).not.toMatch(/"EPSG", ?"?57/);
    const again = resolveCrs({ file: "output.laz", wkt }, epsg);
    expect(again.verticalUnit).toMatchObject({ size: 0.3048, declared: true });
    expect(sameHeights(again, georeferenced.crs)).toBe(true);
  });

  it("is the text of the file where that says it all", () => {
    expect(outputWkt(settled({ wkt: AWKWARD }))).toBe(AWKWARD);
  });

  it("keeps a unit of heights whose zero nobody knows", () => {
    const georeferenced = settled({ wkt: UTM32 });
    const verticalUnit = {
      name: "US survey foot",
      kind: "linear",
      size: 1200 / 3937,
      declared: true,
    } as const;
    const wkt = outputWkt({ ...georeferenced, crs: { ...georeferenced.crs, verticalUnit } });
    const again = resolveCrs({ file: "output.laz", wkt }, epsg);
    expect([again.height.kind, again.verticalUnit.size]).toEqual(["unknown", 1200 / 3937]);
  });
});
