import { resolveCrs, truthOf } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { epsg, epsgRows } from "./epsg.js";
import { likelyCrs } from "./likely-crs.js";
import { localPlace } from "./local.js";
import { expectedWhereabouts, heightSystemAbroad } from "./whereabouts.js";

const around = (x: number, y: number) =>
  ({ min: [x - 100, y - 100, 0], max: [x + 100, y + 100, 10] }) as const;
const at = (given: string, x: number, y: number) =>
  expectedWhereabouts({ crs: resolveCrs({ file: "scan.las", given }, epsg) }, around(x, y));

/** Amersfoort. */
const DUTCH = [155000, 463000] as const;

describe("where a data set lies", () => {
  it("is told, and nothing is said where its systems are meant for that", () => {
    const { centre, notes } = at("EPSG:28992+5709", ...DUTCH);
    expect(centre?.longitude).toBeCloseTo(5.387, 3);
    expect(centre?.latitude).toBeCloseTo(52.155, 3);
    expect(notes).toEqual([]);
  });

  it("is outside of the area of use: Dutch numbers declared as UTM 32", () => {
    const { centre, notes } = at("EPSG:25832", ...DUTCH);
    expect(centre?.latitude).toBeCloseTo(4.185, 2);
    expect(notes).toMatchObject([{ code: "CRS_AREA" }]);
    const { text } = notes[0]!;
    expect(text).toMatch(
      /lies 3840 km outside .* EPSG:25832 .*would fit EPSG:28992 \(Amersfoort \/ RD New\).*use --crs to apply one/,
    );
  });

  it("is looked for where the height system is in use, which is far from the other one", () => {
    expect(at("EPSG:32610+5709", ...DUTCH).notes[0]?.text).toMatch(/would fit EPSG:28992 /);
  });

  it("may be a neighbour's: told without a guess", () => {
    // Passau in UTM 32, as Bavaria has it.
    const { notes } = at("EPSG:25832", 826000, 5390000);
    expect(notes).toMatchObject([{ code: "CRS_AREA", text: expect.stringMatching(/lies 10\d km outside/) }]);
    expect(notes[0]?.text).not.toMatch(/would fit/);
  });

  it("is far from its height system: those in use there are named", () => {
    const { notes } = at("EPSG:28992+5703", ...DUTCH);
    expect(notes).toMatchObject([
      {
        code: "CRS_HEIGHT_AREA",
        text: expect.stringMatching(/NAVD88 height .*in use there: EPSG:5709 \(NAP height\)/),
      },
    ]);
  });

  it("has a height system that is in use elsewhere", () => {
    const abroad = (given: string) => {
      const crs = resolveCrs({ file: "scan.las", given }, epsg);
      return heightSystemAbroad(crs, truthOf({ crs }, 0, "scan.las"), around(...DUTCH));
    };
    expect(["EPSG:28992+5728", "EPSG:28992+5709", "EPSG:28992"].map(abroad)).toEqual([
      ...["LN02 height", undefined, undefined],
    ]);
  });

  it("is far from its anchor: coordinates of a map whose origin stands there", async () => {
    const notes = async (anchorAt?: string) =>
      expectedWhereabouts(await anchored(anchorAt), around(85_532, 446_210)).notes;
    const anchored = async (anchorAt?: string) => {
      const local = await localPlace({ anchor: "4.4,52,0,0", anchorAt });
      return { crs: local.crs, local };
    };
    expect(await notes()).toEqual([
      { code: "ANCHOR_FAR", text: expect.stringMatching(/lies 454 km from the origin .*--anchor-at x,y,z/) },
    ]);
    expect(await notes("85500,446200,0")).toEqual([]);
  });

  it("lies deeper or higher than any scan: coordinates of a plane as geocentric ones, or z in a wrong unit", () => {
    const text = expect.stringMatching(
      /^the middle of the data set lies \d+ km below the ellipsoid in WGS 84.*--crs/,
    );
    expect(at("EPSG:4978", 500_000, 5_500_000).notes).toEqual([{ code: "CRS_AREA", text }]);
    const utm = { crs: resolveCrs({ file: "scan.las", given: "EPSG:25832" }, epsg) };
    const notes = (z: number) =>
      expectedWhereabouts(utm, { min: [500_000, 5_500_000, z], max: [500_010, 5_500_010, z] }).notes;
    expect([-11_000, 0, 9_000].flatMap(notes)).toEqual([]);
    expect(notes(460_000)).toMatchObject([
      { code: "CRS_AREA", text: expect.stringContaining("460 km above") },
    ]);
  });

  it("is nowhere beyond the end of its projection, and that is told", () => {
    const text = expect.stringMatching(/\(x 1000000, y 1000000\) has no place in WGS 84; .*--crs/);
    expect(at("EPSG:4326", 1e6, 1e6)).toEqual({
      centre: undefined,
      notes: [{ code: "CRS_PLACELESS", text }],
    });
  });
});

describe("likelyCrs", () => {
  const rows = epsgRows();
  const europe = [5, 44, 12, 55] as const;
  const codes = (x: number, y: number, unit = 1) =>
    likelyCrs(rows, [x, y], europe, unit).map(({ code }) => code);

  it.each([
    ["the Netherlands", 155000, 463000, 28992],
    ["Switzerland, old", 600000, 200000, 21781],
    ["Switzerland, new", 2600000, 1200000, 2056],
    ["Germany, Gauss-Krüger", 3500000, 5400000, 31467],
  ])("knows numbers of %s", (_, x, y, code) => {
    expect(codes(x, y)).toContain(code);
    expect(codes(x, y).length).toBeLessThanOrEqual(3);
  });

  it("names nothing for numbers of no place", () => {
    expect(codes(1e9, 1e9)).toEqual([]);
  });
});
