import { describe, expect, it } from "vitest";
import { parsePipeline } from "./pipeline.js";
import { pipelineWords, splitPipeline } from "./step-text.js";

const UTM = "+step +inv +proj=utm +zone=33 +ellps=WGS84";
const CART = "+step +proj=cart +ellps=WGS84";
const parse = (...steps: string[]) => parsePipeline(["+proj=pipeline", ...steps].join(" "));
const kinds = (...steps: string[]) => parse(...steps).steps.map(({ kind }) => kind);
const GRID = { name: "a.tif", optional: false };

describe("words of a pipeline", () => {
  it("come back as they were", () => {
    const text = `+proj=pipeline ${UTM} +step +proj=push +v_3 ${CART}`;
    expect(pipelineWords(splitPipeline(text)).join(" ")).toBe(text);
  });

  it.each([
    ["nothing", ""],
    ["a step of no name", "+proj=pipeline +step +inv"],
    ["a step outside of a pipeline", "+proj=cart +ellps=WGS84 +step +proj=noop"],
    ["a pipeline in a pipeline", `+proj=pipeline +step +proj=pipeline ${UTM}`],
    ["a parameter for all", `+proj=pipeline +ellps=bessel ${UTM} ${CART}`],
    ["a file of definitions", "+proj=pipeline +step +init=epsg:4326"],
    ["another name", "+proj=pipeline +step +proj=cart +proj=utm"],
    ["a quoted value", '+proj=pipeline +step +proj=hgridshift +grids="a b"'],
    ["a shell's work", "+proj=pipeline +step +proj=cart;rm -rf /"],
    ["an option", "-o /tmp/x +proj=cart"],
    ["a control character", "+proj=pipeline +step +proj=cart\u0000"],
    ["too much", `+proj=pipeline ${UTM} `.repeat(1000)],
  ])("are refused by name with %s", (_, text) => {
    expect(() => parsePipeline(text)).toThrow(expect.objectContaining({ code: "CRS_OPERATION_UNSUPPORTED" }));
  });
});

