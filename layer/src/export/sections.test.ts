import { describe, expect, it } from "vitest";
import { Corridor } from "../tools/profile/corridor.js";
import { CrossSections } from "../tools/sections/cross-sections.js";
import type { BlockStore } from "./block-store.js";
import { MemorySink } from "./byte-sink.js";
import { collectParts } from "./collect.js";
import { exportCsv } from "./csv.js";
import { exportLandXml, exportPicture } from "./documents.js";
import { exportDxf } from "./dxf.js";
import { exportGeoJson } from "./geojson.js";
import { exportLas } from "./las.js";
import { type FixturePoint, scanOf } from "./scan.fixture.js";
import { exportSectionLandXml, exportSections } from "./sections.js";

const METRE = { text: "m", size: 1 };
const FACTS = {
  title: "a <dike> & more",
  crs: "RD New",
  epsg: 28992,
  heights: "NAP",
  unit: METRE,
  heightUnit: METRE,
};
const DATE = new Date(Date.UTC(2026, 0, 2, 3, 4, 5));

/** A plane that rises by 1 to the east and 0.1 to the north, a point each metre. */
const PLANE: FixturePoint[] = Array.from({ length: 21 * 21 }, (_, index) => {
  const [x, y] = [index % 21, Math.floor(index / 21)];
  return { xyz: [100 * x, 100 * y, 100 * x + 10 * y], classification: x % 2 };
});
const LINE = new Corridor(
  [
    [10, 0],
    [10, 20],
  ],
  1,
);
const WIDTHS = { left: 3, right: 2, thickness: 1 };
const volume = new CrossSections(LINE, [5, 10, 10.25], WIDTHS);
const options = { facts: FACTS, line: LINE, date: DATE, scale: 200 };

async function written(write: (sink: MemorySink) => Promise<unknown>): Promise<Uint8Array> {
  const sink = new MemorySink();
  await write(sink);
  return new Uint8Array(await sink.blob().arrayBuffer());
}

/** Files of an archive whose files are stored as they are, by its central directory (APPNOTE 6.3, 4.3.12). */
function filesOf(zip: Uint8Array): Map<string, Uint8Array> {
  const view = new DataView(zip.buffer, zip.byteOffset);
  const text = new TextDecoder();
  const files = new Map<string, Uint8Array>();
  let end = zip.length - 22;
  while (view.getUint32(end, true) !== 0x06054b50) end--;
  let at = view.getUint32(end + 16, true);
  while (view.getUint32(at, true) === 0x02014b50) {
    const [size, name, extra] = [
      view.getUint32(at + 24, true),
      view.getUint16(at + 28, true),
      view.getUint16(at + 30, true),
    ];
    const local = view.getUint32(at + 42, true);
    const begin = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
    files.set(text.decode(zip.subarray(at + 46, at + 46 + name)), zip.slice(begin, begin + size));
    at += 46 + name + extra;
  }
  return files;
}

describe("parts of a scan", () => {
  it("are collected in one pass, each with the records and the order that it alone would have", async () => {
    for (const blocks of [undefined, 1]) {
      const scan = scanOf(PLANE, 7);
      let queries = 0;
      const counted = {
        ...scan,
        query: (...given: Parameters<typeof scan.query>) => {
          queries++;
          return scan.query(...given);
        },
      };
      const kept: Uint8Array[] = [];
      const store: BlockStore = {
        put: async (bytes) => kept.push(bytes.slice()) - 1,
        get: async (block) => kept[block as number],
      };
      const many = blocks ? Array.from({ length: 2500 }, () => PLANE[10 + 21 * 5]) : [];
      const origin = blocks ? scanOf([...PLANE, ...many], 1000) : counted;
      const parts = await collectParts([{ origin, volume }], store);
      expect(parts).toHaveLength(3);
      if (blocks) expect(kept.length).toBeGreaterThan(0);
      else expect(queries).toBe(1);
      for (const [part, selections] of parts.entries()) {
        const { strip } = volume.sections[part];
        const alone = await written((sink) => exportLas([{ origin, volume: strip }], sink));
        expect(await written((sink) => exportLas(selections, sink))).toEqual(alone);
        const csv = await written((sink) => exportCsv([{ origin, volume: strip, along: strip }], sink));
        const along = selections.map((one) => ({ ...one, along: strip }));
        expect(await written((sink) => exportCsv(along, sink))).toEqual(csv);
      }
    }
  });

  it("keep only the classes that are wanted", async () => {
    const classes = new Set([1]);
    const store = { put: async () => 0, get: async () => new Uint8Array() };
    const [first] = await collectParts([{ origin: scanOf(PLANE), volume, classes }], store);
    // x from 7 to 12 at y = 5: of class 1 are 7, 9, 11.
    expect((await first[0].origin.query().bracket()).least).toBe(3);
  });
});

