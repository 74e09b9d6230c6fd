import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { distance, random } from "../cartesian/points.fixture.js";
import { fitPlacement, type Placement, PlacementError, place, placeIntegers } from "../index.js";
import { type CrsArea, crsAreas, squareNode } from "./areas.fixture.js";

/** Evenly from 0 to 1; doubles of fast-check crowd at the ends. */
const unit = fc.noBias(fc.integer({ min: 0, max: 1e6 })).map((i) => i / 1e6);
const node = fc.record({
  area: fc.constantFrom(...crsAreas),
  at: fc.tuple(unit, unit),
  /** Decimal logarithm of the edge, as a share of what the CRS allows. */
  size: unit,
  height: unit.map((t) => 4100 * t - 100),
  tolerance: fc.constantFrom(0.0001, 0.001, 0.01, 0.1),
  seed: fc.integer(),
});

const parts = new Float64Array(6);
const want = new Float64Array(3);
const got = new Float64Array(3);

/** Node frame (float32) → ECEF of point i. */
function toEcefOf(
  { frame: { origin, rotation: r } }: Placement,
  local: Float32Array,
  i: number,
): Float64Array {
  const [e, n, u] = local.subarray(3 * i, 3 * i + 3);
  for (let axis = 0; axis < 3; axis++) {
    got[axis] = origin[axis] + r[axis] * e + r[axis + 3] * n + r[axis + 6] * u;
  }
  return got;
}

/** Largest distance of a placement's points from the exact transform, stored as float32; and by `place`, float64. */
function measure(
  area: CrsArea,
  placement: Placement,
  seed: number,
  count: number,
): { stored: number; fitted: number } {
  const { minX, minY, minZ, maxX, maxY, maxZ } = placement.domain;
  const next = random(seed);
  // Integers of about 2⁻³⁰ of the domain: what is left of it would be quantisation, not placement.
  const offset = [(minX + maxX) / 2, (minY + maxY) / 2, (minZ + maxZ) / 2];
  const scale = [(maxX - minX) * 2 ** -30, (maxY - minY) * 2 ** -30, (maxZ - minZ) * 2 ** -30];
  const xyz = new Int32Array(3 * count);
  // The first eight points are the corners, where polynomials err most.
  for (let i = 0; i < 3 * count; i++) {
    const corner = (Math.floor(i / 3) >> (i % 3)) & 1 ? 1 : -1;
    xyz[i] = Math.trunc((i < 24 ? corner : 2 * next() - 1) * (2 ** 29 - 1));
  }
  const local = new Float32Array(3 * count);
  placeIntegers(placement, xyz, count, scale, offset, local);
  let stored = 0;
  let fitted = 0;
  for (let i = 0; i < count; i++) {
    const [x, y, z] = [0, 1, 2].map((axis) => xyz[3 * i + axis] * scale[axis] + offset[axis]);
    area.exact(x, y, parts, 0);
    for (let axis = 0; axis < 3; axis++) want[axis] = parts[axis] + z * parts[axis + 3];
    stored = Math.max(stored, distance(toEcefOf(placement, local, i), want));
    place(placement, x, y, z, got);
    fitted = Math.max(fitted, distance(got, want));
  }
  return { stored, fitted };
}

