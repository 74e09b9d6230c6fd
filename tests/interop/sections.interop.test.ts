import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { Clip } from "../../layer/src/clips/index.js";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing } from "./core.js";
import { groma } from "./groma.js";

const road = data("vol_total.laz");
const REFUSED = road.missing ?? coreMissing ?? pythonMissing;

describe.skipIf(REFUSED)(`cross-sections of a real scan${REFUSED ? ` (skipped: ${REFUSED})` : ""}`, () => {
  let folder = "";
  let axis = "";
  /** Points of the sections, without clips and with them. */
  const counts: number[][] = [];
  beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), "groma-sections-"));
    axis = join(folder, "axis.geojson");
    const coordinates = [
      [589600, 231350],
      [589800, 231450],
      [589900, 231450],
    ];
    writeFileSync(axis, JSON.stringify({ type: "LineString", coordinates }));
  });
  afterAll(() => rmSync(folder, { recursive: true }));

  const cut = (out: string, ...options: string[]) =>
    groma([
      ...["profile", converted(road.path), "--line", axis, "--line-crs", "source", "--width", "60"],
      ...["--out", join(folder, out), "--overwrite", ...options],
    ]);

  it("have just the records in their rectangles, and the ground of these, in one archive", {
    timeout: 240_000,
  }, () => {
    const options = ["--sections", "--interval", "5", "--thickness", "1", "--ground", "p10"];
    const run = cut("sections.zip", ...options, "--files", "las,dxf,laz");
    expect(run).toMatchObject({ code: 0 });
    const zip = join(folder, "sections.zip");
    const found = runPython<Record<string, unknown>>("interop/sections.py", [road.path, zip, "1"]);
    expect(found).toMatchObject({ sections: 66, same: true, faults: [], grounds: true, drawn: true });
    expect(found.points).toBeGreaterThan(8000);
    // Sections at round coordinates have points of the lattice of 1 cm on their edges.
    expect(found.doubtful).toBeGreaterThan(0);
  });

  it.each(["", "clips.json"])("are what a profile along the section alone is, byte for byte %s", (given) => {
    const ring = [
      [589500, 231300],
      [589900, 231300],
      [589870, 231447],
      [589500, 231367],
    ] as const;
    const clips = given === "" ? [] : ["--clips", join(folder, given)];
    if (clips[1])
      writeFileSync(
        clips[1],
        JSON.stringify([Clip.polygon(ring, { coordinates: "source", mode: "inside" })]),
      );
    const run = cut("one.zip", "--sections", "--at", "40,260", "--files", "las", ...clips);
    expect(run).toMatchObject({ code: 0 });
    execFileSync("python3", ["-m", "zipfile", "-e", join(folder, "one.zip"), folder]);
    const rows = readFileSync(join(folder, "sections.csv"), "utf8").trim().split("\r\n").slice(1);
    expect(rows).toHaveLength(2);
    counts.push(rows.map((row) => Number(row.split(",").at(-1))));
    for (const row of rows) {
      const [number, station, , , , ...ends] = row.split(",");
      const [leftX, leftY, rightX, rightY] = ends.map(Number);
      const line = join(folder, "section.geojson");
      const coordinates = [
        [leftX, leftY],
        [rightX, rightY],
      ];
      writeFileSync(line, JSON.stringify({ type: "LineString", coordinates }));
      const out = join(folder, "alone.las");
      const run = groma([
        ...["profile", converted(road.path), "--line", line, "--line-crs", "source", "--width", "0.5"],
        ...["--out", out, "--overwrite", ...clips],
      ]);
      expect(run).toMatchObject({ code: 0 });
      const together = readFileSync(join(folder, `section-${number}_${station}.las`));
      expect(Buffer.compare(together, readFileSync(out))).toBe(0);
    }
    // The clips leave some of the points of each section, and not all.
    if (clips[1])
      for (const [index, count] of counts[1]!.entries()) {
        expect(count).toBeGreaterThan(0);
        expect(count).toBeLessThan(counts[0]![index]!);
      }
  });

  it("name the classes that are there where those asked for are not, and nothing is empty without a word", {
    timeout: 240_000,
  }, () => {
    const ground = cut("ground.xml", "--ground-classes", "77");
    expect(ground).toMatchObject({ code: 0 });
    expect(ground.stderr).toMatch(
      /warning: .*ground\.xml has no ground: no point is of class 77 \(user defined\); there are \d+ \(/,
    );
    const present = /there are (\d+)/.exec(ground.stderr)![1]!;
    const there = cut("ground.xml", "--ground-classes", `${present},77`);
    expect(there).toMatchObject({ code: 0 });
    expect(there.stderr).not.toContain("warning");
    for (const [out, ...options] of [["classes.las"], ["classes.zip", "--sections", "--at", "40"]] as const) {
      const none = cut(out, ...options, "--classes", "77");
      expect(none.code).toBe(1);
      expect(none.stderr).toMatch(new RegExp(`SELECTION_EMPTY: .*whose classes are .*\\b${present} \\(`));
    }
  });

  it("lie at the end of the line where that is given as it is printed; DXF and list bear the stations of equations", {
    timeout: 240_000,
  }, () => {
    const alignment = join(folder, "axis.xml");
    const places = ["231350 589600", "231450 589800", "231450 589900"];
    const stretch = (from: number) =>
      `<Line><Start>${places[from]}</Start><End>${places[from + 1]}</End></Line>`;
    writeFileSync(
      alignment,
      `<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2"><Alignments><Alignment name="axis" length="323.60680" staStart="1000">
      <CoordGeom>${stretch(0)}${stretch(1)}</CoordGeom><StaEquation staInternal="1200" staAhead="5000"/></Alignment></Alignments></LandXML>`,
    );
    // The line is 223.60679774997897 + 100 long.
    const ends = cut(
      "ends.zip",
      "--line",
      alignment,
      "--sections",
      "--at",
      "1100,1323.607",
      "--files",
      "csv",
    );
    expect(ends).toMatchObject({ code: 0 });
    const zip = readFileSync(join(folder, "ends.zip"), "latin1");
    expect(zip).toContain("\r\n1,1+100.000,1100,");
    expect(zip).toContain("\r\n2,5+123.607,1323.606797749979,589900,231450,");
    expect(zip).toContain(
      '<StaEquation staInternal="1200.00000" staAhead="5000.00000" staIncrement="increasing"/>',
    );
    const beyond = cut("beyond.zip", "--line", alignment, "--sections", "--at", "1323.608");
    expect(beyond.stderr).toContain("no chainage 1323.608: it is 1000 to 1323.606797749979");
    expect(cut("axis.dxf", "--line", alignment)).toMatchObject({ code: 0 });
    const texts = readFileSync(join(folder, "axis.dxf"), "latin1").match(/(?<=\n1\n)\d+\.\d\d(?=\n)/g);
    expect(texts).toEqual(["1000.00", "5023.61", "5123.61"]);
    expect(cut("axis.svg", "--line", alignment)).toMatchObject({ code: 0 });
    const marks = readFileSync(join(folder, "axis.svg"), "utf8").match(/(?<=>)\d\+\d{3}(?=<)/g);
    expect(marks).toEqual(
      [0, 20, 40, 60, 80, 100, 120, 140, 160, 180]
        .map((at) => `1+${String(at).padStart(3, "0")}`)
        .concat([0, 20, 40, 60, 80, 100, 120].map((at) => `5+${String(at).padStart(3, "0")}`)),
    );
  });

  it("are refused in formats and at stations that there are not, before anything is read", {
    timeout: 240_000,
  }, () => {
    const refusals: [string[], RegExp][] = [
      [["sections.las", "--sections", "--interval", "5"], /OPTION_FORMAT.*cross-sections/s],
      [["sections.zip", "--sections"], /--sections requires --interval or --at/],
      [["profile.pdf", "--interval", "5"], /--interval and --at require --sections/],
      [["sections.zip", "--sections", "--at", "5000"], /OPTION_SECTIONS.*no chainage 5000/s],
      [["sections.zip", "--sections", "--at", "5", "--files", "tiff"], /Expected some of las/],
      [["profile.xml", "--ground", "p101"], /percentile from p0 to p100/],
      [["profile.xml", "--ground-interval", "1e-6"], /^OPTION_GROUND.*--ground-interval/s],
      [["profile.svg", "--color-by", "intensities"], /^STYLE_COLOR.*intensit/s],
      [["profile.svg", "--color-range", "0,9"], /--color-range requires --color-by/],
    ];
    for (const [[out, ...options], message] of refusals) {
      const run = cut(out!, ...options);
      expect(run.code).not.toBe(0);
      expect(run.stderr).toMatch(message);
    }
  });
});