describe("a pipeline", () => {
  it("loses the swap of axes that the authority wants, and no other", () => {
    const plan = parse("+step +proj=axisswap +order=2,1", UTM, CART);
    expect(plan.pipeline.map(({ name }) => name)).toEqual(["utm", "cart"]);
    expect(parse("+step +proj=axisswap +order=-2,-1", UTM, CART).projection).toBe(2);
    expect(() => parse("+step +proj=axisswap +order=1,3,2", UTM, CART)).toThrow(/order 1,3,2/);
  });

  it("keeps what it does to the plane before longitude and latitude in what is sampled", () => {
    const degrees = "+step +proj=unitconvert +xy_in=deg +z_in=us-ft +xy_out=rad +z_out=m";
    const plan = parse(degrees, "+step +inv +proj=longlat +ellps=clrk80ign +pm=paris", CART);
    expect(plan.projection).toBe(2);
    expect(plan.metresPerUnit).toBeCloseTo(1200 / 3937, 15);
    expect(plan.steps).toMatchObject([
      { kind: "height", metresPerUnit: 1200 / 3937 },
      { kind: "geocentric" },
    ]);
  });

  it("knows what PROJ writes for `cart` behind a projection without a name in WKT", () => {
    const geocent = "+step +proj=geocent +datum=WGS84 +units=m";
    expect(parse("+step +inv +proj=lsat +lsat=5 +path=220 +ellps=WGS84", geocent)).toMatchObject({
      steps: [{ kind: "geocentric", ellipsoid: new Map([["datum", "WGS84"]]) }],
    });
    expect(() => parse(UTM, geocent.replace("=m", "=km"))).toThrow(/units/);
  });

  it("takes no notice of geographic coordinates in between, and none for another meridian", () => {
    const longlat = "+step +inv +proj=longlat +a=6378249.145 +rf=293.465";
    expect(parse(UTM, longlat, CART)).toMatchObject({ projection: 2, steps: [{ kind: "geocentric" }] });
    const grid = "+step +proj=hgridshift +grids=a.tif";
    expect(kinds(UTM, grid, longlat, CART)).toEqual(["horizontalShift", "geocentric"]);
    expect(() => parse(UTM, grid, `${longlat} +pm=paris`, CART)).toThrow(/\+pm/);
  });

  it("takes units of height wherever they stand", () => {
    const feet = "+step +proj=unitconvert +z_in=ft +z_out=m";
    expect(parse(UTM, feet, CART).metresPerUnit).toBe(0.3048);
    expect(parse(`${UTM} +vunits=ft`, CART).metresPerUnit).toBe(0.3048);
    const there = "+step +proj=unitconvert +xy_in=rad +z_in=us-ft +xy_out=deg +z_out=m";
    const back = "+step +proj=unitconvert +xy_in=deg +z_in=m +xy_out=rad +z_out=m";
    expect(kinds(UTM, there, back, CART)).toEqual(["height", "geocentric"]);
    expect(() => parse(UTM, there, CART)).toThrow(/not in radians/);
  });

  it("shifts by grids in either direction, and heights by PROJ's default of minus one", () => {
    const plan = parse(
      UTM,
      "+step +inv +proj=hgridshift +grids=a.tif,@b.gsb",
      "+step +proj=vgridshift +grids=a.tif",
      "+step +inv +proj=vgridshift +grids=a.tif",
      "+step +proj=vgridshift +grids=a.tif +multiplier=1",
      CART,
    );
    expect(plan.steps).toMatchObject([
      { kind: "horizontalShift", direction: "inverse", grids: [GRID, { name: "b.gsb", optional: true }] },
      { kind: "verticalShift", multiplier: -1, grids: [GRID], before: 2 },
      { kind: "verticalShift", multiplier: 1 },
      { kind: "verticalShift", multiplier: 1 },
      { kind: "geocentric" },
    ]);
    expect(kinds(UTM, "+step +proj=hgridshift +grids=@null", CART)).toEqual(["geocentric"]);
  });

  it("takes the plane of a derived CRS and a rotated pole for parts of the projection", () => {
    const affine = "+step +inv +proj=affine +xoff=-500000 +s11=1 +s12=0 +yoff=-5000000 +s21=0 +s22=1";
    expect(parse(affine, UTM, CART)).toMatchObject({ projection: 2, steps: [{ kind: "geocentric" }] });
    expect(() => parse("+step +proj=affine +s33=2", UTM, CART)).toThrow(/\+s33/);
    const degrees = "+step +proj=unitconvert +xy_in=deg +xy_out=rad";
    const rotated = "+step +inv +proj=ob_tran +o_proj=longlat +o_lon_p=-162 +o_lat_p=39.25 +ellps=WGS84";
    expect(parse(degrees, rotated, CART)).toMatchObject({ projection: 2, steps: [{ kind: "geocentric" }] });
    expect(() => parse(degrees, rotated.replace("longlat", "merc"), CART)).toThrow(/ob_tran/);
  });

  it("turns depths into heights, in the unit that they have", () => {
    expect(parse(UTM, "+step +proj=axisswap +order=1,2,-3", CART)).toMatchObject({
      steps: [{ kind: "height", metresPerUnit: -1 }, { kind: "geocentric" }],
      metresPerUnit: -1,
    });
    expect(parse("+step +proj=axisswap +order=1,2,-3", UTM, CART).metresPerUnit).toBe(-1);
    expect(parse(UTM, "+step +proj=affine +s33=-0.3048", CART).metresPerUnit).toBe(-0.3048);
    expect(parse(UTM, "+step +inv +proj=affine +s33=-0.5", CART).metresPerUnit).toBe(-2);
    expect(() => parse(UTM, "+step +proj=affine +xoff=1", CART)).toThrow(/\+xoff/);
    expect(() => parse(UTM, "+step +proj=affine +s33=0", CART)).toThrow(/s33=0/);
  });

  it("adds the same offset everywhere, in either direction", () => {
    const tokyo = "+step +proj=geogoffset +dlat=11.5 +dlon=-10.25 +dh=-36";
    expect(parse(UTM, tokyo, CART).steps.slice(0, 2)).toEqual([
      { kind: "horizontalOffset", longitude: -10.25, latitude: 11.5 },
      { kind: "verticalOffset", metres: -36 },
    ]);
    expect(parse(UTM, tokyo.replace("+step", "+step +inv"), CART).steps[1]).toMatchObject({ metres: 36 });
    expect(kinds(UTM, "+step +proj=geogoffset +dh=2.3", CART)).toEqual(["verticalOffset", "geocentric"]);
    expect(kinds(UTM, "+step +proj=geogoffset", CART)).toEqual(["geocentric"]);
    expect(() => parse(UTM, "+step +proj=push +v_3", tokyo, "+step +proj=pop +v_3", CART)).toThrow(/heights/);
  });

  it("leaves heights alone between push and pop", () => {
    const shift =
      "+step +proj=cart +ellps=bessel +step +proj=helmert +x=1 +step +inv +proj=cart +ellps=GRS80";
    const plan = parse(UTM, "+step +proj=push +v_3", shift, "+step +proj=pop +v_3", CART);
    expect(plan.steps[0]).toMatchObject({ kind: "datumShift", keepHeight: true });
    expect(parse(UTM, shift, CART).steps[0]).toMatchObject({ keepHeight: false });
    expect(() => parse(UTM, "+step +proj=push +v_1 +v_2", shift, CART)).toThrow(/\+v_1 \+v_2/);
    expect(() => parse(UTM, "+step +proj=push +v_3", shift, CART)).toThrow(/no ECEF/);
    expect(() => parse(UTM, "+step +proj=pop +v_3", shift, CART)).toThrow(/v_3/);
  });

  it("may end with a shift in space", () => {
    const end = "+step +proj=cart +ellps=GRS80 +step +proj=helmert +x=-0.991 +y=1.9072 +z=0.5129";
    expect(kinds(UTM, end)).toEqual(["datumShift", "geocentric"]);
  });

  it("takes steps without a form of their own together with what leads to them and back", () => {
    const degrees = "+step +proj=unitconvert +xy_in=rad +xy_out=deg +step +proj=axisswap +order=2,1";
    const back = "+step +proj=axisswap +order=2,1 +step +proj=unitconvert +xy_in=deg +xy_out=rad";
    const triangles = `${degrees} +step +proj=tinshift +file=x.json ${back}`;
    const grid = "+step +proj=hgridshift +grids=a.tif";
    expect(parse(UTM, grid, triangles, CART).steps).toMatchObject([
      { kind: "horizontalShift" },
      { kind: "sampled", before: 2, after: 7 },
      { kind: "geocentric" },
    ]);
    const space =
      "+step +proj=cart +ellps=clrk80ign +step +proj=xyzgridshift +grids=b.tif +step +inv +proj=cart +ellps=GRS80";
    const kept = parse(UTM, `+step +proj=push +v_3 ${space} +step +proj=pop +v_3`, CART);
    expect(kept.steps[0]).toEqual({
      ...{ kind: "sampled", before: 1, after: 6 },
      space: { from: new Map([["ellps", "clrk80ign"]]), to: new Map([["ellps", "GRS80"]]), keepHeight: true },
    });
    const moving = space.replace("+step +inv", "+step +proj=helmert +x=1 +dx=0.1 +t_epoch=2010 +step +inv");
    expect(kept.undated).toBe(false);
    expect(parse(UTM, moving, CART).undated).toBe(true);
  });

  it.each([
    ["deformation", "+step +proj=deformation +grids=x.tif +dt=1"],
    ["xyzgridshift", "+step +proj=xyzgridshift +grids=x.tif"],
    ["gridshift", "+step +proj=gridshift +grids=x.tif +t_epoch=2010"],
    ["molodensky", "+step +proj=molodensky +ellps=GRS80 +dx=1 +dy=1 +dz=1 +da=1 +df=1"],
    ["geogoffset", "+step +proj=geogoffset +dlat=much"],
    ["defmodel", "+step +proj=defmodel +model=x.json"],
    ["a later invention", "+step +proj=later_invention"],
    ["hgridshift", "+step +proj=hgridshift +grids=x.tif +t_epoch=2010"],
    ["vgridshift", "+step +proj=vgridshift +grids=x.tif +multiplier=much"],
    ["unitconvert", "+step +proj=unitconvert +t_in=mjd +t_out=decimalyear"],
    ["helmert", "+step +proj=cart +ellps=GRS80 +step +proj=helmert +x=1 +dx=0.1"],
  ])("with %s is refused by the step's name", (name, step) => {
    expect(() => parse(UTM, step, CART)).toThrow(
      expect.objectContaining({
        code: "CRS_OPERATION_UNSUPPORTED",
        cause: expect.stringContaining(`"${name.startsWith("a ") ? "later_invention" : name}"`),
      }),
    );
  });

  it("takes the way back from a rotated pole for a part of the projection, and no other projection there", () => {
    const degrees = "+step +proj=unitconvert +xy_in=deg +xy_out=rad";
    const rotated =
      "+step +inv +proj=ob_tran +o_proj=longlat +o_lon_p=0 +o_lat_p=39.25 +lon_0=18 +ellps=WGS84";
    expect(parse(degrees, rotated, CART)).toMatchObject({ projection: 2, steps: [{ kind: "geocentric" }] });
    expect(() => parse(degrees, rotated.replace("+o_proj=longlat", "+o_proj=moll"), CART)).toThrow(/ob_tran/);
    expect(() => parse(degrees, rotated.replace("+inv ", ""), CART)).toThrow(/ob_tran/);
    expect(() => parse(degrees, `${rotated} +towgs84=1,2,3`, CART)).toThrow(/its parameter/);
  });

  it.each(["nadgrids=x.gsb", "geoidgrids=x.gtx", "towgs84=1,2,3"])(
    "with a projection that shifts by +%s is refused",
    (hidden) => {
      expect(() => parse(`${UTM} +${hidden}`, CART)).toThrow(/its parameter/);
    },
  );
});
