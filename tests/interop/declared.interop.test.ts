import { spawnSync } from "node:child_process";
import { rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing, makeFolder } from "./core.js";
import { groma, gromaJson } from "./groma.js";

/** A file to be made; see declared.py. */
interface Job {
  version: string;
  format: number;
  wktBit: boolean;
  rows: readonly (readonly number[])[];
  wkt?: string;
  keys?: readonly (readonly [number, number])[];
}

interface Told {
  crs: { code?: string; height: { kind: string; epsg?: number }; verticalUnit: { size: number } };
  crsFrom: string;
  crsNotes: { code: string; text: string }[];
  operation: { notes: string[]; name: string; accuracy: number | null } | null;
  geodeticBounds: { highest: number } | null;
  records: { userId: string; recordId: number }[];
}

const table = createRequire(import.meta.url)("epsg-index/all.json") as Record<string, { wkt: string }>;
const wkt = (code: number) => table[code]!.wkt;
const keys = (code: number, ...more: [number, number][]) =>
  [[1024, 1], [3072, code], [3076, 9001], ...more] as const;
/** South-west of Stuttgart in UTM 32. */
const ROWS = [
  [500000, 5400000, 300],
  [500200, 5400100, 330],
  [500100, 5400200, 310],
] as const;

/** The report files of public bug trackers, made again. */
const JOBS = {
  "bit-off-6": { version: "1.4", format: 6, wktBit: false, rows: ROWS, wkt: wkt(25832), keys: keys(25833) },
  "bit-on-6": { version: "1.4", format: 6, wktBit: true, rows: ROWS, wkt: wkt(25832), keys: keys(25833) },
  "bit-off-1": { version: "1.4", format: 1, wktBit: false, rows: ROWS, wkt: wkt(25832), keys: keys(25833) },
  "feet-by-keys": {
    ...{
      version: "1.4",
      format: 6,
      wktBit: true,
      rows: [
        [580000, 4500000, 500],
        [580200, 4500200, 530],
      ],
    },
    ...{ wkt: wkt(26918), keys: keys(26918, [4096, 6360], [4099, 9003]) },
  },
  "tile-keys": { version: "1.2", format: 1, wktBit: false, rows: ROWS, keys: keys(25832) },
  "tile-wkt": { version: "1.4", format: 1, wktBit: true, rows: ROWS, wkt: wkt(25832) },
  "tile-no-axes": {
    ...{ version: "1.4", format: 1, wktBit: true, rows: ROWS },
    wkt: wkt(25832).replace(/,AXIS\[[^\]]*\]/g, ""),
  },
  "tile-no-codes": {
    ...{ version: "1.4", format: 1, wktBit: true, rows: ROWS },
    wkt: wkt(25832).replace(/,AUTHORITY\[[^\]]*\]/g, ""),
  },
  "tile-far": { version: "1.4", format: 1, wktBit: true, rows: ROWS, wkt: wkt(25833) },
  "tile-dhhn": {
    ...{ version: "1.4", format: 1, wktBit: true, rows: ROWS },
    wkt: `COMPD_CS["ETRS89 / UTM 32N + DHHN2016",${wkt(25832)},${wkt(7837)}]`,
  },
  "dutch-as-utm": {
    ...{ version: "1.4", format: 6, wktBit: true, wkt: wkt(25832) },
    rows: ROWS.map(([x, y, z]) => [x - 345000, y - 4937000, z]),
  },
} satisfies Record<string, Job>;

const projMissing = spawnSync("cct", ["--version"]).error !== undefined;
const skipped = coreMissing ?? pythonMissing;