it("files of which points were left out name the spacing", async () => {
  const along = volume.sections[0].strip;
  const thinned = [{ origin: scanOf(PLANE), volume: along, along, spacing: 2.5 }];
  const text = async (write: (sink: MemorySink) => Promise<unknown>) =>
    new TextDecoder("latin1").decode(await written(write));
  expect(await text((sink) => exportLas(thinned, sink))).toContain("thinned: one point in about 2.5\0");
  expect(await text((sink) => exportCsv(thinned, sink))).toMatch(/,spacing\r\n.*,2\.5\r\n/);
  expect(await text((sink) => exportGeoJson(thinned, sink))).toContain('"spacing":2.5,"features"');
  expect(await text((sink) => exportDxf(thinned, sink))).toMatch(/^999\nthinned: one point in about 2\.5\n/);
  const xml = await text((sink) => exportLandXml(thinned, sink, { facts: FACTS, date: DATE }));
  expect(xml).toContain("every 1 m; thinned: one in about 2.5 m");
  const svg = await text((sink) => exportPicture(thinned, sink, { facts: FACTS, format: "svg", scale: 200 }));
  expect(svg).toContain("6 points, thinned: one in about 2.5 m");
});

describe("an archive of cross-sections", () => {
  it("has the files of each section, a list of all and LandXML, the same bytes each time", async () => {
    const selections = [{ origin: scanOf(PLANE), volume }];
    const make = () =>
      written((sink) =>
        exportSections(selections, sink, { ...options, files: ["las", "csv", "dxf", "svg"] }),
      );
    const zip = await make();
    expect(await make()).toEqual(zip);
    const files = filesOf(zip);
    const names = ["1_0+005.000", "2_0+010.000", "3_0+010.250"].flatMap((section) =>
      ["las", "csv", "dxf", "svg"].map((ending) => `section-${section}.${ending}`),
    );
    expect([...files.keys()]).toEqual([...names, "sections.csv", "sections.xml"]);
    const text = (name: string) => new TextDecoder().decode(files.get(name));
    expect(text("sections.csv").split("\r\n")[1]).toBe("1,0+005.000,5,10,5,7,5,12,5,6");
    expect(text("section-1_0+005.000.csv").split("\r\n").slice(0, 2)).toEqual([
      "x,y,z,chainage,offset,classification,red,green,blue",
      "7.00,5.00,7.50,-3.00000,0.00000,1,0,0,0",
    ]);
    expect(text("section-1_0+005.000.dxf")).toContain(
      "0\nPOINT\n8\nPOINTS\n10\n-3.00000\n20\n7.50\n30\n0.00000\n",
    );
    // A grid in round numbers around the points, from -3 to 2 across and 7.5 to 12.5 up.
    expect(text("section-1_0+005.000.dxf")).toContain(
      "0\nLINE\n8\nGRID\n10\n-3\n20\n8\n30\n0\n11\n2\n21\n8\n31\n0\n",
    );
    expect(text("section-1_0+005.000.dxf").match(/8\nTEXT\n/g)!.length).toBeGreaterThan(10);
    expect(text("section-1_0+005.000.svg")).toContain(
      "a &lt;dike&gt; &amp; more, section 1, station 0+005.000",
    );
  });

  it("has a place in the list, but no files, for a section without points", async () => {
    const beyond = new CrossSections(LINE, [5, 6.5], { ...WIDTHS, thickness: 0.5 });
    const zip = await written((sink) =>
      exportSections([{ origin: scanOf(PLANE), volume: beyond }], sink, { ...options, files: ["las"] }),
    );
    const files = filesOf(zip);
    expect([...files.keys()]).toEqual(["section-1_0+005.000.las", "sections.csv", "sections.xml"]);
    expect(new TextDecoder().decode(files.get("sections.csv"))).toContain(
      "2,0+006.500,6.5,10,6.5,7,6.5,12,6.5,0",
    );
  });

  it("writes LandXML of all sections: distances negative to the left, gaps as lists of their own", async () => {
    const gap = PLANE.filter(({ xyz: [x] }) => x !== 900);
    const bytes = await written((sink) =>
      exportSectionLandXml([{ origin: scanOf(gap), volume }], sink, {
        ...options,
        ground: { interval: 1, statistic: "mean" },
      }),
    );
    const xml = new TextDecoder().decode(bytes);
    expect(xml).toContain('version="1.2" date="2026-01-02" time="03:04:05"');
    expect(xml).toContain(
      '<Alignment name="a &lt;dike&gt; &amp; more" length="20.00000" staStart="0.00000">',
    );
    expect(xml).toContain("<Start>0.00000 10.00000</Start><End>20.00000 10.00000</End>");
    expect(xml).toContain('<CoordinateSystem name="RD New" epsgCode="28992" desc="RD New, heights NAP"/>');
    const first = xml.slice(xml.indexOf('sta="5.00000"'), xml.indexOf('sta="10.00000"'));
    expect(first.match(/<PntList2D>.*<\/PntList2D>/g)).toEqual([
      "<PntList2D>-3.00000 7.50000 -2.00000 8.50000</PntList2D>",
      "<PntList2D>0.00000 10.50000 1.00000 11.50000 2.00000 12.50000</PntList2D>",
    ]);
  });

  it("writes LandXML in the foot of the scan, and heights in the same unit", async () => {
    const foot = { text: "US ft", size: 1200 / 3937 };
    const facts = { ...FACTS, unit: foot, heightUnit: METRE };
    const bytes = await written((sink) =>
      exportSectionLandXml([{ origin: scanOf(PLANE), volume }], sink, { ...options, facts }),
    );
    const xml = new TextDecoder().decode(bytes);
    expect(xml).toContain('linearUnit="USSurveyFoot"');
    expect(xml).toContain(`-3.00000 ${((7.5 * 3937) / 1200).toFixed(5)} `);
  });
});
