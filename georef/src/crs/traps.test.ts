import { describe, expect, it } from "vitest";
import { distance } from "../cartesian/points.fixture.js";
import {
  accuracyParts,
  type Crs,
  CrsError,
  type CrsSources,
  exactTransform,
  placePoint,
  resolveCrs,
  sameHeights,
} from "../index.js";
import { lookup } from "./epsg-table.fixture.js";

const DEGREE = 'UNIT["degree",0.0174532925199433]';
const BESSEL = 'SPHEROID["Bessel 1841",6377397.155,299.1528128]';
const METRE = 'UNIT["metre",1]';

/** A transverse Mercator CRS in WKT1 with any of its parts replaced. */
function wkt1({
  datum = `DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]]`,
  unit = METRE,
  rest = "",
} = {}): string {
  return `PROJCS["test",GEOGCS["base",${datum},PRIMEM["Greenwich",0],${DEGREE}],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",15],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],${unit}${rest}]`;
}

function ecef(crs: Crs, x: number, y: number, z = 0): Float64Array {
  const out = new Float64Array(3);
  placePoint(exactTransform(crs), x, y, z, out);
  return out;
}

const read = (sources: Omit<CrsSources, "file">) => resolveCrs({ file: "scan.laz", ...sources }, lookup);

function refusal(sources: Omit<CrsSources, "file">): string {
  try {
    const crs = read(sources);
    exactTransform(crs);
    return `read as ${crs.proj4}`;
  } catch (error) {
    return error instanceof CrsError ? `${error.code}: ${error.cause}` : String(error);
  }
}

