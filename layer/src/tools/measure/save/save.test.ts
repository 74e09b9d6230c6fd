import { readFileSync } from "node:fs";
import { join } from "node:path";
import { PlacementError } from "@groma/georef";
import { Ajv2020 } from "ajv/dist/2020.js";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { cloudOf, UTM } from "../cloud.fixture.js";
import {
  attached,
  MEASUREMENT_KINDS,
  type Measurement,
  type MeasurementKind,
  measurementsToGeoJson,
  placeVertex,
  readMeasurements,
  sourceVertex,
  valuesOf,
  valuesToCsv,
  verifyRecords,
  verticesToCsv,
} from "../index.js";

const schema = JSON.parse(
  readFileSync(join(import.meta.dirname, "../../../../../docs/measurements.schema.json"), "utf8"),
);
const valid = new Ajv2020({ strict: false }).compile(schema);
const DEGREE = Math.PI / 180;
const cloud = cloudOf(UTM, { name: "__proto__" });

/** Written, checked by the schema, as text. */
function saved(measurements: readonly Measurement[]): string {
  const document = measurementsToGeoJson(measurements, { precision: 0.01 });
  const text = JSON.stringify(document);
  expect(valid(JSON.parse(text)), JSON.stringify(valid.errors)).toBe(true);
  return text;
}

const one = (kind: MeasurementKind, vertices: Measurement["vertices"], name: string = kind): Measurement => ({
  ...{ id: name, kind, name, vertices },
});

const source = fc.tuple(
  fc.integer({ min: 300_000_000, max: 700_000_000 }),
  fc.integer({ min: 3_000_000_000, max: 6_000_000_000 }),
  fc.integer({ min: -100_000, max: 9_000_000 }),
);

