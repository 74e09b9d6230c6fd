import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { convert, converted } from "../converted.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing } from "./core.js";
import { groma } from "./groma.js";

const road = data("vol_total.laz");
const REFUSED = road.missing ?? coreMissing ?? pythonMissing;

/** What the referee says of two cuts. */
interface Compared {
  readonly counts: readonly [number, number];
  readonly names: boolean;
  readonly chainage: number;
  readonly offset: number;
  readonly z: number;
}

describe.skipIf(REFUSED)(
  `a profile through files of several systems${REFUSED ? ` (skipped: ${REFUSED})` : ""}`,
  () => {
    let folder = "";
    const at = (name: string) => join(folder, name);
    const copc = (name: string) => at(`${name}.copc.laz`);
    beforeAll(() => {
      folder = mkdtempSync(join(tmpdir(), "groma-mixed-"));
      const { line } = runPython<{ line: number[][] }>("interop/mixed_scans.py", ["make", road.path, folder]);
      for (const name of ["merged", "one", "two", "three", "degrees"]) convert(at(`${name}.las`), copc(name));
      writeFileSync(at("line.geojson"), JSON.stringify({ type: "LineString", coordinates: line }));
    }, 240_000);
    afterAll(() => rmSync(folder, { recursive: true }));

    const cut = (out: string, names: readonly string[], ...options: string[]) =>
      groma([
        ...["profile", ...names.map(copc), "--line", at("line.geojson"), "--width", "5.001"],
        ...["--out", at(out), "--overwrite", ...options],
      ]);
    const compared = (a: string, b: string) =>
      runPython<Compared>("interop/mixed_scans.py", ["compare", at(a), at(b)]);

    it("has the points that one merged file has, and the same chainages and offsets", () => {
      expect(cut("merged.csv", ["merged"], "--plane", "ellipsoid")).toMatchObject({ code: 0 });
      expect(cut("parts.csv", ["one", "two", "three"])).toMatchObject({ code: 0 });
      const found = compared("merged.csv", "parts.csv");
      expect(found.counts[0]).toBeGreaterThan(200);
      expect(found.names).toBe(true);
      // Coordinates are kept to a tenth of a millimetre in each zone.
      expect(found.chainage).toBeLessThan(2e-4);
      expect(found.offset).toBeLessThan(2e-4);
      expect(found.z).toBe(0);
    });

    it("is cut in metres from a scan in degrees, by the same code", () => {
      expect(cut("degrees.csv", ["degrees"])).toMatchObject({ code: 0 });
      const found = compared("merged.csv", "degrees.csv");
      expect(found).toMatchObject({ names: true, z: 0 });
      expect(Math.max(found.chainage, found.offset)).toBeLessThan(3e-4);
    });

    it("has sections whose points lie where those of one merged file do, each in the coordinates of its own file", () => {
      const widths = ["--left", "20", "--right", "20", "--thickness", "30"];
      const sections = ["--sections", "--interval", "20", ...widths];
      const rowsOf = (out: string, ...cutting: [readonly string[], ...string[]]) => {
        const [names, ...options] = cutting;
        expect(cut(out, names, ...sections, "--files", "csv", ...options)).toMatchObject({ code: 0 });
        // Files of an archive are stored as they are: sections first, the list of them behind.
        const tables = readFileSync(at(out), "latin1")
          .split("section,station,")[0]!
          .split(/x,y,z,chainage,offset/);
        return tables.slice(1).map((table) => {
          const [columns, ...rows] = table.split("\r\n").filter((row) => row.includes(","));
          const back = columns!.split(",").includes("crs") ? 5 : undefined;
          // Coordinates are kept to a tenth of a millimetre in each zone: what is as near to an edge may fall to either side.
          const places = rows
            .map((row) => row.split(","))
            .filter((row) => Math.abs(Number(row[3])) < 19.999 && Math.abs(Number(row[4])) < 14.999);
          return {
            systems: new Set(places.map((row) => back && row[back])),
            chainages: places.map((row) => Number.parseFloat(row[3]!)).sort((a, b) => a - b),
            offsets: places.map((row) => Number.parseFloat(row[4]!)).sort((a, b) => a - b),
          };
        });
      };
      const merged = rowsOf("merged.zip", ["merged"], "--plane", "ellipsoid");
      const parts = rowsOf("parts.zip", ["one", "two", "three"]);
      expect(parts.map(({ chainages }) => chainages.length)).toEqual(
        merged.map(({ chainages }) => chainages.length),
      );
      for (const [index, part] of parts.entries()) {
        for (const axis of ["chainages", "offsets"] as const)
          for (const [at, value] of part[axis].entries())
            expect(Math.abs(value - merged[index]![axis][at]!)).toBeLessThan(3e-4);
      }
      expect(new Set(parts.flatMap(({ systems }) => [...systems]))).toEqual(
        new Set(["WGS 84 / UTM zone 32N", "WGS 84 / UTM zone 31N"]),
      );
      expect([...merged[0]!.systems]).toEqual([undefined]);
    });

    it("has its points and its line in one plane in DXF, and refuses what has none in common", () => {
      expect(cut("parts.dxf", ["one", "two", "three"])).toMatchObject({ code: 0 });
      const text = readFileSync(at("parts.dxf"), "utf8");
      const easts = [...text.matchAll(/\n8\nPOINTS\n10\n(.*)\n20\n(.*)\n/g)].map(([, x]) => Number(x));
      const ends = [...text.matchAll(/VERTEX\n8\nLINE\n10\n(.*)\n20\n/g)].map(([, x]) => Number(x));
      expect(easts.length).toBeGreaterThan(200);
      expect(Math.min(...easts)).toBeGreaterThan(Math.min(...ends) - 5);
      expect(Math.max(...easts)).toBeLessThan(Math.max(...ends) + 5);
      const clip = (out: string, ...where: string[]) =>
        groma(["clip", copc("one"), copc("two"), ...where, "--out", at(out)]);
      expect(clip("slice.dxf", "--heights", "700,800").stderr).toMatch(
        /EXPORT_MIXED: .*two.copc.laz: .*zone 31N/,
      );
      expect(clip("box.csv", "--box", "0,0,1e6,1e7").stderr).toMatch(/OPTION_CRS: --box/);
    });

    it("lies within the scale of UTM of the one in the plane of the zone", () => {
      expect(cut("plane.csv", ["merged"])).toMatchObject({ code: 0 });
      const chainages = (file: string) =>
        readFileSync(at(file), "utf8")
          .trim()
          .split("\r\n")
          .slice(1)
          .map((row) => Number(row.split(",")[3]));
      const ratio = Math.max(...chainages("plane.csv")) / Math.max(...chainages("merged.csv"));
      // 100 km west of the meridian: 0.9996 · (1 + x² / 2R²).
      expect(Math.abs(ratio - 0.9996 * (1 + 100 ** 2 / 2 / 6378 ** 2))).toBeLessThan(1e-4);
    });

    it("goes into no one LAS file, and along no line in source coordinates", () => {
      expect(cut("parts.las", ["one", "two"]).stderr).toMatch(/EXPORT_MIXED/);
      expect(cut("parts.csv", ["one", "two"], "--line-crs", "source").stderr).toMatch(/OPTION_CRS/);
    });
  },
);