describe.skipIf(skipped)(
  `what files declare${skipped ? ` (skipped: ${skipped})` : ""}`,
  { timeout: 60_000 },
  () => {
    const folder = makeFolder();
    const file = (name: keyof typeof JOBS) => join(folder, `${name}.las`);
    let made = 0;

    /** Converts by proj4js and returns what the output tells. */
    function converted(names: readonly (keyof typeof JOBS)[], ...options: string[]): Told {
      const out = join(folder, `${++made}.copc.laz`);
      const { code, stderr } = groma(["convert", ...names.map(file), out, "--engine", "proj4js", ...options]);
      if (code !== 0) throw new Error(stderr);
      return gromaJson<Told>(["info", out, "--json"]);
    }

    beforeAll(() => {
      const jobs = Object.entries(JOBS).map(([name, job]) => ({ ...job, path: join(folder, `${name}.las`) }));
      expect(runPython("interop/declared.py", [], JSON.stringify(jobs))).toHaveLength(jobs.length);
    });
    afterAll(() => rmSync(folder, { recursive: true, force: true }));

    it.each([
      ["bit-off-6", "WKT", "EPSG:25832"],
      ["bit-on-6", "WKT", "EPSG:25832"],
      ["bit-off-1", "GeoTIFF keys", "EPSG:25833"],
    ] as const)(
      "in contradiction is settled by the header, told, and gone from the output: %s",
      (name, from, code) => {
        const told = gromaJson<Told>(["info", file(name), "--json"]);
        expect([told.crsFrom, told.crs.code]).toEqual([from, code]);
        expect(told.crsNotes).toMatchObject([{ code: "CRS_CONTRADICTION" }]);

        const output = converted([name]);
        expect(output.crs.code).toBe(code);
        expect(output.operation?.notes).toContainEqual(told.crsNotes[0]!.text);
        const records = output.records.filter(({ userId }) => userId === "LASF_Projection");
        expect(records.map(({ recordId }) => recordId)).toEqual([2112]);
      },
    );

    it("of heights in keys alone holds, feet and all", () => {
      const output = converted(["feet-by-keys"]);
      expect(output.crs).toMatchObject({ code: "EPSG:26918+6360", height: { kind: "geoid", epsg: 6360 } });
      expect(output.crs.verticalUnit.size).toBe(1200 / 3937);
      expect(output.operation?.notes.join()).toMatch(/NAVD88 height \(ftUS\).*taken from the GeoTIFF keys/);
    });

    it.skipIf(projMissing)("keeps the unit of heights under another reference, and its plane", () => {
      for (const engine of ["proj", "proj4js"]) {
        const highest = (...given: string[]) => converted(["feet-by-keys"], "--engine", engine, ...given);
        const own = highest();
        const other = highest("--vertical", "EPSG:5703");
        expect(other.crs).toMatchObject({ code: "EPSG:26918+5703", verticalUnit: { size: 1200 / 3937 } });
        expect(other.operation?.notes.join()).toMatch(/z stays in US survey foot/);
        // One zero, NAVD88: whatever it is called, z is as high.
        expect(other.geodeticBounds!.highest).toBeCloseTo(own.geodeticBounds!.highest, 3);

        const flat = highest("--vertical", "ellipsoidal");
        expect(flat.geodeticBounds!.highest).toBeCloseTo((530 * 1200) / 3937, 3);
        expect(flat.crs.code).toBe("EPSG:26918");
        expect(flat.operation).toMatchObject({
          accuracy: 4,
          name: expect.stringMatching(/NAD83|North American/),
        });
      }
    });

    it("says that its heights were given", () => {
      const plan = groma([
        "convert",
        file("tile-keys"),
        join(folder, "p.laz"),
        "--dry-run",
        "--vertical",
        "EPSG:7837",
      ]);
      expect(plan.stdout).toMatch(/^place .* \(GeoTIFF keys; height given\)$/m);
    });

    it("in four spellings is one system", () => {
      const tiles = ["tile-keys", "tile-wkt", "tile-no-axes", "tile-no-codes"] as const;
      expect(converted(tiles).crs.code).toBe("EPSG:25832");
      expect(converted([...tiles, "tile-far"], "--crs", "EPSG:25832").crs.code).toBe("EPSG:25832");
    });

    it("in two systems is refused with the list; heights too, until they are given", () => {
      const out = join(folder, "none.copc.laz");
      const far = groma(["convert", file("tile-keys"), file("tile-far"), out]);
      expect([far.code, far.stderr]).toEqual([
        1,
        expect.stringMatching(/^CRS_MIXED: .*zone 32N.*zone 33N.*--crs/),
      ]);
      const heights = groma(["convert", file("tile-wkt"), file("tile-dhhn"), out, "--crs", "EPSG:25832"]);
      expect([heights.code, heights.stderr]).toEqual([1, expect.stringMatching(/^CRS_MIXED: .*--vertical/)]);
      const settled = converted(["tile-wkt", "tile-dhhn"], "--vertical", "EPSG:7837");
      expect(settled.crs.code).toBe("EPSG:25832+7837");
    });

    it("keeps its heights under a plane that is given, and the output says both", () => {
      const output = converted(["tile-dhhn"], "--crs", "EPSG:25832");
      expect(output.crs.code).toBe("EPSG:25832+7837");
      expect(output.operation?.notes.join()).toMatch(/DHHN2016 height .*is kept from the file/);
    });

    it("is held against the place: Dutch numbers declared as UTM 32", () => {
      const out = join(folder, "dutch.copc.laz");
      const args = ["convert", file("dutch-as-utm"), out, "--engine", "proj4js"];
      const { stdout } = groma([...args, "--progress", "json"]);
      const lines = stdout
        .trimEnd()
        .split("\n")
        .map((line) => JSON.parse(line));
      const warned = lines.filter(({ event }) => event === "warning");
      expect(warned).toMatchObject([{ code: "CRS_AREA", text: expect.stringContaining("EPSG:28992") }]);
      expect(lines.at(-1)).toMatchObject({ event: "done", centre: { longitude: expect.closeTo(5.895, 2) } });
      const plan = groma([...args, "--dry-run", "--overwrite"]);
      const again = groma([...args, "--overwrite"]);
      for (const { stdout: said, stderr } of [plan, again])
        expect(`${said}${stderr}`.match(/EPSG:28992/g), "said once").toHaveLength(1);
      expect(plan.stdout).toMatch(/^note .*EPSG:28992/m);
      expect(plan.stdout).toMatch(/^centre {3}longitude 5\.89\d\d°, latitude 4\.18\d\d°$/m);
      expect(groma(["info", out]).stdout).toMatch(
        /^centre .*\n(?:note .*\n)*note .*outside of the area of use/m,
      );
    });
  },
);
