import { describe, expect, it } from "vitest";
import { Clip, ClipSet } from "../clips/index.js";
import { Corridor } from "../tools/profile/corridor.js";
import { MemorySink } from "./byte-sink.js";
import { exportCsv } from "./csv.js";
import { exportLas } from "./las.js";
import { type ExportedPoints, exportPoints, type PointExportOptions } from "./points.js";
import { scanOf } from "./scan.fixture.js";

const points = Array.from({ length: 20 }, (_, index) => ({
  xyz: [100 * index, 200, 10 * index] as const,
  classification: index % 3,
  colour: [index, 0, 0] as const,
}));
const scan = scanOf(points);

/** The same scan as it lies on a globe: source x, y and z are metres of ECEF about a place of the equator. */
const placed = {
  ...scan,
  boundingBox: { min: [0, 0, 0], max: [20, 2, 2] } as const,
  place: (x: number, y: number, z: number, out: Float64Array) => {
    out.set([6_378_137 + z, x, y]);
    return out;
  },
};

const textOf = (sink: MemorySink) => sink.blob().text();

async function csv(from: ExportedPoints, options: PointExportOptions = {}): Promise<string[]> {
  const sink = new MemorySink();
  const count = await exportPoints(from, sink, { ...options, format: "csv" });
  const rows = (await textOf(sink)).trimEnd().split("\r\n").slice(1);
  expect(rows).toHaveLength(count);
  return rows.map((row) => row.split(",")[0]);
}

describe("points of a data set, a profile, or what clips leave of them", () => {
  it("have the bytes that each format's own export writes", async () => {
    const strip = new Corridor(
      [
        [3, 2],
        [9, 2],
      ],
      1,
    );
    const selection = { origin: scan, volume: strip, along: strip };
    const [here, there] = [new MemorySink(), new MemorySink()];
    expect(await exportPoints(selection, here, { chainage: true })).toBe(7);
    await exportLas([selection], there, { chainage: true });
    expect(await textOf(here)).toBe(await textOf(there));
    const [whole, every] = [new MemorySink(), new MemorySink()];
    expect(await exportPoints([scan], whole, { format: "csv" })).toBe(20);
    await exportCsv([{ origin: scan }], every);
    expect(await textOf(whole)).toBe(await textOf(every));
  });

  it("are those inside clips, of classes, and those that a filter lets pass", async () => {
    const clips = new ClipSet([Clip.plane({ through: { source: [9.5, 2, 0] }, heading: Math.PI / 2 })]);
    const eastern = [
      "10.00",
      "11.00",
      "12.00",
      "13.00",
      "14.00",
      "15.00",
      "16.00",
      "17.00",
      "18.00",
      "19.00",
    ];
    expect(await csv(placed, { clips })).toEqual(eastern);
    expect(await csv(placed, { clips, classes: [0] })).toEqual(["12.00", "15.00", "18.00"]);
    expect(await csv(scan, { filter: { classes: [2], ranges: { red: [5, 11] } } })).toEqual([
      ...["5.00", "8.00", "11.00"],
    ]);
    expect(await csv(scan, { filter: { ranges: { elevation: [0.55, 0.75] } } })).toEqual(["6.00", "7.00"]);
    const high = await csv(placed, { filter: { ranges: { ellipsoidalHeight: [1.75, 3] } } });
    expect(high).toEqual(["18.00", "19.00"]);
  });

  it("are refused where their place is asked for and not known, and options that are none", async () => {
    const sink = new MemorySink();
    const clips = new ClipSet([Clip.plane({ through: { source: [9.5, 2, 0] } })]);
    const refused = (from: ExportedPoints, options: object) => exportPoints(from, sink, options);
    await expect(refused(scan, { clips })).rejects.toMatchObject({ code: "EXPORT_NO_PLACE" });
    await expect(refused(scan, { format: "geojson" })).rejects.toMatchObject({ code: "EXPORT_NO_PLACE" });
    await expect(refused(scan, { format: "shp" })).rejects.toMatchObject({ code: "STYLE_OPTION" });
    await expect(refused(scan, { clip: clips })).rejects.toMatchObject({ code: "STYLE_OPTION" });
    const styled = { ...placed, attributes: [{ name: "red", kind: "scalar", range: undefined }] };
    const misspelt = { filter: { ranges: { rde: [0, 1] } } };
    await expect(refused(styled, misspelt)).rejects.toMatchObject({ code: "STYLE_FILTER" });
    expect(sink.blob().size).toBe(0);
  });
});