describe("measurements saved and read again", () => {
  it("keep how volumes are measured, and what was read of them", () => {
    const ring = [
      [0, 0],
      [9, 0],
      [5, 8],
    ].map(([x, y]) => cloud.vertex(500_000 + x, 5_300_000 + y, 5));
    for (const volume of [
      { base: { kind: "plane" } },
      { base: { kind: "height", height: -3.5 }, classes: [2, 9] },
      { base: { kind: "cloud", dataset: "__proto__" } },
      {},
    ] as const) {
      const before = { ...one("volume", ring), volume };
      const { measurements, notes } = readMeasurements(saved([before]), [cloud]);
      expect([measurements, notes]).toEqual([[before], []]);
    }
    const value = valuesOf(one("area", ring))[0]!;
    const [feature] = measurementsToGeoJson([one("volume", ring)], { valuesOf: () => [value] }).features;
    expect(feature!.groma.values.map(({ name }) => name)).toEqual([value.name]);
    // What a later version may measure against is not taken for something else in silence.
    const later = saved([{ ...one("volume", ring), volume: { base: { kind: "plane" } } }]);
    const odd = readMeasurements(later.replace('"plane"', '"sphere"'), [cloud]);
    expect(odd.measurements).toEqual([one("volume", ring)]);
    const kind = saved([one("area", ring)]).replaceAll('"kind":"area"', '"kind":"toString"');
    expect(readMeasurements(kind, [cloud])).toEqual({
      measurements: [],
      notes: [expect.stringContaining('a kind that is not known here: "toString"')],
    });
    expect(odd.notes).toEqual([expect.stringContaining("its lowest vertex is taken")]);
  });

  it("stand on the same records, to the integer, and have the same values", () => {
    const kinds = Object.keys(MEASUREMENT_KINDS) as MeasurementKind[];
    fc.assert(
      fc.property(fc.constantFrom(...kinds), fc.array(source, { minLength: 5, maxLength: 5 }), (kind, at) => {
        const { least, most } = MEASUREMENT_KINDS[kind];
        const count = Math.min(most, Math.max(least, 5));
        const vertices = at.slice(0, count).map(([x, y, z]) => cloud.vertex(x / 1000, y / 1000, z / 1000));
        const before = one(kind, vertices, 'mine; "yours"\n');
        const { measurements, notes } = readMeasurements(saved([before]), [cloud]);
        expect(notes).toEqual([]);
        expect(measurements).toEqual([before]);
        expect(JSON.parse(saved(measurements))).toEqual(JSON.parse(saved([before])));
      }),
      { numRuns: 300 },
    );
  });

  it("keep what an annotation says, as plain text, and from where it was seen", () => {
    const camera = { longitude: 0.15, latitude: 0.8, height: 700, heading: 1, pitch: -0.5, roll: 0 };
    const note = { text: "<img src=x onerror=alert(1)>\nsecond line", camera };
    const before = { ...one("annotation", [cloud.vertex(500000, 5300000, 1)], "Crack <b>"), note };
    const text = saved([before]);
    expect(readMeasurements(text, [cloud])).toEqual({ measurements: [before], notes: [] });
    const [feature] = JSON.parse(text).features;
    expect(feature.properties).toEqual({ name: "Crack <b>", kind: "annotation", text: note.text });
    // A camera that is none does not take the text with it; a text that is none is told.
    for (const wrong of [
      '"height":null',
      '"height":1e300',
      '"height":-6.37e6',
      '"height":700,"latitude":5',
    ]) {
      const odd = readMeasurements(text.replace('"height":700', wrong), [cloud]);
      expect([wrong, odd.measurements]).toEqual([wrong, [{ ...before, note: { text: note.text } }]]);
    }
    const none = readMeasurements(text.replace(JSON.stringify({ note }).slice(1, -1), '"note":7'), [cloud]);
    expect([none.measurements[0]!.note, none.notes]).toEqual([
      undefined,
      ["feature 1: its note is no text and is left out"],
    ]);
  });

  it("stand at their places where the scan is not open, and keep their records", () => {
    const vertices = [cloud.vertex(500000, 5300000, 1), cloud.vertex(500010, 5300000, 1)];
    const { measurements, notes } = readMeasurements(saved([one("distance", vertices)]));
    expect(notes).toEqual(["__proto__ is not open: its vertices stand at their saved places"]);
    expect(measurements[0].vertices.map(({ record }) => record)).toEqual(
      vertices.map(({ record }) => record),
    );
    const [space] = valuesOf(measurements[0]);
    expect(space.quantity.value).toBeCloseTo(10 / 0.9996, 4);
    expect(space.quantity.uncertainty).toBeNull();
    // Opened and saved again, nothing of them is lost.
    expect(readMeasurements(saved(measurements), [cloud]).measurements[0].vertices).toEqual(vertices);
  });

  it("are told apart from those of another scan of the same name", () => {
    const [first, second] = ["5-aaaaaaaa", "5-bbbbbbbb"].map((identity, i) =>
      Object.assign(cloudOf(i === 0 ? UTM : UTM.replace("32", "33"), { name: "scan" }), { identity }),
    );
    const at = (of: typeof first, x: number) => of!.vertex(500000 + x, 5300000, 1);
    const mixed = one("distance", [at(first, 0), at(second, 10)]);
    const against = {
      ...one("volume", [at(first, 0), at(first, 9), first!.vertex(500000, 5300009, 1)]),
      volume: { base: { kind: "cloud", dataset: "scan", identity: "5-bbbbbbbb" } },
    } as const;
    const text = saved([mixed, against]);
    expect(JSON.parse(text).groma.datasets.map(({ identity }: { identity: string }) => identity)).toEqual([
      ...["5-aaaaaaaa", "5-bbbbbbbb"],
    ]);
    // Whatever the order, and whatever the files are called by now.
    const renamed = Object.assign(cloudOf(UTM, { name: "renamed" }), { identity: "5-aaaaaaaa" });
    for (const clouds of [
      [first!, second!],
      [second!, first!],
      [second!, renamed],
    ]) {
      const { measurements, notes } = readMeasurements(text, clouds);
      expect(notes).toEqual([]);
      const [a, b] = measurements[0].vertices;
      expect([a.cloud?.identity, b.cloud]).toEqual(["5-aaaaaaaa", second]);
      expect(measurements[1].volume).toEqual(against.volume);
    }
    const { measurements, notes } = readMeasurements(text, [second!]);
    expect(notes).toEqual([
      expect.stringMatching(/^the scan that is open has other points .* saved places$/),
    ]);
    expect(measurements[0].vertices.map(({ cloud: of }) => of)).toEqual([undefined, second]);
    expect(measurements[0].vertices[0].ecef).toEqual(
      at(first, 0).ecef.map((value) => expect.closeTo(value, 6)),
    );
    // What is opened later takes up its own vertices only.
    expect(measurements[0].vertices.map((vertex) => attached(vertex, [second!, first!]).cloud)).toEqual([
      first,
      second,
    ]);
    expect(verticesToCsv([mixed]).match(/5-[ab]{8},distance\r/g)).toEqual([
      ...["5-aaaaaaaa,distance\r", "5-bbbbbbbb,distance\r"],
    ]);
  });

  it("of a version that does not tell scans of one name apart go by the name, where one alone has it", () => {
    const before = one("distance", [cloud.vertex(500000, 5300000, 1), cloud.vertex(500010, 5300000, 1)]);
    const text = saved([before]);
    expect(text).not.toContain("identity");
    const [known, other] = ["5-aaaaaaaa", "5-bbbbbbbb"].map((identity) =>
      Object.assign(cloudOf(UTM, { name: "__proto__" }), { identity }),
    );
    expect(readMeasurements(text, [known!]).measurements[0].vertices[0].record).toEqual({
      ...before.vertices[0].record,
      identity: "5-aaaaaaaa",
    });
    const { measurements, notes } = readMeasurements(text, [known!, other!]);
    expect(notes).toEqual([
      "several data sets named __proto__ are open: its vertices stand at their saved places",
    ]);
    expect(measurements[0].vertices[0].record).toEqual(before.vertices[0].record);
  });

  it("go by their integers, whatever else a file says", () => {
    const before = one("distance", [cloud.vertex(500000, 5300000, 1), cloud.vertex(500010, 5300000, 1)]);
    const changed = (change: (vertex: Record<string, unknown>) => void) => {
      const document = JSON.parse(saved([before]));
      change(document.features[0].groma.vertices[0]);
      return readMeasurements(JSON.stringify(document), [cloud]);
    };
    const edited = changed((vertex) => {
      vertex.source = [500000, 5300000, 999];
    });
    expect(edited.measurements).toEqual([before]);
    expect(edited.notes).toEqual([expect.stringContaining("not those of its integers")]);
    for (const wrong of [
      { integers: [1.5, 2, 3] },
      { integers: [1e300, 2, 3] },
      { index: -1 },
      { node: "../x" },
    ]) {
      const { measurements, notes } = changed((vertex) => Object.assign(vertex, wrong));
      expect(measurements[0].vertices[0].record).toBeUndefined();
      expect(notes).toEqual([expect.stringContaining("that vertex is a place")]);
    }
  });

  it("are not lost where a data set, as it is open, has no place for one", () => {
    const vertices = [cloud.vertex(500000, 5300000, 1), cloud.vertex(500010, 5300000, 1)];
    const before = one("distance", vertices);
    const fence = Object.assign(cloudOf(UTM, { name: "__proto__" }), {
      place: () => {
        throw new PlacementError({ code: "PLACE_DOMAIN", file: "scan", cause: "no", fix: "none" });
      },
    });
    const { measurements, notes } = readMeasurements(saved([before, one("point", [vertices[0]])]), [fence]);
    expect(notes).toEqual([expect.stringContaining("they stand at their saved places")]);
    expect(measurements).toHaveLength(2);
    expect(valuesOf(measurements[0])[0].quantity.value).toBeCloseTo(10 / 0.9996, 4);
    expect(measurements[0].vertices[0].record).toEqual(vertices[0].record);
    expect(attached(measurements[0].vertices[0], [fence])).toBe(measurements[0].vertices[0]);
    expect(readMeasurements(saved(measurements), [cloud]).measurements[0]).toEqual(before);
  });

  it("keep the data set of a place that is no record, without the scan too", () => {
    const before = one("distance", [
      sourceVertex(cloud, [500000, 5300000, 1]),
      cloud.vertex(500010, 5300000, 1),
    ]);
    const without = readMeasurements(saved([before])).measurements;
    const again = readMeasurements(saved(without), [cloud]);
    expect([again.measurements, again.notes]).toEqual([[before], []]);
    expect(attached(without[0].vertices[0], [cloud])).toMatchObject({ cloud, source: [500000, 5300000, 1] });
  });

  it("of names alone do not stand on a scan of another scale or system", () => {
    const text = saved([one("point", [cloud.vertex(500000, 5300000, 1)])]);
    for (const [other, why] of [
      [cloudOf(UTM, { name: "__proto__", scale: 0.01 }), "another scale"],
      [cloudOf(UTM.replace("32", "33"), { name: "__proto__" }), "was measured in"],
    ] as const) {
      const { measurements, notes } = readMeasurements(text, [other]);
      expect(notes).toEqual([expect.stringContaining(why)]);
      expect(measurements[0].vertices[0].cloud).toBeUndefined();
    }
  });

  it("are saved without values where they have none, and not lost", () => {
    const [a, b] = [cloud.vertex(500000, 5300000, 1), cloud.vertex(500010, 5300010, 1)];
    const [c, d] = [cloud.vertex(500010, 5300000, 1), cloud.vertex(500000, 5300010, 1)];
    const bow = one("area", [a, b, c, d]);
    expect(() => valuesOf(bow)).toThrow("MEASURE_CROSSING");
    const { measurements } = readMeasurements(saved([bow]), [cloud]);
    expect(measurements).toEqual([bow]);
  });
});

