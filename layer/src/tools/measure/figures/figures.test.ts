import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { cloudOf, UTM } from "../cloud.fixture.js";
import {
  ecefVertex,
  measureAngle,
  measureArea,
  measureCircle,
  measureDirection,
  measureDistance,
  measurePlane,
  measurePolyline,
  placeVertex,
  readOut,
  recordVertex,
  type Vertex,
  valuesOf,
} from "../index.js";
import { beside, DEGREE, finite, place, utm } from "./places.fixture.js";

describe("distances", () => {
  it("are the same both ways, antipodes, poles and antimeridian included", () => {
    fc.assert(
      fc.property(place, place, (a, b) => {
        const [there, back] = [measureDistance(a, b), measureDistance(b, a)];
        expect(there.space.value).toBe(back.space.value);
        expect(Math.abs(there.geodesic.value - back.geodesic.value)).toBeLessThan(2e-8);
        expect(there.vertical.value + back.vertical.value).toBe(0);
        for (const { value, atLeast } of [there.space, there.geodesic, there.horizontal, there.vertical]) {
          expect(Number.isFinite(value) && Number.isFinite(atLeast)).toBe(true);
        }
      }),
      { numRuns: 2000 },
    );
  });

  it("in space are the hypotenuse of the level and the vertical one, as far as a chord is its arc", () => {
    fc.assert(
      fc.property(place, finite(-500, 500), finite(-500, 500), finite(-200, 200), (at, e, n, u) => {
        const { longitude, latitude, height } = at;
        const a = beside(longitude, latitude, height, 0, 0, 0);
        const b = beside(longitude, latitude, height, e, n, u);
        const { space, horizontal, vertical } = measureDistance(a, b);
        const hypotenuse = Math.hypot(horizontal.value, vertical.value);
        expect(Math.abs(hypotenuse - space.value)).toBeLessThan(1e-5);
      }),
      { numRuns: 1000 },
    );
  });

  it("of a millimetre are right to the nanometre that ECEF has", () => {
    const a = placeVertex(0.2, 0.8, 100);
    const b = beside(0.2, 0.8, 100, 0.0006, 0, 0.0008);
    expect(Math.abs(measureDistance(a, b).space.value - 0.001)).toBeLessThan(2e-9);
  });

  it("of coincident points are 0, and worth what their places are", () => {
    const a = utm.vertex(500000, 5300000, 10);
    const other = recordVertex(utm, { ...a.record!, index: 1000, source: a.source! });
    const { space, geodesic, vertical, grid } = measureDistance(a, other, { precision: 0.01 });
    for (const { value } of [space, geodesic, vertical]) expect(value).toBe(0);
    // Both have 10 mm along three axes: a band of 95 % around no distance at all.
    expect(space.atLeast).toBeGreaterThan(0.028);
    expect(space.atLeast).toBeLessThan(0.05);
    expect(grid?.scaleFactor).toBeCloseTo(0.9996, 6);
  });

  it("of a record from itself are exactly 0, however often it was picked", () => {
    const [a, b] = [utm.vertex(500000, 5300000, 10), utm.vertex(500010, 5300000, 10)];
    const again = recordVertex(utm, { ...a.record!, source: a.source! });
    for (const one of [a, again]) {
      const { space, vertical, horizontal } = measureDistance(a, one, { precision: 0.01 });
      for (const { value, atLeast } of [space, vertical, horizontal])
        expect([value, atLeast]).toEqual([0, 0]);
    }
    // What says to be the same record, and has other integers, is another one.
    const bogus = recordVertex(utm, { ...b.record!, index: a.record!.index, source: b.source! });
    expect(measureDistance(a, bogus, { precision: 0.01 }).space.uncertainty).toBeGreaterThan(0.02);
    const there = (back: Vertex) => measurePolyline([a, b, back], { precision: 0.01 }).space.uncertainty;
    expect(there(again)).toBe(there(a));
    expect(there(a)).toBeCloseTo(2 * measureDistance(a, b, { precision: 0.01 }).space.uncertainty!, 6);
  });

  it("in the grid are those of the source, with the factor that leads to the ellipsoid", () => {
    const [a, b] = [utm.vertex(500000, 5300000, 500), utm.vertex(500300, 5300400, 520)];
    const { grid, geodesic, horizontal } = measureDistance(a, b);
    expect(grid?.distance.value).toBeCloseTo(500, 9);
    expect(grid?.scaleFactor).toBeCloseTo(0.9996, 8);
    // Transverse Mercator at its meridian: k0; here datum and ellipsoid are those of WGS 84.
    expect(grid!.distance.value / geodesic.value).toBeCloseTo(grid!.scaleFactor, 9);
    expect(grid!.distance.value / horizontal.value).toBeCloseTo(grid!.combinedFactor, 9);
    expect(grid!.elevationFactor).toBeCloseTo(1 - 510 / 6.38e6, 6);
  });

  it("in feet are metres all the same", () => {
    const feet = cloudOf(UTM.replace("+units=m", "+units=us-ft"), { vertical: "ellipsoidal" });
    const foot = 1200 / 3937;
    const a = feet.vertex(500000 / foot, 5300000 / foot, 0);
    const b = feet.vertex(500000 / foot + 1000, 5300000 / foot, 100);
    const { grid, vertical } = measureDistance(a, b);
    expect(grid?.distance.value).toBeCloseTo(1000 * foot, 6);
    expect(vertical.value).toBeCloseTo(100 * foot, 9);
  });

  it("have no grid across projections, and heights of their own only where they share them", () => {
    const other = cloudOf(UTM.replace("32", "33"), { name: "other", vertical: "ellipsoidal" });
    const a = utm.vertex(500000, 5300000, 1);
    const b = other.vertex(500000, 5300000, 2);
    expect(measureDistance(a, b)).not.toHaveProperty("grid");
    expect(measureDistance(a, b).heights).toBe("ellipsoid WGS 84");
    expect(measureDistance(a, utm.vertex(500001, 5300000, 3)).heights).toBe("scan: unknown");
  });
});

