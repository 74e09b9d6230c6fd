import { describe, expect, it } from "vitest";
import type { PointBatch, PointOrigin } from "../query/index.js";
import { eachAlong } from "./along.js";
import { MemorySink } from "./byte-sink.js";
import { exportCsv } from "./csv.js";
import { exportDxf } from "./dxf.js";
import { exportGeoJson } from "./geojson.js";
import type { PointSelection } from "./selection.js";

/** Two points with an attribute of each kind, one of them with a name that a table program takes for a formula. */
function selectionOf(scale = 0.01, name = '=1+"1"'): PointSelection {
  const ids = new Uint8Array(new BigUint64Array([7n, 2n ** 63n]).buffer);
  const pairs = new Uint8Array(new Float32Array([1.5, -2, Number.NaN, 4]).buffer);
  const common = { description: "", kind: "scalar", at: 0, shift: 0, mask: -1, noData: undefined };
  const attributes = [
    {
      ...common,
      name,
      type: "uint64",
      components: 1,
      scale: [1],
      offset: [0],
      bytes: ids,
      stride: 8,
    },
    {
      ...common,
      name: "pair",
      type: "float32",
      components: 2,
      scale: [1, 1],
      offset: [0, 0],
      bytes: pairs,
      stride: 8,
    },
  ];
  const records = { count: 2, xyz: Int32Array.of(100, -200, 3, 150, 250, -7), attributes };
  const query = {
    bracket: async () => ({ least: 2, most: 2, nodes: 1 }),
    async *batches() {
      yield { node: "0-0-0-0", records, inside: Uint32Array.of(0, 1) } as unknown as PointBatch;
    },
  };
  const origin = { name: "scan", scale: [scale, scale, scale], offset: [600000, 0, 0.5], query: () => query };
  return { origin: origin as unknown as PointOrigin };
}

const along = {
  vertices: [
    [600000, 0],
    [600003, 4],
  ] as const,
  chainages: [0, 5],
  locate(x: number, y: number, out: Float64Array) {
    out.set([x - 600000, y]);
  },
};

async function textOf(write: (sink: MemorySink) => Promise<number>): Promise<string> {
  const sink = new MemorySink();
  expect(await write(sink)).toBe(2);
  return sink.blob().text();
}

describe("CSV", () => {
  it("has every digit of the record, all attributes, and names that are no formulas", async () => {
    const text = await textOf((sink) => exportCsv([{ ...selectionOf(), along }], sink));
    expect(text.split("\r\n")).toEqual([
      `x,y,z,chainage,offset,"'=1+""1""",pair 1,pair 2`,
      "600001.00,-2.00,0.53,1.00000,-2.00000,7,1.5,-2",
      "600001.50,2.50,0.43,1.50000,2.50000,9223372036854775808,,4",
      "",
    ]);
  });

  it.each([
    ["chainage", "x,y,z,chainage,offset,chainage 2,pair 1,pair 2,spacing"],
    ["spacing", "x,y,z,chainage,offset,spacing 2,pair 1,pair 2,spacing"],
    ["pair 1", "x,y,z,chainage,offset,pair 1,pair 1 2,pair 2,spacing"],
  ])("has no two columns of one name where an attribute is called %s", async (name, columns) => {
    const selection = { ...selectionOf(0.01, name), along, spacing: 2 };
    const text = await textOf((sink) => exportCsv([selection], sink));
    expect(text.split("\r\n")[0]).toBe(columns);
  });

  it("gives coordinates of odd scales in full", async () => {
    const text = await textOf((sink) => exportCsv([selectionOf(1 / 3)], sink));
    const [x, y] = text.split("\r\n")[1].split(",").map(Number);
    expect([x, y]).toEqual([100 * (1 / 3) + 600000, -200 * (1 / 3)]);
  });
});

/** A system of the zones of UTM, its heights in a unit of some metres. */
const zone = (number: number, size = 1) =>
  ({
    name: `zone ${number}`,
    proj4: `+proj=utm +zone=${number} +datum=WGS84`,
    horizontalUnit: { name: "metre", size: 1, kind: "linear" },
    verticalUnit: { name: "unit", size, kind: "linear" },
    height: { kind: "unknown" },
  }) as unknown as NonNullable<PointSelection["crs"]>;