describe("certificate", () => {
  it("holds for 100 points in each of 1,000 random nodes, and every scheme is among them", () => {
    const seen = new Set<string>();
    fc.assert(
      fc.property(node, ({ area, at, size, height, tolerance, seed }) => {
        const edge = 10 ** (size * Math.log10(area.largest));
        const placement = fitPlacement(area.exact, squareNode(area, edge, at, height), tolerance);
        seen.add(placement.scheme);
        const { stored, fitted } = measure(area, placement, seed, 100);
        expect(stored).toBeLessThanOrEqual(placement.bound);
        expect(fitted).toBeLessThanOrEqual(
          placement.fitBound + 1e-9 * (placement.scheme === "exact" ? 1 : 0),
        );
        expect(placement.bound).toBe(placement.fitBound + placement.storageBound);
        if (placement.storageBound < tolerance) expect(placement.bound).toBeLessThanOrEqual(tolerance);
      }),
      { numRuns: 1000 },
    );
    const schemes = ["affine", "affineLinearNormal", "quadratic", "cubic", "quartic", "tensor6"];
    expect([...seen]).toEqual(expect.arrayContaining(schemes));
  });

  it("takes the exact transform where no polynomial is good enough, and stays within float32", () => {
    const area = crsAreas.find(({ crs }) => crs.code === "EPSG:3857")!;
    const domain = { minX: -1.9e7, maxX: 1.9e7, minY: -1e7, maxY: 1e7, minZ: 0, maxZ: 1000 };
    const placement = fitPlacement(area.exact, domain, 0.001);
    expect(placement.scheme).toBe("exact");
    expect(placement.bound).toBe(placement.storageBound);
    expect(measure(area, placement, 1, 100).stored).toBeLessThanOrEqual(placement.bound);
  });

  it("holds across the antimeridian and the poles", () => {
    const cases = [
      ["EPSG:4326", { minX: 179.9, maxX: 180.1, minY: -0.1, maxY: 0.1, minZ: 0, maxZ: 100 }],
      ["EPSG:4326", { minX: 10, maxX: 10.1, minY: 89.9, maxY: 90, minZ: 0, maxZ: 100 }],
      ["EPSG:5041", { minX: 1.999e6, maxX: 2.001e6, minY: 1.999e6, maxY: 2.001e6, minZ: 0, maxZ: 3000 }],
      ["EPSG:3857", { minX: 20036508, maxX: 20038508, minY: -1000, maxY: 1000, minZ: 0, maxZ: 100 }],
    ] as const;
    for (const [code, domain] of cases) {
      const area = crsAreas.find(({ crs }) => crs.code === code)!;
      const placement = fitPlacement(area.exact, domain, 0.001);
      expect(placement.bound).toBeLessThanOrEqual(0.001);
      expect(measure(area, placement, 3, 200).stored).toBeLessThanOrEqual(placement.bound);
    }
  });

  it("holds for a domain of one point and of one line", () => {
    for (const area of crsAreas) {
      const { minX, minY, minZ, maxX } = squareNode(area, 100, [0.4, 0.6], 500);
      for (const right of [minX, maxX]) {
        const domain = { minX, maxX: right, minY, maxY: minY, minZ, maxZ: minZ };
        const placement = fitPlacement(area.exact, domain, 0.001);
        expect(placement.scheme).toBe("affine");
        expect(measure(area, placement, 5, 20).stored).toBeLessThanOrEqual(placement.bound);
      }
    }
  });
});

describe("domains that cannot be placed", () => {
  const code = (task: () => unknown) => {
    try {
      task();
    } catch (error) {
      return error instanceof PlacementError ? error.code : String(error);
    }
    return "placed";
  };
  const utm = crsAreas.find(({ crs }) => crs.code === "EPSG:32633")!;
  const geographic = crsAreas.find(({ crs }) => crs.code === "EPSG:4326")!;

  it.each([
    [
      "over the pole of a geographic CRS",
      geographic,
      { minX: 0, maxX: 1, minY: 89.5, maxY: 90.5, minZ: 0, maxZ: 1 },
    ],
    [
      "UTM coordinates read as degrees",
      geographic,
      { minX: 5e5, maxX: 5.1e5, minY: 5e6, maxY: 5.1e6, minZ: 0, maxZ: 1 },
    ],
    [
      "far outside a transverse Mercator",
      utm,
      { minX: 1e8, maxX: 1.1e8, minY: 0, maxY: 1e6, minZ: 0, maxZ: 1 },
    ],
    ["not a number", utm, { minX: Number.NaN, maxX: 1, minY: 0, maxY: 1, minZ: 0, maxZ: 1 }],
    ["infinite", utm, { minX: 4e5, maxX: Number.POSITIVE_INFINITY, minY: 0, maxY: 1, minZ: 0, maxZ: 1 }],
    ["inside out", utm, { minX: 5e5, maxX: 4e5, minY: 0, maxY: 1, minZ: 0, maxZ: 1 }],
  ])("%s: PLACE_DOMAIN", (_, area, domain) => {
    expect(code(() => fitPlacement(area.exact, domain, 0.001))).toBe("PLACE_DOMAIN");
  });

  it.each([0, -1, Number.NaN])("a tolerance of %d: PLACE_TOLERANCE", (tolerance) => {
    const domain = squareNode(utm, 100, [0.5, 0.5], 0);
    expect(code(() => fitPlacement(utm.exact, domain, tolerance))).toBe("PLACE_TOLERANCE");
  });
});
