import { describe, expect, it } from "vitest";
import { random } from "../../../../../georef/src/cartesian/points.fixture.js";
import { cloudOf, type FixtureCloud, UTM } from "../cloud.fixture.js";
import {
  ecefVertex,
  measureAngle,
  measureArea,
  measureCircle,
  measureDirection,
  measureDistance,
  measureHeight,
  measurePlane,
  measurePolyline,
  type Quantity,
  type Vertex,
} from "../index.js";
import { coverageFactor } from "./coverage.js";

const next = random(7);

/** A normally distributed number (Box and Muller). */
function normal(): number {
  return Math.sqrt(-2 * Math.log(1 - next())) * Math.cos(2 * Math.PI * next());
}

interface Errors {
  readonly precision: number;
  readonly step: number;
  readonly datum: number;
}

const OFFSETS = [
  [0, 0, 0],
  [60, 10, 8],
  [45, 70, 20],
  [-20, 50, 3],
] as const;

/** Four vertices as they are, and as a scan with these errors has them; the last two of another scan where there is one. */
function scanned(clouds: readonly FixtureCloud[], { precision, step, datum }: Errors) {
  const shifts = clouds.map(() => [normal(), normal(), normal()].map((one) => one * datum));
  const base = [500000 + 1e5 * next(), 5.2e6 + 2e5 * next(), 400 * next()];
  return OFFSETS.map((offset, i) => {
    const which = i < 2 ? 0 : clouds.length - 1;
    const cloud = clouds[which];
    const source = base.map((value, axis) => value + offset[axis] * (1 + next() / 10)) as [
      number,
      number,
      number,
    ];
    const truth: Vertex = { ...ecefVertex(cloud.place(...source)), cloud, source };
    const measured = source.map((value) => {
      const seen = value + precision * normal();
      return step > 0 ? Math.round(seen / step) * step : seen;
    }) as [number, number, number];
    const ecef = Array.from(cloud.place(...measured)).map((value, axis) => value + shifts[which][axis]);
    const record = { dataset: cloud.name, node: "0-0-0-0", index: i, integers: [0, 0, 0] as const };
    return { truth, seen: { ...ecefVertex(ecef), cloud, source: measured, record } satisfies Vertex };
  });
}

/** Values of every figure of four vertices. */
function values([a, b, c, d]: readonly Vertex[], options: { precision: number }) {
  const near = measureDistance(a, b, options);
  const across = measureDistance(a, c, options);
  const direction = measureDirection(a, b, options);
  const area = measureArea([a, b, c, d], options);
  const circle = measureCircle(a, b, c, options);
  const plane = measurePlane([a, b, c, d], options);
  const line = measurePolyline([a, b, c, d], options);
  return {
    ...{ space: near.space, geodesic: near.geodesic, horizontal: near.horizontal, vertical: near.vertical },
    grid: near.grid?.distance,
    ...{ "space across": across.space, "geodesic across": across.geodesic },
    height: measureHeight(a, options),
    ...{ azimuth: direction.forward, "grid bearing": direction.grid?.bearing, slope: direction.slope },
    "azimuth across": measureDirection(a, c, options).back,
    angle: measureAngle(a, b, c, options).space,
    "angle between azimuths": measureAngle(a, b, c, options).horizontal,
    ...{ "planar area": area.planar, "geodesic area": area.geodesic, "grid area": area.grid?.area },
    perimeter: area.perimeter.geodesic,
    ...{ radius: circle.radius, arc: circle.arc.length, sagitta: circle.arc.sagitta },
    ...{ "arc's angle": circle.arc.angle, chord: circle.arc.chord },
    ...{ "plane's slope": plane.slope, "plane's aspect": plane.aspect },
    ...{ ascent: line.ascent, descent: line.descent },
  } satisfies Record<string, Quantity | undefined>;
}

const RUNS = 1500;

/** Share of the runs in which the stated band holds the truth, by value. */
function coverage(clouds: readonly FixtureCloud[], errors: Errors): Map<string, number> {
  const held = new Map<string, number>();
  const options = { precision: errors.precision };
  for (let run = 0; run < RUNS; run++) {
    const vertices = scanned(clouds, errors);
    const truths = values(
      vertices.map(({ truth }) => truth),
      options,
    );
    const found = values(
      vertices.map(({ seen }) => seen),
      options,
    );
    for (const [name, seen] of Object.entries(found)) {
      const truth = truths[name as keyof typeof truths];
      if (!truth || !seen) continue;
      const within = Math.abs(seen.value - truth.value) <= (seen.uncertainty ?? Number.NaN);
      held.set(name, (held.get(name) ?? 0) + (within ? 1 / RUNS : 0));
    }
  }
  return held;
}

const parts = (datum: number) => [
  { name: "quantisation", metres: 0.0009 },
  { name: "fit", metres: 0.001 },
  { name: "datum operation", metres: datum },
  { name: "height", metres: 0 },
];