describe("traps of proj4js that are closed", () => {
  it("takes the WKT's own shift, else the datum's, else refuses", () => {
    const datum = (shift: string, name: string) => wkt1({ datum: `DATUM["${name}",${BESSEL}${shift}]` });
    expect(read({ wkt: datum(",TOWGS84[1,2,3]", "CH1903") }).proj4).toContain("+towgs84=1,2,3 ");
    expect(read({ wkt: datum("", "CH1903") }).proj4).toContain("+towgs84=674.374,15.056,405.346 ");
    expect(read({ wkt: datum("", "D_MGI") }).datum).toEqual({
      operation: "Militar-Geographische Institut to WGS 84 (EPSG:1618)",
      accuracy: 1.5,
      datum: 6312,
    });
    expect(refusal({ wkt: datum("", "Mars_2000") })).toMatch(
      /^CRS_UNSUPPORTED: no shift from the datum "Mars_2000"/,
    );
  });

  it.each([
    ["+proj=utm +zone=33 +datum=WGS84 +geoidgrids=@null", true],
    ["+proj=utm +zone=33 +datum=WGS84 +geoidgrids=null", true],
    ["+proj=utm +zone=33 +datum=WGS84 +geoidgrids=@null,egm96_15.gtx", true],
    ["+proj=utm +zone=33 +datum=WGS84 +geoidgrids=egm96_15.gtx,null", false],
    [
      `COMPD_CS["a",${wkt1()},VERT_CS["b",VERT_DATUM["c",2005,EXTENSION["PROJ4_GRIDS","@null"]],${METRE}]]`,
      true,
    ],
    [
      `COMPD_CS["a",${wkt1()},VERT_CS["b",VERT_DATUM["c",2005,EXTENSION["PROJ4_GRIDS","a.gtx"]],${METRE}]]`,
      false,
    ],
  ])("knows PROJ's geoid of nothing, heights as they are: %s", (text, none) => {
    const { height } = read(text.startsWith("+") ? { given: text } : { wkt: text });
    expect(height.kind).toBe(none ? "unknown" : "geoid");
  });

  it("knows PROJ's grid of nothing in place of a datum's shift, and not in place of the ensemble's accuracy", () => {
    const NAD27 = `DATUM["North_American_Datum_1927",SPHEROID["Clarke 1866",6378206.4,294.978698213898],EXTENSION["PROJ4_GRIDS","@null"]]`;
    const crs = read({ wkt: wkt1({ datum: NAD27 }) });
    expect(crs.proj4).not.toContain("towgs84");
    expect(crs.datum).toEqual({ operation: expect.stringMatching(/^none/), accuracy: null });
    expect(read({ given: "+proj=utm +zone=33 +ellps=bessel +nadgrids=null" }).proj4).not.toContain("towgs84");
    expect(read({ given: "+proj=utm +zone=33 +datum=WGS84 +nadgrids=@null" }).datum?.accuracy).toBe(2);
    expect(refusal({ given: "+proj=utm +zone=33 +ellps=bessel +nadgrids=a.gsb" })).toMatch(
      /needs the grid a.gsb/,
    );
  });

  it.each([4807, 4810, 4811, 4816])("counts EPSG:%i in grads", (code) => {
    expect(read({ given: `EPSG:${code}` }).horizontalUnit.size).toBeCloseTo(Math.PI / 200, 12);
  });

  it.each([
    { given: "EPSG:9309@2023.25" },
    { given: "EPSG:25832@2020" },
    { given: '{"type":"CoordinateMetadata","crs":{"type":"GeographicCRS"},"coordinateEpoch":2020}' },
    { wkt: 'COORDINATEMETADATA[GEOGCRS["ATRF2014"],EPOCH[2023.25]]' },
  ])("names PROJ for the epoch of coordinates: %o", (sources) => {
    expect(refusal(sources)).toMatch(/^CRS_UNSUPPORTED: .*epoch.* by PROJ alone/);
  });

  it("does not believe the rotations of an EPSG table: RD New has microradians there", () => {
    expect(lookup(28992)?.wkt).toContain("1.9342,-1.6677,9.1019");
    expect(read({ given: "EPSG:28992" }).proj4).toContain(
      "-0.398957388243134,0.343987817378283,-1.87740163998045",
    );
  });

  it("reads a BOUNDCRS, with coordinate frame rotations turned", () => {
    const source =
      'GEOGCRS["x",DATUM["y",ELLIPSOID["Bessel 1841",6377397.155,299.1528128]],CS[ellipsoidal,2],ANGLEUNIT["degree",0.0174532925199433]]';
    const target =
      'TARGETCRS[GEOGCRS["WGS 84",DATUM["World Geodetic System 1984",ELLIPSOID["WGS 84",6378137,298.257223563]]]]';
    const bound = (method: string) =>
      `BOUNDCRS[SOURCECRS[${source}],${target},ABRIDGEDTRANSFORMATION["t",METHOD["${method}"],PARAMETER["X-axis translation",1,ID["EPSG",8605]],PARAMETER["Z-axis rotation",5,ID["EPSG",8610]],PARAMETER["Scale difference",1.000002,ID["EPSG",8611]]]]`;
    expect(read({ wkt: bound("Position Vector transformation (geog2D domain)") }).proj4).toMatch(
      /\+towgs84=1,0,0,0,0,5,(2|1\.99999)/,
    );
    expect(read({ wkt: bound("Coordinate Frame rotation (geog2D domain)") }).proj4).toMatch(
      /\+towgs84=1,0,0,0,0,-5,/,
    );
    const grid = `BOUNDCRS[SOURCECRS[${source}],${target},ABRIDGEDTRANSFORMATION["t",METHOD["NTv2"],PARAMETERFILE["f","a.gsb"]]]`;
    expect(refusal({ wkt: grid })).toBe("CRS_UNSUPPORTED: its datum shift needs the grid a.gsb");
  });

  it("keeps the two feet apart, in plane and in height", () => {
    const vertical = 'VERT_CS["v",VERT_DATUM["d",2005],UNIT["US survey foot",0.304800609601219]]';
    const compound = `COMPD_CS["c",${wkt1({ unit: 'UNIT["foot",0.3048]' })},${vertical}]`;
    const crs = read({ wkt: compound });
    expect([crs.horizontalUnit.size, crs.verticalUnit.size]).toEqual([0.3048, 1200 / 3937]);
    expect(distance(ecef(crs, 1e6, 1e7, 1000), ecef(crs, 1e6, 1e7, 0))).toBeCloseTo(304.8006096, 6);
  });

  it("takes x for easting whatever the order of the axes", () => {
    const swapped = wkt1({ rest: ',AXIS["Northing",NORTH],AXIS["Easting",EAST]' });
    expect(distance(ecef(read({ wkt: swapped }), 4e5, 5e6), ecef(read({ wkt: wkt1() }), 4e5, 5e6))).toBe(0);
  });

  it("refuses axes that run south or west", () => {
    expect(refusal({ wkt: wkt1({ rest: ',AXIS["X",SOUTH],AXIS["Y",WEST]' }) })).toMatch(
      /^CRS_UNSUPPORTED: the axes of/,
    );
    expect(refusal({ given: "EPSG:5513" })).toMatch(/^CRS_UNSUPPORTED: .*axes/);
    expect(refusal({ given: "EPSG:2048" })).toMatch(/^CRS_UNSUPPORTED: the map projection/);
  });

  it("handles what proj4js drops from PROJ strings, or refuses it", () => {
    const crs = read({
      given: "+proj=utm +zone=33 +datum=WGS84 +units=m +geoidgrids=egm96_15.gtx +vunits=us-ft",
    });
    expect(crs.height).toEqual({ kind: "geoid", model: "egm96_15.gtx" });
    expect(crs.verticalUnit).toMatchObject({ size: 1200 / 3937, declared: true });
    expect(crs.proj4).not.toMatch(/geoidgrids|vunits/);
    for (const [given, cause] of [
      ["+proj=utm +zone=33 +nadgrids=a.gsb", "its datum shift needs the grid a.gsb"],
      ["+proj=utm +zone=33 +ellps=nonsuch", "+ellps=nonsuch in the PROJ string is not known"],
      ["+proj=utm +zone=33 +datum=NAD27", "+datum=NAD27 in the PROJ string is not supported"],
      [
        "+proj=utm +zone=33 +units=parsec",
        "+units=parsec in the PROJ string is not a unit that is supported",
      ],
      [
        "+proj=utm +zone=33 +axis=wsu",
        "+axis=wsu in the PROJ string: only easting and northing are supported",
      ],
      ["+proj=utm +zone=33 +magic=1", "+magic in the PROJ string is not supported"],
      [
        "+proj=pipeline +step +proj=utm +zone=33",
        "a PROJ pipeline is an operation, not a coordinate reference system",
      ],
      ["+proj=isea", "the map projection +proj=isea is not supported"],
    ]) {
      expect(refusal({ given })).toBe(`CRS_UNSUPPORTED: ${cause}`);
    }
    expect(refusal({ given: "+proj=utm +zone=61" })).toBe("CRS_UNKNOWN: +zone=61 is no UTM zone");
    expect(refusal({ given: "+proj=tmerc +lat_0=abc" })).toMatch(/^CRS_UNKNOWN: \+lat_0=abc/);
    expect(refusal({ given: "+proj=tmerc +lon_0=7d26'22.5E" })).toMatch(/^CRS_UNKNOWN: \+lon_0=7d26/);
  });

  it("reads prime meridians", () => {
    const paris = read({ given: "+proj=longlat +ellps=WGS84 +pm=paris" });
    const greenwich = read({ given: "+proj=longlat +ellps=WGS84" });
    expect(distance(ecef(paris, 0, 48), ecef(greenwich, 2.337229166667, 48))).toBeLessThan(1e-6);
  });
});