describe("polylines", () => {
  it("add up, wherever they are split", () => {
    fc.assert(
      fc.property(fc.array(place, { minLength: 3, maxLength: 9 }), fc.nat(), (vertices, at) => {
        const split = 1 + (at % (vertices.length - 2));
        const whole = measurePolyline(vertices);
        const halves = [vertices.slice(0, split + 1), vertices.slice(split)].map((part) =>
          measurePolyline(part),
        );
        for (const name of ["space", "geodesic", "horizontal"] as const) {
          const sum = halves[0][name].value + halves[1][name].value;
          expect(Math.abs(sum - whole[name].value)).toBeLessThan(1e-6);
        }
        expect(whole.ascent.value - whole.descent.value).toBeCloseTo(
          vertices.at(-1)!.height - vertices[0].height,
          5,
        );
      }),
    );
  });

  it("of one vertex are refused by name", () => {
    expect(() => measurePolyline([placeVertex(0, 0, 0)])).toThrow(/MEASURE_VERTICES: a line: .*Add 1 more/);
  });
});

describe("directions", () => {
  it("forward and back, and slope", () => {
    const a = placeVertex(0.2, 0.8, 100);
    const b = beside(0.2, 0.8, 100, 100, 100, 10);
    const { forward, back, slope } = measureDirection(a, b);
    expect(forward?.value).toBeCloseTo(45 * DEGREE, 6);
    expect(back!.value - forward!.value).toBeCloseTo(Math.PI, 4);
    // The level drops from under the tangent by half the squared length over the radius.
    expect(Math.tan(slope!.value)).toBeCloseTo((10 + 1e4 / 6.38e6) / Math.hypot(100, 100), 6);
  });

  it("in the grid differ from the azimuth by convergence and arc-to-chord", () => {
    const [a, b] = [utm.vertex(700000, 5300000, 0), utm.vertex(700100, 5320000, 0)];
    const { forward, grid } = measureDirection(a, b);
    const { bearing, convergence, arcToChord } = grid!;
    expect(bearing.value).toBeCloseTo(Math.atan2(100, 20000), 12);
    const lat = a.latitude;
    // Convergence of a transverse Mercator projection: tan γ = tan Δλ sin φ, to first orders.
    expect(convergence).toBeCloseTo(Math.atan(Math.tan(a.longitude - 9 * DEGREE) * Math.sin(lat)), 5);
    expect(bearing.value + convergence + arcToChord).toBeCloseTo(forward!.value, 9);
    expect(Math.abs(arcToChord)).toBeGreaterThan(1e-6);
    expect(Math.abs(arcToChord)).toBeLessThan(1e-4);
  });

  it("of one point above the other are up or down, and nowhere in plane", () => {
    const [a, b] = [placeVertex(1, 1, 0), placeVertex(1, 1, 5)];
    expect(measureDirection(a, b)).toEqual({ slope: expect.objectContaining({ value: Math.PI / 2 }) });
    expect(measureDirection(a, a)).toEqual({});
  });
});

