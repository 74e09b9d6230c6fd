import fc from "fast-check";
import proj4 from "proj4";
import { describe, expect, it } from "vitest";
import { distance, radians, random } from "../cartesian/points.fixture.js";
import { lookup } from "../crs/epsg-table.fixture.js";
import {
  compileTransformation,
  deriveTransformation,
  domainAround,
  ecefToGeodetic,
  exactTransform,
  fitPlacement,
  geodeticToEcef,
  type Placement,
  place,
  resolveCrs,
} from "../index.js";
import { crsAreas, squareNode } from "./areas.fixture.js";

const unit = fc.noBias(fc.integer({ min: 0, max: 1e6 })).map((i) => i / 1e6);
const finite = (min: number, max: number) => fc.double({ min, max, noNaN: true, noDefaultInfinity: true });

const one = new Float64Array(3);
const other = new Float64Array(3);

const utm = (zone: number) => {
  const crs = resolveCrs({ file: `zone ${zone}`, given: `EPSG:${32600 + zone}` }, lookup);
  const { forward } = proj4("WGS84", crs.proj4);
  return {
    exact: exactTransform(crs),
    /** Easting and northing. */
    plane: (longitude: number, latitude: number) => forward([longitude, latitude]) as [number, number],
  };
};
const zones = Array.from({ length: 60 }, (_, i) => utm(i + 1));

/** A node of 200 m around a point. */
function nodeAround([x, y]: readonly [number, number]) {
  return { minX: x - 100, maxX: x + 100, minY: y - 100, maxY: y + 100, minZ: 0, maxZ: 200 };
}

describe("seams", () => {
  it("between neighbouring nodes: the points of their common side agree within both bounds", () => {
    const area = fc.constantFrom(...crsAreas);
    fc.assert(
      fc.property(area, unit, fc.tuple(unit, unit), fc.integer(), (area, size, at, seed) => {
        const edge = 10 ** (size * Math.log10(area.largest));
        const west = squareNode(area, edge, at, 500);
        const east = { ...west, minX: west.maxX, maxX: 2 * west.maxX - west.minX };
        const [left, right] = [west, east].map((domain) => fitPlacement(area.exact, domain, 0.001));
        const next = random(seed);
        const within = (low: number, high: number) => low + next() * (high - low);
        for (let i = 0; i < 20; i++) {
          const y = within(west.minY, west.maxY);
          const z = within(west.minZ, west.maxZ);
          place(left, west.maxX, y, z, one);
          place(right, west.maxX, y, z, other);
          expect(distance(one, other)).toBeLessThanOrEqual(left.fitBound + right.fitBound + 1e-8);
        }
      }),
      { numRuns: 500 },
    );
  });

  it("between UTM zones, the antimeridian's included: twins agree to 1 mm, from zone edges to 20° beyond", () => {
    const zone = fc.integer({ min: 0, max: 59 });
    fc.assert(
      fc.property(zone, finite(-20, 20), finite(0, 84), unit, (i, beyond, latitude, high) => {
        const edge = -174 + 6 * i;
        const longitude = edge + beyond;
        const placed = [zones[i], zones[(i + 1) % 60]].map(({ exact, plane }, n): Float64Array => {
          const [x, y] = plane(longitude, latitude);
          const placement: Placement = fitPlacement(exact, nodeAround([x, y]), 0.001);
          place(placement, x, y, 200 * high, n === 0 ? one : other);
          return n === 0 ? one : other;
        });
        expect(distance(placed[0], placed[1])).toBeLessThanOrEqual(0.001);
        geodeticToEcef(radians(longitude), radians(latitude), 200 * high, other);
        expect(distance(placed[0], other)).toBeLessThanOrEqual(0.001);
      }),
      { numRuns: 2000 },
    );
  });

  it("at the antimeridian of a geographic CRS: 180° E and 180° W are one place", () => {
    const { exact } = crsAreas.find(({ crs }) => crs.code === "EPSG:4326")!;
    const parts = new Float64Array(12);
    fc.assert(
      fc.property(finite(-90, 90), finite(0, 20), (latitude, beyond) => {
        exact(180 + beyond, latitude, parts, 0);
        exact(-180 + beyond, latitude, parts, 6);
        for (let k = 0; k < 6; k++) expect(Math.abs(parts[k] - parts[k + 6])).toBeLessThanOrEqual(1e-8);
      }),
    );
  });
});

