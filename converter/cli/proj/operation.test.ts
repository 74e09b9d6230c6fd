import { describe, expect, it } from "vitest";
import { listOperations, operationAreas, readAreas, readOperations } from "./operation.js";
import { findProj } from "./program/find.js";

const proj = await findProj();
const absent = proj ? "" : " (skipped: PROJ is not installed)";

const ANSWER = `Candidate operations found: 2
-------------------------------------
Operation No. 1:

unknown id, Inverse of RD New, old + Amersfoort to ETRS89 (9), 1.002 m, Netherlands - onshore, 12-mile zone., at least one grid missing

PROJ string:
+proj=pipeline +step +inv +proj=sterea +ellps=bessel +step +proj=cart +ellps=WGS84

Grid nl_nsgi_rdtrans2018.tif needed but not found on the system. Can be obtained at https://cdn.proj.org/x.tif
Grid nl_nsgi_nlgeo2018.tif needed but not found on the system.

-------------------------------------
Operation No. 2:

INVERSE(EPSG):1672, Ballpark geographic offset, unknown accuracy, World, has ballpark transformation

PROJ string:
Error when exporting to PROJ string: unsupported
`;

describe("the answer of projinfo", () => {
  it("has areas of use, but for operations that it cannot write", () => {
    const bbox = { south_latitude: -47, west_longitude: 166, north_latitude: -34, east_longitude: -178 };
    const json = JSON.stringify({ name: "one", bbox });
    const sections = [json, '{"name":"two"}', "{broken", "Error when exporting to PROJJSON: x", json];
    const answer = sections.map((text, i) => `Operation No. ${i + 1}:\n\nPROJJSON:\n${text}\n`).join("\n");
    const area = [166, -47, -178, -34];
    expect(readAreas(answer)).toEqual([area, undefined, undefined, undefined, area]);
  });

  it("is read", () => {
    expect(readOperations(ANSWER)).toEqual([
      {
        name: "Inverse of RD New, old + Amersfoort to ETRS89 (9)",
        accuracy: 1.002,
        area: "Netherlands - onshore, 12-mile zone.",
        ballpark: false,
        missingGrids: ["nl_nsgi_rdtrans2018.tif", "nl_nsgi_nlgeo2018.tif"],
        pipeline: "+proj=pipeline +step +inv +proj=sterea +ellps=bessel +step +proj=cart +ellps=WGS84",
      },
      {
        name: "Ballpark geographic offset",
        accuracy: null,
        area: "World",
        ballpark: true,
        missingGrids: [],
      },
    ]);
    expect(readOperations("Candidate operations found: 0\n")).toEqual([]);
  });

  it("lacks no grid that the coordinate system calls optional", () => {
    const [first] = readOperations(ANSWER.replaceAll("Grid nl_nsgi_rdtrans2018.tif", "Grid @null"))!;
    expect(first.missingGrids).toEqual(["nl_nsgi_nlgeo2018.tif"]);
  });

  it.each([
    ["nothing", ""],
    ["something else", "Usage: projinfo"],
    ["fewer than it says", ANSWER.replace("found: 2", "found: 3")],
    ["one without accuracy", ANSWER.replace(", unknown accuracy", "")],
    ["one without a name", ANSWER.replace("INVERSE(EPSG):1672, Ballpark geographic offset", "")],
    ["binary", "Candidate operations found: 1\nOperation No. 1:\n\u0000\uffff"],
  ])("is not believed when it has %s", (_, text) => {
    expect(readOperations(text)).toBeUndefined();
  });
});

describe.skipIf(!proj)(`projinfo itself${absent}`, () => {
  it("names the grids that it lacks, and what they would be worth", async () => {
    const operations = await listOperations(proj!, { name: "7415", text: "EPSG:7415" });
    const best = operations[0];
    expect(best.missingGrids).toContain("nl_nsgi_rdtrans2018.tif");
    expect(best.accuracy).toBeGreaterThan(0);
    expect(operations.some(({ ballpark, accuracy }) => ballpark && accuracy === null)).toBe(true);
  });

  it("names a German grid as PROJ-data does, whichever PROJ is asked", async () => {
    const operations = await listOperations(proj!, { name: "DHHN2016", text: "EPSG:25832+7837" });
    const missing = operations.flatMap(({ missingGrids }) => missingGrids);
    const usable = operations.filter(({ missingGrids }) => missingGrids.length === 0);
    const named = [...missing, ...usable.map(({ pipeline = "" }) => pipeline)].join(" ");
    expect(named).toContain("de_bkg_gcg2016.tif");
    expect(named).not.toContain("GCG2016.txt");
  });

  it("has the areas of use of the operations too, in their order", async () => {
    const source = { name: "ED50", text: "EPSG:23031" };
    const box = { west: 0.5, south: 42, east: 2, north: 44 };
    const operations = await listOperations(proj!, source, { box });
    const areas = await operationAreas(proj!, source, { box });
    expect(areas).toHaveLength(operations.length);
    const [, , , north] = areas[operations.findIndex(({ name }) => name.includes("(28)"))]!;
    expect(north).toBe(43.56);
  });

  it.each([
    ["a code of nothing", "EPSG:999999"],
    ["a file", "@/etc/passwd"],
    ["an option", "--list-crs"],
    ["a name", "WGS 84"],
    ["WKT of nothing", 'PROJCS["x"]'],
    ["a PROJ string of nothing", "+proj=nothing"],
  ])("is not asked, or does not know, %s", async (_, text) => {
    await expect(listOperations(proj!, { name: "x.las", text })).rejects.toMatchObject({
      code: "CRS_UNKNOWN",
      file: "x.las",
    });
  });
});