describe("angles", () => {
  it("are right down to the smallest, and refused without a side", () => {
    const at = (e: number, n: number, u: number) => beside(0.3, -0.9, 50, e, n, u);
    expect(measureAngle(at(10, 0, 0), at(0, 0, 0), at(0, 0, 7)).space.value).toBeCloseTo(Math.PI / 2, 8);
    expect(measureAngle(at(1000, 0, 0), at(0, 0, 0), at(1000, 0.001, 0)).space.value).toBeCloseTo(1e-6, 10);
    expect(measureAngle(at(10, 0, 0), at(0, 0, 0), at(-10, 0, 0)).space.value).toBeCloseTo(Math.PI, 7);
    expect(measureAngle(at(0, 10, 0), at(0, 0, 0), at(10, 0, 0)).horizontal?.value).toBeCloseTo(
      Math.PI / 2,
      5,
    );
    expect(() => measureAngle(at(0, 0, 0), at(0, 0, 0), at(1, 0, 0))).toThrow("MEASURE_COINCIDENT");
    const straight = measureAngle(at(10, 0, 0), at(0, 0, 0), at(20, 0, 0), { precision: 0.001 }).space;
    expect(Number.isFinite(straight.atLeast)).toBe(true);
  });
});

describe("circles", () => {
  const at = (angle: number, radius: number) => {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return beside(0.5, 0.5, 20, 0.6 * radius * c, radius * s, 0.8 * radius * c);
  };
  it("through three points of it, with the arc through the second", () => {
    fc.assert(
      fc.property(finite(0.5, 100), finite(0.3, 2.5), finite(0.3, 2.5), (radius, first, second) => {
        const circle = measureCircle(at(0, radius), at(first, radius), at(first + second, radius));
        const { arc } = circle;
        expect(circle.radius.value / radius).toBeCloseTo(1, 5);
        expect(arc.angle.value).toBeCloseTo(first + second, 5);
        expect(arc.chord.value / (2 * radius * Math.sin((first + second) / 2))).toBeCloseTo(1, 4);
        expect(arc.length.value / (radius * (first + second))).toBeCloseTo(1, 5);
        expect(arc.sagitta.value / (radius * (1 - Math.cos((first + second) / 2)))).toBeCloseTo(1, 4);
        expect(measureDistance(circle.centre, at(1, radius)).space.value / radius).toBeCloseTo(1, 5);
      }),
    );
  });

  it("through points on a line are none", () => {
    const on = (n: number) => beside(0.5, 0.5, 20, n, 2 * n, 0);
    expect(() => measureCircle(on(0), on(1), on(7))).toThrow("MEASURE_COLLINEAR");
    expect(() => measureCircle(on(0), on(0), on(7))).toThrow("MEASURE_COLLINEAR");
  });
});

describe("planes", () => {
  it("of three points has no deviation, however large it is", () => {
    const plane = measurePlane([
      beside(0.1, 0.9, 0, 0, 0, 0),
      beside(0.1, 0.9, 0, 7000, 10, 50),
      beside(0.1, 0.9, 0, 30, 6000, -80),
    ]);
    expect(plane.deviation.value).toBeLessThan(1e-9);
  });

  it("of a slope to the south-east, with the residual of a point above", () => {
    const at = (e: number, n: number, above = 0) =>
      beside(0.1, 0.9, 0, e, n, -Math.tan(0.2) * ((e - n) / Math.SQRT2) + above);
    const plane = measurePlane([at(0, 0), at(10, 0), at(10, 10), at(0, 10)]);
    expect(plane.slope.value).toBeCloseTo(0.2, 6);
    expect(plane.aspect?.value).toBeCloseTo(135 * DEGREE, 4);
    expect(plane.deviation.value).toBeLessThan(1e-6);
    const { residuals } = measurePlane([at(0, 0), at(10, 0), at(10, 10), at(0, 10), at(5, 5, 0.5)]);
    expect(residuals[4]).toBeCloseTo(0.4 * Math.cos(0.2), 4);
    expect(residuals.reduce((sum, one) => sum + one, 0)).toBeCloseTo(0, 8);
    expect(() => measurePlane([at(0, 0), at(1, 1), at(2, 2)])).toThrow("MEASURE_COLLINEAR");
    expect(() => measurePlane([at(0, 0), at(1, 1)])).toThrow("MEASURE_VERTICES");
  });
});