describe("data sets of several systems", () => {
  const [west, east] = [31, 32].map((number) => ({ ...selectionOf(), crs: zone(number) }));
  const feet = { ...selectionOf(), crs: zone(31, 0.3048) };
  const none = new MemorySink();

  it("have a column with the name of each point's system in CSV", async () => {
    const sink = new MemorySink();
    expect(await exportCsv([{ ...west, along }, east, selectionOf()], sink)).toBe(6);
    const rows = (await sink.blob().text()).split("\r\n").map((row) => row.split(","));
    expect(rows[0].slice(0, 6)).toEqual(["x", "y", "z", "chainage", "offset", "crs"]);
    expect(rows.slice(1, 7).map((row) => row[5])).toEqual([
      "zone 31",
      "zone 31",
      "zone 32",
      "zone 32",
      "",
      "",
    ]);
    expect(await textOf((to) => exportCsv([east], to))).not.toContain("crs");
  });

  it("are refused by DXF in space where nothing brings them into one plane", async () => {
    await expect(exportDxf([west, east], none)).rejects.toMatchObject({ code: "EXPORT_MIXED" });
    const toPlane = (x: number, y: number, _z: number, out: Float64Array) => out.set([x - 600000, -y]);
    const brought = [west, east].map((one) => ({ ...one, along: { ...along, toPlane } }));
    const sink = new MemorySink();
    expect(await exportDxf(brought, sink)).toBe(4);
    expect(await sink.blob().text()).toContain("POINT\n8\nPOINTS\n10\n1.50000\n20\n-2.50000\n30\n0.43\n");
  });

  it("are refused where heights are in several units, but by CSV and GeoJSON", async () => {
    const mixed = [west, feet].map((one) => ({ ...one, along }));
    for (const layout of ["space", "straightened"] as const)
      await expect(exportDxf(mixed, none, { layout })).rejects.toMatchObject({ code: "EXPORT_MIXED" });
    const point = () => undefined;
    await expect(eachAlong(mixed, {}, point)).rejects.toMatchObject({ code: "EXPORT_MIXED" });
    expect(await eachAlong([west, west], {}, point)).toBe(4);
  });
});

describe("GeoJSON", () => {
  it("has longitude, latitude and height where these are known, and all attributes", async () => {
    const geodetic = (x: number, y: number, z: number, out: Float64Array) => out.set([x / 1e5, y, z]);
    const text = await textOf((sink) => exportGeoJson([{ ...selectionOf(), along, geodetic }], sink));
    const { coordinates, features } = JSON.parse(text);
    expect(coordinates).toBeUndefined();
    expect(features[1]).toEqual({
      type: "Feature",
      geometry: { type: "Point", coordinates: [6.000015, 2.5, 0.43] },
      properties: {
        chainage: 1.5,
        offset: 2.5,
        '=1+"1"': "9223372036854775808",
        "pair 1": null,
        "pair 2": 4,
      },
    });
  });

  it("keeps the chainage where an attribute is called so", async () => {
    const selection = { ...selectionOf(0.01, "chainage"), along };
    const { features } = JSON.parse(await textOf((sink) => exportGeoJson([selection], sink)));
    expect(features[0].properties).toMatchObject({ chainage: 1, "chainage 2": 7 });
  });

  it("says that its coordinates are those of the source", async () => {
    const { coordinates, features } = JSON.parse(
      await textOf((sink) => exportGeoJson([selectionOf()], sink)),
    );
    expect(coordinates).toBe("source");
    expect(features[0].geometry.coordinates).toEqual([600001, -2, 0.53]);
  });
});

describe("DXF", () => {
  const points = (text: string) =>
    [...text.matchAll(/POINT\n8\nPOINTS\n10\n(.*)\n20\n(.*)\n30\n(.*)\n/g)].map(([, ...xyz]) => xyz);

  it("has points where they are, or along the straightened line, which is drawn", async () => {
    const selection = { ...selectionOf(), along };
    const space = await textOf((sink) => exportDxf([selection], sink));
    expect(points(space)).toEqual([
      ["600001.00", "-2.00", "0.53"],
      ["600001.50", "2.50", "0.43"],
    ]);
    expect(space).toContain("VERTEX\n8\nLINE\n10\n600003\n20\n4\n30\n0\n70\n32\n");
    const laid = await textOf((sink) => exportDxf([selection], sink, { layout: "straightened" }));
    expect(points(laid)).toEqual([
      ["1.00000", "0.53", "-2.00000"],
      ["1.50000", "0.43", "2.50000"],
    ]);
    expect(laid).toContain("VERTEX\n8\nLINE\n10\n5\n20\n0\n30\n0\n70\n32\n");
    expect(laid.endsWith("0\nENDSEC\n0\nEOF\n")).toBe(true);
  });
});