describe("poles", () => {
  const polar = ["EPSG:5041", "EPSG:3413"].map((code) => crsAreas.find(({ crs }) => crs.code === code)!);
  const origins = [2e6, 0];

  it("inside a node of a polar projection: certified, and the pole itself in its place", () => {
    fc.assert(
      fc.property(fc.nat(1), finite(1, 5), unit, unit, (which, exponent, s, t) => {
        const { exact } = polar[which];
        const pole = origins[which];
        const edge = 10 ** exponent;
        const domain = {
          ...{ minX: pole - s * edge, maxX: pole + (1 - s) * edge },
          ...{ minY: pole - t * edge, maxY: pole + (1 - t) * edge, minZ: 0, maxZ: 3000 },
        };
        const placement = fitPlacement(exact, domain, 0.001);
        place(placement, pole, pole, 0, one);
        expect(distance(one, [0, 0, 6356752.314245179])).toBeLessThanOrEqual(placement.fitBound + 1e-8);
      }),
      { numRuns: 300 },
    );
  });

  it("geographic coordinates go up to a pole and not past it", () => {
    const { exact } = crsAreas.find(({ crs }) => crs.code === "EPSG:4326")!;
    fc.assert(
      fc.property(finite(-180, 180), finite(1e-6, 1), fc.constantFrom(1, -1), (longitude, width, side) => {
        const up = { minX: longitude, maxX: longitude + width, minZ: 0, maxZ: 100 };
        const touching = side > 0 ? { minY: 90 - width, maxY: 90 } : { minY: -90, maxY: width - 90 };
        const placement = fitPlacement(exact, { ...up, ...touching }, 0.001);
        place(placement, longitude, side * 90, 0, one);
        expect(distance(one, [0, 0, side * 6356752.314245179])).toBeLessThanOrEqual(
          placement.fitBound + 1e-8,
        );
        const past =
          side > 0 ? { minY: 90 - width, maxY: 90 + width } : { minY: -90 - width, maxY: width - 90 };
        expect(() => fitPlacement(exact, { ...up, ...past }, 0.001)).toThrow("PLACE_DOMAIN");
      }),
      { numRuns: 200 },
    );
  });
});

describe("a transformation derived for geographic coordinates", () => {
  it.each([
    [-90, 90, "EPSG:4326"],
    [89.99, 90, "EPSG:4326"],
    [99.99, 100, "EPSG:4807"],
  ])(
    "from %d to %d of %s holds on the pole, and one step of integers around is no latitude",
    async (low, high, code) => {
      const crs = resolveCrs({ file: code, given: code }, lookup);
      const bounds = { min: [10, low, 0], max: [12, high, 9] };
      const domain = domainAround(bounds, [1e-7, 1e-7, 1e-3], crs.horizontalUnit);
      expect(domain.maxY).toBe(high);
      expect(domain.minX).toBe(10 - 1e-7);
      const { forward } = compileTransformation(await deriveTransformation(crs, domain), code);
      const exact = exactTransform(crs);
      for (const y of [low, (low + high) / 2, high]) {
        forward(11, y, 5, one);
        const parts = new Float64Array(6);
        exact(11, y, parts, 0);
        const there = [0, 1, 2].map((axis) => parts[axis] + 5 * parts[axis + 3]);
        expect(distance(one, there)).toBeLessThan(1e-4);
      }
    },
  );
});

describe("a transformation derived for a square around the pole of an equal-area projection", () => {
  it.each([50, 3000])("holds, though proj4js loses digits there: %d m", async (half) => {
    const crs = resolveCrs({ file: "EPSG:3575", given: "EPSG:3575" }, lookup);
    const domain = { minX: -half, minY: -half, minZ: 0, maxX: half, maxY: half, maxZ: 9 };
    const { forward } = compileTransformation(await deriveTransformation(crs, domain), "EPSG:3575");
    // Near the pole its scale is 1, and x and y are those of the plane that touches there, turned by 10°.
    const turn = radians(10);
    for (const [x, y] of [
      [0, 0],
      [0.01, 0],
      [-0.3 * half, 0.7 * half],
      [half, half],
    ]) {
      forward(x, y, 0, one);
      const there = [x * Math.cos(turn) - y * Math.sin(turn), x * Math.sin(turn) + y * Math.cos(turn)];
      expect(Math.hypot(one[0] + there[1], one[1] - there[0])).toBeLessThan(1e-4 + half ** 3 / 6.3e13);
      expect(Math.abs(one[2] - 6356752.3142 + (x * x + y * y) / 2 / 6.3996e6)).toBeLessThan(1e-3);
    }
  });
});

describe("round trips through a projection", () => {
  it("come back to 10 nm: UTM to 20° beyond its zone, to the pole", () => {
    const zone = fc.integer({ min: 0, max: 59 });
    const parts = new Float64Array(6);
    fc.assert(
      fc.property(
        zone,
        finite(-23, 23),
        finite(-80, 89.9),
        finite(-1000, 9000),
        (i, off, latitude, height) => {
          const longitude = -177 + 6 * i + off;
          const [x, y] = zones[i].plane(longitude, latitude);
          zones[i].exact(x, y, parts, 0);
          for (let axis = 0; axis < 3; axis++) one[axis] = parts[axis] + height * parts[axis + 3];
          geodeticToEcef(radians(longitude), radians(latitude), height, other);
          expect(distance(one, other)).toBeLessThanOrEqual(1e-8);
          ecefToGeodetic(one[0], one[1], one[2], other);
          expect(Math.abs(other[2] - height)).toBeLessThanOrEqual(1e-8);
        },
      ),
      { numRuns: 5000 },
    );
  });
});