describe.skipIf(REFUSED)("a profile along an alignment", () => {
  let folder = "";
  beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), "groma-alignment-"));
  });
  afterAll(() => rmSync(folder, { recursive: true }));

  it("counts along true arcs, with the stations of LandXML and its equations, to LandXML again", () => {
    const axis = join(folder, "axis.xml");
    writeFileSync(
      axis,
      `<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2"><Units><Metric linearUnit="meter"/></Units>
<Alignments><Alignment name="road" staStart="1000" length="0"><CoordGeom>
<Line><Start>231400 589600</Start><End>231400 589700</End></Line>
<Curve rot="ccw"><Start>231400 589700</Start><Center>231500 589700</Center><End>231500 589800</End></Curve>
</CoordGeom><StaEquation staInternal="1100" staAhead="5000"/></Alignment></Alignments></LandXML>`,
    );
    const run = (out: string, ...options: string[]) =>
      groma([
        ...["profile", converted(road.path), "--line", axis, "--width", "20", "--overwrite"],
        ...["--out", join(folder, out), ...options],
      ]);
    expect(run("sections.xml", "--sections", "--interval", "50")).toMatchObject({ code: 0 });
    const xml = readFileSync(join(folder, "sections.xml"), "utf8");
    expect(xml).toContain('staStart="1000.00000"');
    expect(xml).toContain(
      '<StaEquation staInternal="1100.00000" staAhead="5000.00000" staIncrement="increasing"/>',
    );
    const length = Number(/ length="([\d.]+)" staStart/.exec(xml)![1]);
    expect(length).toBeCloseTo(100 + 50 * Math.PI, 4);
    expect(run("sections.zip", "--sections", "--at", "1050,1150", "--files", "csv")).toMatchObject({
      code: 0,
    });
    const zip = readFileSync(join(folder, "sections.zip"), "latin1");
    expect(zip).toContain("section-1_1+050.000.csv");
    expect(zip).toContain("section-2_5+050.000.csv");
    expect(run("profile.csv", "--line-name", "rail").stderr).toMatch(/FORMAT_ALIGNMENT.*"road"/s);
  });

  it("is the same in feet as in metres: stations, equations, geodesics, and equations from another start", {
    timeout: 240_000,
  }, () => {
    const write = (name: string, linearUnit: string, unit: number) => {
      const [start, internal, ahead, y, x, north, east] = [
        1000, 1100, 2000, 231350, 589600, 231450, 589800,
      ].map((metres) => metres / unit);
      const file = join(folder, name);
      writeFileSync(
        file,
        `<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2"><Units><Imperial linearUnit="${linearUnit}"/></Units>
<Alignments><Alignment name="road" staStart="${start}" length="0"><CoordGeom><Line><Start>${y} ${x}</Start><End>${north} ${east}</End></Line></CoordGeom>
<StaEquation staInternal="${internal}" staAhead="${ahead}"/></Alignment></Alignments></LandXML>`,
      );
      return file;
    };
    const files = [write("m.xml", "meter", 1), write("ft.xml", "foot", 0.3048)];
    const sections = (line: string, ...options: string[]) => {
      const run = groma([
        ...["profile", converted(road.path), converted(road.path), "--line", line, "--width", "20"],
        ...[
          "--sections",
          "--interval",
          "50",
          "--files",
          "csv",
          "--out",
          join(folder, "s.zip"),
          "--overwrite",
        ],
        ...options,
      ]);
      expect(run).toMatchObject({ code: 0 });
      // One file named twice is one file.
      expect(run.stdout).toContain("from 1 file");
      const zip = readFileSync(join(folder, "s.zip"), "latin1");
      const rows = zip.slice(zip.lastIndexOf("section,station,")).split("sections.xml")[0]!.split("\r\n");
      return rows.slice(1, -1).map((row) => row.split(","));
    };
    const named = (rows: string[][]) => rows.map(([, station]) => station);
    for (const options of [
      ["--stations", "geodesic"],
      ["--start", "0"],
    ]) {
      const [metres, feet] = files.map((line) => sections(line, ...options));
      expect(named(feet!)).toEqual(named(metres!));
      for (const [index, row] of feet!.entries())
        for (const column of [2, 3, 4]) {
          const other = Number(metres![index]![column]);
          expect(Math.abs(Number(row[column]) - other)).toBeLessThan(1e-6);
        }
      // The equation stands 100 m from the start, wherever that begins.
      const from = options[1] === "0" ? "0+" : "1+";
      expect(named(feet!).slice(0, 3)).toEqual([`${from}000.000`, `${from}050.000`, "2+000.000"]);
    }
  });
});