describe("geometries", () => {
  const at = (lon: number, lat: number) => placeVertex(lon * DEGREE, lat * DEGREE, 0);
  const geometry = (measurement: Measurement) => JSON.parse(saved([measurement])).features[0].geometry;
  const near = (value: number) => expect.closeTo(value, 9);

  it("run counter-clockwise around areas, and end where they begin", () => {
    const clockwise = [at(0, 0), at(0, 1), at(1, 1)];
    const { type, coordinates } = geometry(one("area", clockwise));
    expect(type).toBe("Polygon");
    expect(coordinates[0].map(([lon, lat]: number[]) => [Math.round(lon), Math.round(lat)])).toEqual([
      ...[
        [1, 1],
        [0, 1],
        [0, 0],
        [1, 1],
      ],
    ]);
  });

  it("are cut at the antimeridian", () => {
    const line = geometry(one("polyline", [at(179, 0), at(-179, 2), at(-178, 2)]));
    expect(line).toEqual({
      type: "MultiLineString",
      coordinates: [
        [
          [near(179), near(0), near(0)],
          [near(180), near(1), near(0)],
        ],
        [
          [near(-180), near(1), near(0)],
          [near(-179), near(2), near(0)],
          [near(-178), near(2), near(0)],
        ],
      ],
    });
    const ring = geometry(one("area", [at(179, 0), at(-179, 0), at(-179, 2), at(179, 2)]));
    expect(ring.type).toBe("MultiPolygon");
    const longitudes = ring.coordinates.map(([part]: number[][][]) => part.map(([lon]) => Math.round(lon)));
    expect(longitudes.map((part: number[]) => [Math.min(...part), Math.max(...part)])).toEqual([
      ...[
        [179, 180],
        [-180, -179],
      ],
    ]);
  });

  it("around a pole stay whole", () => {
    const cap = [0, 90, 180, -90].map((lon) => at(lon, 85));
    expect(geometry(one("area", cap)).type).toBe("Polygon");
  });
});

