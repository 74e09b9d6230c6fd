import { exactTransform } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { knownCrs } from "./known-crs.js";
import { findProj } from "./program/find.js";

const proj = await findProj();
const absent = proj ? "" : " (skipped: PROJ is not installed)";
const METRE = { name: "metre", kind: "linear", size: 1 } as const;

describe.skipIf(!proj)(`a CRS by PROJ${absent}`, () => {
  const known = (text: string) => knownCrs(proj!, { name: "x.las", text });

  it("is read with its code, unit, PROJ string and WKT", async () => {
    const crs = await known("EPSG:2385");
    expect(crs).toMatchObject({
      ...{ name: "Xian 1980 / 3-degree Gauss-Kruger CM 120E", code: "EPSG:2385" },
      ...{ horizontalUnit: METRE, verticalUnit: { ...METRE, declared: false }, height: { kind: "unknown" } },
    });
    expect(crs.proj4).toMatch(/^\+proj=tmerc .*(\+a=6378140|\+ellps=)/);
    expect(crs.wkt).toMatch(/^PROJCRS\["Xian 1980/);
  });

  it("has the heights of a compound, with their unit", async () => {
    const crs = await known("EPSG:2385+5737");
    expect(crs).toMatchObject({ code: "EPSG:2385+5737", verticalUnit: { ...METRE, declared: true } });
    expect(crs.height).toEqual({ kind: "geoid", model: "Yellow Sea 1985 height", epsg: 5737 });
    const feet = await known("EPSG:2262+6360");
    expect(feet.horizontalUnit.size).toBeCloseTo(1200 / 3937, 12);
    expect(feet.verticalUnit).toMatchObject({ size: feet.horizontalUnit.size, declared: true });
  });

  it("has ellipsoidal heights where it has three axes, and degrees or grads where it is geographic", async () => {
    const three = await known("EPSG:4979");
    expect(three).toMatchObject({ height: { kind: "ellipsoidal" }, horizontalUnit: { kind: "angular" } });
    const grads = await known("EPSG:4807");
    expect(grads.horizontalUnit).toMatchObject({ kind: "angular" });
    expect(grads.horizontalUnit.size).toBeCloseTo(Math.PI / 200, 12);
  });

  it("is read from WKT of an unknown datum, and with a shift of its own", async () => {
    const text = "+proj=cass +lat_0=52.4 +lon_0=13.6 +ellps=bessel +towgs84=598,73,418 +units=m";
    const crs = await known(text);
    expect(crs.proj4).toMatch(/^\+proj=cass .*\+towgs84=598,73,418/);
    expect(await known(crs.wkt!)).toMatchObject({ proj4: crs.proj4 });
  });

  it("is derived, and then has no PROJ string that proj4js could read", async () => {
    const degree = 'ANGLEUNIT["degree",0.0174532925199433]';
    const base = `BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",ELLIPSOID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0,${degree}]]`;
    const parameters = `PARAMETER["Latitude of natural origin",0,${degree}],PARAMETER["Longitude of natural origin",9,${degree}],PARAMETER["Scale factor at natural origin",0.9996],PARAMETER["False easting",500000,LENGTHUNIT["metre",1]],PARAMETER["False northing",0,LENGTHUNIT["metre",1]]`;
    const utm = `BASEPROJCRS["UTM",${base},CONVERSION["UTM zone 32N",METHOD["Transverse Mercator",ID["EPSG",9807]],${parameters}]]`;
    const site = `DERIVINGCONVERSION["site",METHOD["Affine parametric transformation",ID["EPSG",9624]],PARAMETER["A0",-500000,LENGTHUNIT["metre",1]],PARAMETER["A1",1,SCALEUNIT["unity",1]],PARAMETER["A2",0,SCALEUNIT["unity",1]],PARAMETER["B0",-5000000,LENGTHUNIT["metre",1]],PARAMETER["B1",0,SCALEUNIT["unity",1]],PARAMETER["B2",1,SCALEUNIT["unity",1]]]`;
    const axes = `CS[Cartesian,2],AXIS["(E)",east,ORDER[1],LENGTHUNIT["metre",1]],AXIS["(N)",north,ORDER[2],LENGTHUNIT["metre",1]]`;
    const crs = await known(`DERIVEDPROJCRS["of a site",${utm},${site},${axes}]`);
    expect(crs).toMatchObject({
      name: "of a site",
      horizontalUnit: { size: 1 },
      proj4: "+proj=derived +no_defs",
    });
    expect(() => exactTransform(crs, 0)).toThrow(expect.objectContaining({ code: "CRS_UNSUPPORTED" }));
  });

  it("counts depths downwards", async () => {
    expect(await known("EPSG:26918+6358")).toMatchObject({
      height: { kind: "geoid", epsg: 6358 },
      verticalUnit: { name: "US survey foot", size: expect.closeTo(-1200 / 3937, 9), declared: true },
    });
  });

  it("takes heights as they are where its geoid is PROJ's grid of nothing", async () => {
    const none = await known("+proj=igh +datum=WGS84 +geoidgrids=@null");
    expect(none.height).toEqual({ kind: "unknown" });
    const some = await known("+proj=igh +datum=WGS84 +geoidgrids=@egm96_15.gtx");
    expect(some.height.kind).toBe("geoid");
  });

  it.each([
    ["OGC:CRS84h", 6326],
    ["ESRI:54030", 6326],
    ["+proj=igh +datum=WGS84", 6326],
    ["+proj=ob_tran +o_proj=longlat +o_lon_p=0 +o_lat_p=39 +lon_0=18 +datum=WGS84", 6326],
    ["EPSG:7665", undefined],
    ["EPSG:2385", undefined],
  ])("%s: whether it stands on the ensemble of WGS 84, which is worth 2 m", async (text, datum) => {
    expect((await known(text)).datum?.datum).toBe(datum);
  });

  it.each([
    ["nothing", "EPSG:999999", "CRS_UNKNOWN"],
    ["a height system alone", "EPSG:5728", "CRS_UNSUPPORTED"],
    ["geocentric coordinates", "EPSG:4978", "CRS_UNSUPPORTED"],
    ["an engineering system", "EPSG:5800", "CRS_UNSUPPORTED"],
  ])("is refused when it is %s", async (_, text, code) => {
    await expect(known(text)).rejects.toMatchObject({ code, file: "x.las" });
  });
});
