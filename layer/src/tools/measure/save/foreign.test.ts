import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { cloudOf, UTM } from "../cloud.fixture.js";
import { MEASUREMENT_KINDS, readMeasurements } from "../index.js";

const cloud = cloudOf(UTM, { name: "__proto__" });

describe("GeoJSON of other programs", () => {
  it("is measured, and said to have no records", () => {
    const features = [
      { type: "Feature", geometry: { type: "Point", coordinates: [7, 47] }, properties: { name: "pole" } },
      {
        type: "Feature",
        geometry: {
          type: "LineString",
          coordinates: [
            [7, 47],
            [7, 48, 3],
          ],
        },
        properties: null,
      },
      {
        type: "Feature",
        geometry: {
          type: "Polygon",
          coordinates: [
            [
              [7, 47],
              [8, 47],
              [8, 48],
              [7, 47],
            ],
          ],
        },
        properties: {},
      },
      { type: "Feature", geometry: { type: "Point", coordinates: [7, 97] }, properties: {} },
      { type: "Feature", geometry: null, properties: {} },
      7,
    ];
    const { measurements, notes } = readMeasurements(JSON.stringify({ type: "FeatureCollection", features }));
    expect(measurements.map(({ kind, name, vertices }) => [kind, name, vertices.length])).toEqual([
      ["point", "pole", 1],
      ["distance", "Distance 2", 2],
      ["area", "Area 3", 3],
    ]);
    expect(notes).toHaveLength(4);
    expect(notes[0]).toMatch("no records of a scan");
    expect(notes[1]).toMatch("feature 4 is left out");
  });

  const lines = (...coordinates: unknown[]) => ({ type: "MultiLineString", coordinates });
  const square = [
    [7, 47],
    [8, 47],
    [8, 48],
    [7, 47],
  ];
  it.each<[string, object, [string, number][]]>([
    ["a geometry alone", { type: "LineString", coordinates: square }, [["polyline", 4]]],
    [
      "a line that was cut at the antimeridian",
      lines([[179, 0], [180, 1]], [[-180, 1], [-179, 2], [-178, 2]]), // biome-ignore format: positions
      [["polyline", 3]],
    ],
    ["lines apart from each other", lines([[1, 1], [2, 2]], [[3, 3], [4, 4]]), [["distance", 2], ["distance", 2]]], // biome-ignore format: positions
    [
      "several polygons",
      { type: "MultiPolygon", coordinates: [[square], [square]] },
      [
        ["area", 3],
        ["area", 3],
      ],
    ],
    ["several points", { type: "MultiPoint", coordinates: square.slice(0, 2) }, [["point", 1], ["point", 1]]], // biome-ignore format: positions
    [
      "the kind in an attribute, as a GIS keeps it",
      {
        type: "Feature",
        geometry: { type: "LineString", coordinates: square.slice(0, 3) },
        properties: { kind: "circle" },
      },
      [["circle", 3]],
    ],
    [
      "a kind that does not fit",
      {
        type: "Feature",
        geometry: { type: "LineString", coordinates: square },
        properties: { kind: "angle" },
      },
      [["polyline", 4]],
    ],
    [
      "EPSG:4326 by name, after a byte order mark",
      {
        ...{
          type: "FeatureCollection",
          crs: { type: "name", properties: { name: "urn:ogc:def:crs:OGC:1.3:CRS84" } },
        },
        features: [{ type: "Feature", geometry: { type: "Point", coordinates: [7, 47] } }],
      },
      [["point", 1]],
    ],
  ])("is measured: %s", (_, document, expected) => {
    const { measurements, notes } = readMeasurements(`\uFEFF${JSON.stringify(document)}`);
    expect(measurements.map(({ kind, vertices }) => [kind, vertices.length])).toEqual(expected);
    expect(notes).toEqual(["vertices of other programs are places, no records of a scan"]);
    expect(new Set(measurements.map(({ id }) => id)).size).toBe(measurements.length);
  });

  it.each<[string, object, RegExp]>([
    ["a height beyond all views", { type: "Point", coordinates: [7, 47, 1e300] }, /heights in metres/],
    [
      "a height below the middle of the earth",
      { type: "Point", coordinates: [7, 47, -7e6] },
      /heights in metres/,
    ],
    ["metres", { type: "LineString", coordinates: [[2600000, 1200000], [2600010, 1200000]] }, /no longitudes and latitudes/], // biome-ignore format: positions
    ["holes", { type: "Polygon", coordinates: [square, square] }, /polygon has holes/],
    ["one vertex", { type: "LineString", coordinates: [[7, 47]] }, /too few positions/],
    ["curves", { type: "CircularString", coordinates: [[7, 47]] }, /"CircularString", of which nothing/],
  ])("is left out, and said to be: %s", (_, geometry, why) => {
    const { measurements, notes } = readMeasurements(JSON.stringify(geometry));
    expect([measurements, notes]).toEqual([[], [expect.stringMatching(why)]]);
  });

  it.each([
    ["no JSON", "{", "MEASURE_FILE"],
    ["no object", "[]", "MEASURE_FILE"],
    ["no features", '{"type": "Topology", "objects": {}}', "MEASURE_FILE"],
    [
      "metres",
      '{"type": "FeatureCollection", "features": [], "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::2056"}}}',
      "MEASURE_FILE",
    ],
    ["another member groma", '{"type": "FeatureCollection", "features": [], "groma": 1}', "MEASURE_FILE"],
    [
      "a later version",
      '{"type": "FeatureCollection", "features": [], "groma": {"format": "measurements", "version": 2}}',
      "MEASURE_VERSION",
    ],
  ])("is refused by name: %s", (_, text, code) => {
    expect(() => readMeasurements(text, [], "a.geojson")).toThrow(new RegExp(`^${code}: a.geojson: `));
  });

  it("whatever it holds, gives measurements or one clear error", () => {
    const feature = fc.record({
      type: fc.constant("Feature"),
      geometry: fc.jsonValue(),
      groma: fc.record({
        kind: fc.constantFrom("area", "constructor", "__proto__"),
        vertices: fc.array(
          fc.record({ place: fc.jsonValue(), dataset: fc.constant("__proto__"), source: fc.jsonValue() }),
        ),
      }),
    });
    fc.assert(
      fc.property(fc.array(feature), (features) => {
        const { measurements } = readMeasurements(JSON.stringify({ type: "FeatureCollection", features }), [
          cloud,
        ]);
        for (const { kind } of measurements) expect(kind in MEASUREMENT_KINDS).toBe(true);
      }),
    );
  });
});