describe("the stated band holds 93 to 97 % of the cases", () => {
  it.each<[string, Errors & { two?: boolean }]>([
    ["where the scanner's precision rules", { precision: 0.02, step: 0.001, datum: 0.5 }],
    ["where rounding rules", { precision: 0, step: 0.1, datum: 0 }],
    ["between two scans", { precision: 0.01, step: 0.01, datum: 0.3, two: true }],
  ])("%s", { timeout: 120_000 }, (_, { two = false, ...errors }) => {
    const made = (name: string) =>
      cloudOf(UTM, { name, scale: errors.step, parts: parts(errors.datum), vertical: "ellipsoidal" });
    const clouds = two ? [made("one"), made("two")] : [made("one")];
    for (const [name, share] of coverage(clouds, errors)) {
      expect(share, name).toBeGreaterThanOrEqual(0.93);
      expect(share, name).toBeLessThanOrEqual(0.97);
    }
  });

  it("and more of them where noise alone makes a rise, or a deviation from a plane", () => {
    const level = cloudOf(UTM, { parts: parts(0.3), vertical: "ellipsoidal" });
    const options = { precision: 0.02 };
    let [climbed, apart] = [0, 0];
    for (let run = 0; run < 300; run++) {
      // Forty steps on level ground, and a roof of ten points: what is measured of them is noise.
      const way = Array.from({ length: 41 }, (_, i) =>
        level.vertex(500000 + 5 * i, 5300000, 0.02 * normal()),
      );
      const { ascent } = measurePolyline(way, options);
      expect(ascent.value).toBeGreaterThan(0.1);
      if (ascent.value <= ascent.uncertainty!) climbed++;
      const roof = Array.from({ length: 10 }, (_, i) =>
        level.vertex(500000 + 3 * (i % 5), 5300000 + 4 * Math.floor(i / 5), 0.02 * normal()),
      );
      const { deviation } = measurePlane(roof, options);
      if (deviation.value <= deviation.uncertainty!) apart++;
    }
    expect(climbed / 300).toBeGreaterThanOrEqual(0.95);
    expect(apart / 300).toBeGreaterThanOrEqual(0.95);
  });

  it("by a factor that knows errors with bounds", () => {
    expect(coverageFactor(0)).toBeCloseTo(1.96, 12);
    expect(coverageFactor(-1.2)).toBeCloseTo(0.95 * Math.sqrt(3), 12);
    expect(coverageFactor(-0.6)).toBeCloseTo(1.902, 3);
  });
});

describe("errors that two points share", () => {
  const cloud = cloudOf(UTM);
  const other = cloudOf(UTM, {
    name: "other",
    parts: [
      { name: "datum operation", metres: 1, note: "another operation" },
      { name: "height", metres: null, note: "reference unknown, drawn as ellipsoidal" },
    ],
  });
  const [a, b] = [cloud.vertex(500000, 5300000, 0), cloud.vertex(500010, 5300000, 0)];

  it("do not count in a distance within one scan, and grow with it", () => {
    const { space } = measureDistance(a, b, { precision: 0.001 });
    // The datum operation is worth a metre, and 10 m of the scan are worth a thousandth of that.
    expect(space.uncertainty).toBeLessThan(0.004);
    const datum = space.parts.find(({ name }) => name === "datum operation");
    expect(datum?.standard).toBeCloseTo(1e-4, 5);
    expect(datum?.correlation).toBeCloseTo(1, 6);
    const far = measureDistance(a, cloud.vertex(510000, 5300000, 0), { precision: 0.001 }).space;
    expect(far.uncertainty).toBeGreaterThan(0.1);
  });

  it("count in full between two scans", () => {
    const { space, vertical } = measureDistance(a, other.vertex(500010, 5300000, 0), { precision: 0.001 });
    expect(space.atLeast).toBeGreaterThan(1.96 * Math.SQRT2 * 0.99);
    const datum = space.parts.find(({ name }) => name === "datum operation");
    expect([datum?.correlation, datum?.note]).toEqual([0, "some operation; another operation"]);
    // Heights of unknown reference: nobody knows by how much two of them differ.
    expect(vertical.uncertainty).toBeNull();
    expect(vertical.parts[0]).toMatchObject({ name: "height", standard: null });
  });

  it("have no part in what is formed of records alone", () => {
    const { grid, vertical } = measureDistance(a, b, { precision: 0.001 });
    for (const { parts: of } of [grid!.distance, vertical]) {
      expect(of.map(({ name }) => name).sort()).toEqual(["point precision", "quantisation"]);
    }
  });
});

describe("what nobody has stated", () => {
  const cloud = cloudOf(UTM);
  const [a, b] = [cloud.vertex(500000, 5300000, 0), cloud.vertex(500010, 5300000, 0)];

  it("makes the worth unknown, and the known parts its least", () => {
    const { space } = measureDistance(a, b);
    expect(space.uncertainty).toBeNull();
    expect(space.atLeast).toBeGreaterThan(0);
    expect(space.parts[0]).toEqual({
      ...{ name: "point precision", standard: null, correlation: 0 },
      note: "the scanner's; not given",
    });
    expect(measureHeight(a, { precision: 0.01 }).parts[0]).toMatchObject({ name: "height", standard: null });
  });

  it("is given by scan, in plane and in height", () => {
    const asked: string[] = [];
    const precision = ({ name }: { name: string }) => {
      asked.push(name);
      return { horizontal: 0.01, vertical: 0.03 };
    };
    const { vertical, horizontal } = measureDistance(a, b, { precision });
    expect(asked).toContain("scan");
    expect(vertical.uncertainty).toBeCloseTo(1.96 * Math.SQRT2 * 0.03, 3);
    expect(horizontal.uncertainty).toBeCloseTo(1.96 * Math.SQRT2 * 0.01, 3);
  });
});