describe("every value of every kind", () => {
  const heights = cloudOf(UTM, {
    ...{ name: "heights", vertical: "ellipsoidal" },
    parts: [
      { name: "datum operation", metres: 0.5 },
      { name: "height", metres: 0 },
    ],
  });
  const four = [
    [0, 0, 1],
    [10, 1, 9],
    [12, 8, 4],
    [1, 9, 6],
  ].map(([x, y, z]) => heights.vertex(500000 + x, 5300000 + y, z));
  const kinds = Object.entries(MEASUREMENT_KINDS).filter(
    ([kind]) => !["aboveGround", "annotation"].includes(kind),
  );

  it.each(kinds)("%s: has an uncertainty, known as soon as the precision is", (kind, { most }) => {
    const measurement = one(kind as MeasurementKind, four.slice(0, Math.min(4, most)));
    for (const { name, quantity } of valuesOf(measurement, { precision: 0.01 })) {
      expect(quantity.uncertainty, name).toBeGreaterThan(0);
      expect(quantity, name).toMatchObject({ atLeast: quantity.uncertainty, coverage: 0.95 });
      expect(quantity.parts.length, name).toBeGreaterThan(0);
    }
    for (const { name, quantity } of valuesOf(measurement)) {
      expect(quantity.uncertainty, name).toBeNull();
      expect(quantity.atLeast, name).toBeGreaterThan(0);
    }
  });
});

describe("records", () => {
  it("are held against the file, and told where they are others", async () => {
    const a = cloud.vertex(500000, 5300000, 1);
    const measurements = [one("point", [a])];
    const reading = (integers: readonly [number, number, number], source = a.source!) => ({
      name: cloud.name,
      readPoint: async () => ({ node: "0-0-0-0", index: 0, integers, source }),
    });
    const elsewhere = reading(a.record!.integers, [a.source![0], a.source![1], 999]);
    await expect(verifyRecords(measurements, [elsewhere])).rejects.toMatchObject({ code: "MEASURE_RECORD" });
    await verifyRecords(measurements, [reading(a.record!.integers)]);
    await expect(verifyRecords(measurements, [reading([1, 2, 3])])).rejects.toMatchObject({
      code: "MEASURE_RECORD",
    });
  });
});

describe("CSV", () => {
  it("has a row a value and a row a vertex, names quoted and no formulas", () => {
    const vertices = [cloud.vertex(500000, 5300000, 1), cloud.vertex(500010, 5300000, 1)];
    const measurements = [one("distance", vertices, '=1+1,"x"')];
    const rows = valuesToCsv(measurements, { precision: 0.01 }).trimEnd().split("\r\n");
    expect(rows[0]).toBe("measurement,kind,value_name,value,unit,uncertainty95,at_least,unknown_parts,id");
    expect(rows[1]).toMatch(
      /^"'=1\+1,""x""",distance,space,10\.00\d*,m,0\.027\d*,0\.027\d*,,"'=1\+1,""x"""$/,
    );
    const [, first] = verticesToCsv(measurements).split("\r\n");
    expect(first).toMatch(
      /,distance,1,[\d.]+,[\d.]+,[\d.]+,__proto__,0-0-0-0,\d+,500000000,1300000000,1000,500000,5300000,1,,"'=1\+1,""x"""$/,
    );
    expect(valuesToCsv(measurements)).toContain("point precision");
  });
});