describe("heights", () => {
  it("are what the user says, over what the file says", () => {
    const crs = read({ given: "EPSG:2056", givenVertical: "EPSG:5728" });
    expect(crs).toMatchObject({
      code: "EPSG:2056+5728",
      height: { kind: "geoid", model: "LN02 height", epsg: 5728 },
    });
    expect(read({ given: "EPSG:7415", givenVertical: "ellipsoidal" }).height).toEqual({
      kind: "ellipsoidal",
    });
    expect(refusal({ given: "EPSG:2056", givenVertical: "sea level" })).toMatch(
      /^CRS_UNKNOWN: "sea level" is not a known height reference/,
    );
    expect(refusal({ given: "EPSG:2056", givenVertical: "EPSG:2056" })).toMatch(
      /^CRS_UNSUPPORTED: .*is not a height system/,
    );
  });

  it("are ellipsoidal in CRSs of three dimensions and unknown in those of two", () => {
    expect(read({ given: "EPSG:4979" }).height.kind).toBe("ellipsoidal");
    expect(read({ given: "EPSG:4326" }).height.kind).toBe("unknown");
    expect(read({ given: "EPSG:4326" }).verticalUnit).toMatchObject({ size: 1, declared: false });
  });

  const ch1903 = wkt1({ datum: `DATUM["CH1903",${BESSEL}]` });
  const esri = (datum: string, shift = 0, direction = 1) =>
    `VERTCS["v",${datum},PARAMETER["Vertical_Shift",${shift}],PARAMETER["Direction",${direction}],UNIT["Meter",1.0]]`;

  it.each([
    ["WKT 1", `COMPD_CS["c",${ch1903},VERT_CS["e",VERT_DATUM["Ellipsoid",2002],${METRE},AXIS["Up",UP]]]`],
    ["ESRI's", `${ch1903},${esri(`DATUM["CH1903",${BESSEL}]`)}`],
    ["three axes", ch1903.replace(METRE, `${METRE},AXIS["E",EAST],AXIS["N",NORTH],AXIS["h",UP]`)],
  ])("above the ellipsoid of a national datum move with its shift: %s", (_, wkt) => {
    const own = read({ wkt });
    expect(own.height).toEqual({ kind: "ellipsoidal", ellipsoid: "own" });
    // The ellipsoid of Bessel lies 50 m above that of WGS 84 there; heights of a receiver stay what they are.
    const gnss = read({ wkt, givenVertical: "ellipsoidal" });
    expect(gnss.height).toEqual({ kind: "ellipsoidal" });
    expect(sameHeights(own, gnss)).toBe(false);
    expect(distance(ecef(own, 0, 5e6), ecef(gnss, 0, 5e6))).toBeGreaterThan(40);
    const flat = read({ wkt: ch1903 });
    expect(distance(ecef(flat, 0, 5e6, 7), ecef(gnss, 0, 5e6, 7))).toBe(0);
  });

  it("above an ellipsoid are WGS 84's where the datum is", () => {
    const wkt = `COMPD_CS["c",${wkt1()},VERT_CS["e",VERT_DATUM["Ellipsoid",2002],${METRE}]]`;
    expect(read({ wkt }).height).toEqual({ kind: "ellipsoidal" });
    const datum = 'DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137,298.257223563]]';
    expect(read({ wkt: `${wkt1()},${esri(datum)}` }).height).toEqual({ kind: "ellipsoidal" });
  });

  it("are doubted where a text says of them what nobody applies", () => {
    const doubtIn = (wkt: string) => (read({ wkt }).height as { doubt?: string }).doubt;
    const bessel = `DATUM["CH1903",${BESSEL}]`;
    expect(doubtIn(`${ch1903},${esri(bessel)}`)).toBeUndefined();
    expect(doubtIn(`${ch1903},${esri(bessel, 25)}`)).toMatch(/shifted by 25/);
    expect(doubtIn(`${ch1903},${esri('VDATUM["EGM96_Geoid"]', 25)}`)).toMatch(/shifted by 25/);
    expect(doubtIn(`${ch1903},${esri(bessel, 0, -1)}`)).toMatch(/depths below an ellipsoid/);
    const other = 'DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137,298.257223563]]';
    expect(doubtIn(`${ch1903},${esri(other)}`)).toMatch(/ellipsoid of D_WGS_1984.*that of CH1903/);
    const crs = read({ wkt: `${ch1903},${esri(bessel, 25)}` });
    const [height] = accuracyParts(crs, [1, 1, 1], 0).filter(({ name }) => name === "height");
    expect(height).toEqual({ name: "height", metres: null, note: expect.stringMatching(/shifted by 25/) });
  });

  it("are above the grid that is bound to them, whatever their datum is called", () => {
    const vertical =
      'VERTCRS["unknown",VDATUM["unknown using geoidgrids=g.gtx"],CS[vertical,1],AXIS["h",up],LENGTHUNIT["metre",1]]';
    const bound = `BOUNDCRS[SOURCECRS[${vertical}],TARGETCRS[x],ABRIDGEDTRANSFORMATION["t",METHOD["m"],PARAMETERFILE["f","g.gtx"]]]`;
    expect(read({ wkt: `COMPOUNDCRS["c",${wkt1()},${bound}]` }).height).toEqual({
      kind: "geoid",
      model: "g.gtx",
    });
    expect(read({ wkt: `COMPOUNDCRS["c",${wkt1()},${vertical}]` }).height).toEqual({ kind: "unknown" });
    const esris = `${wkt1()},${esri('VDATUM["unknown_using_geoidgrids_g_gtx"]')}`;
    expect(read({ wkt: esris }).height).toEqual({ kind: "unknown" });
  });

  it("count downwards as depths", () => {
    const depth = 'VERTCRS["depth",VDATUM["d"],CS[vertical,1],AXIS["depth (D)",down],LENGTHUNIT["metre",1]]';
    const { verticalUnit, height } = read({ wkt: `COMPOUNDCRS["c",${wkt1()},${depth}]` });
    expect(verticalUnit).toMatchObject({ name: "metre", size: -1, declared: true });
    expect(height).toEqual({ kind: "geoid", model: "depth" });
  });
});

