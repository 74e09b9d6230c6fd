import { describe, expect, it } from "vitest";
import { random } from "../../../../../georef/src/cartesian/points.fixture.js";
import { cloudOf, UTM } from "../cloud.fixture.js";
import {
  measureAngle,
  measureArea,
  measureCircle,
  measureDirection,
  measureDistance,
  measurePlane,
  measurePolyline,
  type Quantity,
  recordVertex,
  type Vertex,
} from "../index.js";

const next = random(99);
const normal = () => Math.sqrt(-2 * Math.log(1 - next())) * Math.cos(2 * Math.PI * next());

/** Precision of points, metres. */
const SIGMA = 0.005;
const cloud = cloudOf(UTM, {
  ...{ scale: 0.00001, vertical: "ellipsoidal" },
  parts: [
    { name: "datum operation", metres: 0.1 },
    { name: "height", metres: 0 },
  ],
});

type Values = (vertices: readonly Vertex[]) => Record<string, Quantity | undefined>;
const options = { precision: SIGMA };

const line: Values = ([a, b]) => {
  const { space, horizontal, geodesic, grid } = measureDistance(a!, b!, options);
  const { forward, slope, grid: inGrid } = measureDirection(a!, b!, options);
  return { space, horizontal, geodesic, grid: grid?.distance, forward, slope, bearing: inGrid?.bearing };
};
const plane: Values = (vertices) => {
  const { slope, aspect } = measurePlane(vertices, options);
  return { slope, aspect };
};
const angle: Values = ([a, b, c]) => {
  const { space, horizontal } = measureAngle(a!, b!, c!, options);
  return { space, horizontal };
};
const circle: Values = ([a, b, c]) => {
  const { radius, area, arc } = measureCircle(a!, b!, c!, options);
  return { radius, area, ...arc };
};
const way: Values = (vertices) => {
  const { space, horizontal } = measurePolyline(vertices, options);
  return { space, horizontal };
};
const ring: Values = (vertices) => ({ perimeter: measureArea(vertices, options).perimeter.space });

type Places = readonly (readonly [number, number, number])[];
const vertexAt = ([x, y, z]: readonly number[], index: number): Vertex =>
  recordVertex(cloud, {
    ...{ node: "0-0-0-0", index, integers: [0, 0, 0] },
    source: [500000 + x!, 5300000 + y!, 100 + z!],
  });

/** Share of runs in which the stated band holds the truth, by value; an unknown band holds anything. */
function coverage(places: Places, of: Values): Map<string, number> {
  const truth = of(places.map(vertexAt));
  const held = new Map<string, [number, number]>();
  for (let run = 0; run < 1200; run++) {
    const seen = of(
      places.map((place, i) =>
        vertexAt(
          place.map((one) => one + SIGMA * normal()),
          i,
        ),
      ),
    );
    for (const [name, value] of Object.entries(seen)) {
      const true_ = truth[name];
      if (!value || !true_) continue;
      const apart = value.value - true_.value;
      const off =
        value.unit === "rad"
          ? Math.abs(apart - 2 * Math.PI * Math.round(apart / (2 * Math.PI)))
          : Math.abs(apart);
      const [within, all] = held.get(name) ?? [0, 0];
      const holds = value.uncertainty === null || off <= value.uncertainty * (1 + 1e-9) + 1e-9;
      held.set(name, [within + Number(holds), all + 1]);
    }
  }
  return new Map([...held].map(([name, [within, all]]) => [name, within / all]));
}

const S = SIGMA;
const hexagon: Places = [0, 1, 2, 3, 4, 5].map((i) => [Math.cos(i * 1.047), Math.sin(i * 1.047), 0]);
const tilted = (tilt: number): Places => hexagon.map(([x, y]) => [x, y, tilt * x]);
const arc = (rise: number): Places => [
  [-1, 0, 0],
  [0, rise, 0],
  [1, 0, 0],
];

describe("values near the noise of their points are not said to be worth more than they are", () => {
  it.each<[string, Places, Values]>([
    ["two points in one place", [[0, 0, 0], [0, 0, 0]], line], // biome-ignore format: places
    ...[1, 1.5, 2, 3, 4, 5, 8].map((far): [string, Places, Values] => [
      `two points ${far} σ apart`,
      [
        [0, 0, 0],
        [far * S, 0, 0],
      ],
      line,
    ]),
    ["a pole", [[0, 0, 0], [0, 0, 5]], line], // biome-ignore format: places
    ["a pole that leans by 2 σ", [[0, 0, 0], [2 * S, 0, 5]], line], // biome-ignore format: places
    ["a pole that leans by 4 σ", [[0, 0, 0], [4 * S, 0, 5]], line], // biome-ignore format: places
    ["a level floor", hexagon, plane],
    ["a floor that falls by 1 σ", tilted(S), plane],
    ["a floor that falls by 2 σ", tilted(2 * S), plane],
    ["a floor that falls by 4 σ", tilted(4 * S), plane],
    ["a straight wall", arc(0), angle],
    ["a wall bent by 2 σ", arc(2 * S), angle],
    ["a wall bent by 5 σ", arc(5 * S), angle],
    ...[2, 3, 5, 10].map((rise): [string, Places, Values] => [`an arc of ${rise} σ`, arc(rise * S), circle]),
    ["a line of short parts", Array.from({ length: 30 }, (_, i) => [3 * S * i, 0, 0] as const), way],
    ["a small ring", hexagon.map(([x, y]) => [0.06 * x, 0.06 * y, 0] as const), ring],
  ])("%s", (_, places, of) => {
    for (const [name, share] of coverage(places, of)) expect(share, name).toBeGreaterThanOrEqual(0.93);
  });

  it("and what is far from it has nothing of that", () => {
    const far = line([vertexAt([0, 0, 0], 0), vertexAt([10, 3, 2], 1)]);
    for (const [name, value] of Object.entries(far)) {
      expect(
        value!.parts.map((part) => part.name),
        name,
      ).not.toContain("noise across");
    }
    expect(far.space!.uncertainty).toBeCloseTo(1.96 * Math.SQRT2 * SIGMA, 4);
    const round = circle([vertexAt([-1, 0, 0], 0), vertexAt([0, 1, 0], 1), vertexAt([1, 0, 0], 2)]);
    expect(round.radius!.parts.map(({ name }) => name)).not.toContain("flatness");
  });

  it("says so: any direction, no radius", () => {
    const { forward, slope } = line([vertexAt([0, 0, 0], 0), vertexAt([S, 0, 0], 1)]);
    expect([forward!.uncertainty, slope!.uncertainty]).toEqual([
      expect.closeTo(Math.PI, 6),
      expect.closeTo(Math.PI, 6),
    ]);
    expect(forward!.parts[0]!.name).toBe("direction");
    const { radius } = circle(arc(S).map(vertexAt));
    expect([radius!.uncertainty, radius!.parts[0]!.name]).toEqual([null, "flatness"]);
  });

  it("and of records one step of their integers apart, of which nothing else is unsure, any grid bearing", () => {
    const steps = cloudOf(UTM, { vertical: "ellipsoidal" });
    const bearing = (east: number, north: number) =>
      measureDirection(steps.vertex(500000, 5300000, 0), steps.vertex(500000 + east, 5300000 + north, 0), {
        precision: 0,
      }).grid!.bearing!.uncertainty;
    expect(bearing(0.001, 0)).toBeCloseTo(Math.PI, 6);
    expect(bearing(0, -0.001)).toBeCloseTo(Math.PI, 6);
    expect(bearing(0.003, 0)).toBeLessThan(0.5);
  });
});