describe("what is not asked for", () => {
  it("is not worked out: a polygon's perimeter is one sum, not a hundred distances", () => {
    let asked = 0;
    const precision = () => {
      asked++;
      return 0.01;
    };
    const ring = Array.from({ length: 100 }, (_, i) => {
      const angle = (2 * Math.PI * i) / 100;
      return utm.vertex(500000 + 50 * Math.cos(angle), 5300000 + 50 * Math.sin(angle), 0);
    });
    const { perimeter } = measureArea(ring, { precision });
    expect(perimeter.space.value).toBeCloseTo(2 * Math.PI * 50, 0);
    // Once for each edge; as distances they would ask ten times each.
    expect(asked).toBeLessThan(150);
    expect(perimeter.parts).toHaveLength(100);
    expect(perimeter.parts).toBe(perimeter.parts);
    const sum = perimeter.parts.reduce((total, { space }) => total + space.value, 0);
    expect(sum).toBeCloseTo(perimeter.space.value, 9);
    expect(perimeter.grid?.scaleFactor).toBeCloseTo(0.9996, 6);
    // As objects go: whoever copies it, or writes it down, has all of it.
    expect(Object.keys({ ...perimeter }).sort()).toEqual([
      "ascent",
      "descent",
      "geodesic",
      "grid",
      "horizontal",
      "parts",
      "space",
    ]);
  });
});

describe("what is no place", () => {
  it.each<[string, () => unknown]>([
    ["no number", () => placeVertex(Number.NaN, 0, 0)],
    ["a latitude beyond the pole", () => placeVertex(0, 1.6, 0)],
    ["degrees", () => placeVertex(7, 47, 0)],
    ["degrees of longitude", () => placeVertex(17, 1, 0)],
    ["half of ECEF", () => ecefVertex([1, 2])],
    [
      "a precision below 0",
      () => measureDistance(utm.vertex(0, 0, 0), utm.vertex(1, 0, 0), { precision: -1 }),
    ],
    [
      "a precision that is none",
      () => measureDistance(utm.vertex(0, 0, 0), utm.vertex(1, 0, 0), { precision: () => Number.NaN }),
    ],
    [
      "half a precision",
      () =>
        measureDistance(utm.vertex(0, 0, 0), utm.vertex(1, 0, 0), { precision: { horizontal: 1 } as never }),
    ],
    [
      "no precision",
      () => measureDistance(utm.vertex(0, 0, 0), utm.vertex(1, 0, 0), { precision: null as never }),
    ],
    ["a kind that there is not", () => valuesOf({ kind: "toString" as never, vertices: [] })],
  ])("is refused: %s", (_, place) => {
    expect(place).toThrow(/^MEASURE_OPTION: /);
  });

  it("is refused with too few vertices, or too many", () => {
    const a = utm.vertex(500000, 5300000, 0);
    expect(() => valuesOf({ kind: "distance", vertices: [a] })).toThrow("it needs 2 vertices and has 1");
    expect(() => valuesOf({ kind: "point", vertices: [a, a] })).toThrow("it needs 1 vertices and has 2");
    expect(() => measureArea([a, a, a])).toThrow("all its vertices stand in one place");
  });

  it("is none at the poles and past the antimeridian", () => {
    for (const [longitude, latitude] of [
      [Math.PI, Math.PI / 2],
      [-Math.PI, -Math.PI / 2],
      [1.5 * Math.PI, 0],
    ] as const) {
      expect(placeVertex(longitude, latitude, 0).latitude).toBeCloseTo(latitude, 12);
    }
  });
});

describe("a point", () => {
  it("is read in every frame", () => {
    const a = utm.vertex(500000, 5300000, 12.345);
    const { source, longitude, height, local, record, crs } = readOut(utm.vertex(500003, 5300004, 13), {
      origin: a,
    });
    expect(source).toEqual([500003, 5300004, 13]);
    expect(record?.integers).toEqual([500003000, 1300004000, 13000]);
    expect(crs).toBe(utm.crs.name);
    expect(longitude.value / DEGREE).toBeCloseTo(9, 3);
    expect(height.value).toBeCloseTo(13, 6);
    expect(height.uncertainty).toBeNull();
    expect(local?.map(({ value }) => value)).toEqual([
      expect.closeTo(3 / 0.9996, 3),
      expect.closeTo(4 / 0.9996, 3),
      expect.closeTo(0.655, 4),
    ]);
  });
});