describe("texts that say nothing usable", () => {
  it.each<[string, Omit<CrsSources, "file">, RegExp]>([
    ["no source at all", {}, /^CRS_MISSING/],
    ["a VLR of NULs", { wkt: "\0\0\0" }, /^CRS_MISSING/],
    ["half a WKT", { wkt: wkt1().slice(0, 200) }, /^CRS_UNKNOWN: "PROJCS/],
    ["another language", { given: "Swiss grid, please" }, /^CRS_UNKNOWN/],
    ["a code that is not there", { given: "EPSG:999999" }, /^CRS_UNKNOWN: EPSG:999999 is not in the table/],
    ["a height system alone", { given: "EPSG:5728" }, /^CRS_UNSUPPORTED: .*height system alone/],
    ["JSON of something else", { given: '{"type":"Feature"}' }, /^CRS_UNKNOWN/],
    ["broken JSON", { given: '{"type":' }, /^CRS_UNKNOWN/],
    [
      "a local grid",
      { wkt: 'LOCAL_CS["site",UNIT["metre",1]]' },
      /^CRS_UNSUPPORTED: .*no geographic or projected part/,
    ],
    [
      "the moon",
      {
        wkt: 'GEOGCS["Moon",DATUM["D_Moon",SPHEROID["Moon",1737400,0]],PRIMEM["R",0],UNIT["degree",0.0174532925199433]]',
      },
      /not the earth's/,
    ],
    [
      "ten thousand brackets",
      { wkt: `${"A[".repeat(10000)}${"]".repeat(10000)}` },
      /^CRS_UNKNOWN|^CRS_UNSUPPORTED/,
    ],
  ])("%s", (_, sources, pattern) => {
    expect(refusal(sources)).toMatch(pattern);
  });

  it("takes a bare number for the code that it may be, and says how to give it", () => {
    for (const given of ["2056", "2056+5728"]) {
      expect(() => read({ given })).toThrow(expect.objectContaining({ fix: `give EPSG:${given}` }));
    }
    expect(() => read({ given: "12" })).toThrow(
      expect.objectContaining({ fix: expect.not.stringContaining("EPSG:12") }),
    );
  });

  it("names file, cause and fix in its message", () => {
    expect(() => resolveCrs({ file: "scan.laz" })).toThrow(
      "CRS_MISSING: scan.laz: it does not say which coordinate reference system it is in. Give the coordinate reference system yourself: the option crs of the layer, --crs on the command line.",
    );
  });

  it("says so when no table of codes is at hand", () => {
    expect(() => resolveCrs({ file: "f", given: "EPSG:2056" })).toThrow(
      /^CRS_UNKNOWN: f: EPSG:2056 cannot be looked up/,
    );
  });
});
