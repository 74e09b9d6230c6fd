import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { distance, random } from "../cartesian/points.fixture.js";
import {
  compileTransformation,
  fitPatchwork,
  PATCHWORK_TOLERANCE,
  type Patchwork,
  PlacementError,
  type ProjectionSampler,
  type Rectangle,
  WGS84,
} from "../index.js";
import { samplerOf } from "./sampler.fixture.js";

const DEGREE = Math.PI / 180;

/** Projections and where in them domains are drawn, source units. */
const PROJECTIONS: ReadonlyArray<{ proj4: string; area: Rectangle }> = [
  { proj4: "+proj=utm +zone=32 +ellps=WGS84", area: { minX: 200e3, minY: 100e3, maxX: 800e3, maxY: 8000e3 } },
  {
    proj4: "+proj=utm +zone=60 +ellps=WGS84",
    area: { minX: 600e3, minY: 1000e3, maxX: 2200e3, maxY: 6000e3 },
  },
  {
    proj4: "+proj=lcc +lat_1=45 +lat_2=49 +lat_0=47 +lon_0=3 +x_0=600000 +y_0=200000 +ellps=WGS84",
    area: { minX: 100e3, minY: -200e3, maxX: 1200e3, maxY: 900e3 },
  },
  {
    proj4: "+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=WGS84",
    area: { minX: 2700e3, minY: 1500e3, maxX: 6000e3, maxY: 5000e3 },
  },
  {
    proj4:
      "+proj=sterea +lat_0=52.1561605555556 +lon_0=5.38763888888889 +k=0.9999079 +x_0=155000 +y_0=463000 +ellps=bessel",
    area: { minX: 0, minY: 300e3, maxX: 300e3, maxY: 630e3 },
  },
  {
    proj4: "+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +ellps=WGS84",
    area: { minX: 300e3, minY: -3000e3, maxX: 2000e3, maxY: -300e3 },
  },
];

/** Degrees as they are, longitudes wrapped to ±180° as an engine may do. */
const geographic: ProjectionSampler = async (points) =>
  points.map((value, i) => {
    const wrapped = i % 2 === 0 ? value - 360 * Math.round(value / 360) : value;
    return wrapped * DEGREE;
  });

/** Longitude and latitude by the patchwork, on the unit sphere: turns of longitude do not count there. */
function onSphere(patchwork: Patchwork) {
  const { evaluate } = compileTransformation({
    steps: [
      { kind: "projection", patchwork },
      { kind: "geocentric", ellipsoid: { a: WGS84.a, f: 0 } },
    ],
  });
  return (x: number, y: number) => {
    const out = new Float64Array(3);
    evaluate(x, y, 0, out, 0);
    return out;
  };
}

function sphere(longitude: number, latitude: number): number[] {
  const a = WGS84.a;
  return [
    a * Math.cos(latitude) * Math.cos(longitude),
    a * Math.cos(latitude) * Math.sin(longitude),
    a * Math.sin(latitude),
  ];
}

async function codeOf(promise: Promise<unknown>): Promise<string> {
  const error = await promise.then(
    () => undefined,
    (reason: unknown) => reason,
  );
  return error instanceof PlacementError ? error.code : `no PlacementError but ${String(error)}`;
}

const unit = fc.noBias(fc.integer({ min: 0, max: 1e6 })).map((i) => i / 1e6);

describe("patchwork", () => {
  it("is certified: random points of random domains lie within its bound", async () => {
    await fc.assert(
      fc.asyncProperty(
        fc.constantFrom(...PROJECTIONS),
        fc.tuple(unit, unit),
        unit,
        unit,
        fc.integer(),
        async ({ proj4, area }, [atX, atY], size, flatness, seed) => {
          const width = (area.maxX - area.minX) * 10 ** (-5 * size);
          const height = (area.maxY - area.minY) * 10 ** (-5 * size - flatness);
          const minX = area.minX + atX * (area.maxX - area.minX - width);
          const minY = area.minY + atY * (area.maxY - area.minY - height);
          const sample = samplerOf(proj4);
          const patchwork = await fitPatchwork(sample, {
            minX,
            minY,
            maxX: minX + width,
            maxY: minY + height,
          });
          expect(patchwork.bound).toBeLessThanOrEqual(PATCHWORK_TOLERANCE);
          expect(sample.calls).toBeLessThanOrEqual(9);

          const next = random(seed);
          const points = Float64Array.from({ length: 400 }, (_, i) =>
            i % 2 === 0 ? minX + next() * width : minY + next() * height,
          );
          points.set([minX, minY, minX + width, minY + height, minX, minY + height]);
          const places = await sample(points);
          const fitted = onSphere(patchwork);
          for (let i = 0; i < points.length; i += 2) {
            const got = fitted(points[i], points[i + 1]);
            expect(distance(got, sphere(places[i], places[i + 1]))).toBeLessThanOrEqual(patchwork.bound);
          }
        },
      ),
      { numRuns: 100, seed: 3 },
    );
  });

  it("meets at its seams: neighbouring patches agree to twice the bound", async () => {
    const { proj4 } = PROJECTIONS[3];
    const patchwork = await fitPatchwork(samplerOf(proj4), {
      minX: 3000e3,
      minY: 2000e3,
      maxX: 5500e3,
      maxY: 4500e3,
    });
    const { patches, bound } = patchwork;
    expect(patches.length).toBeGreaterThan(1);
    let met = 0;
    for (const west of patches) {
      for (const east of patches.filter(({ minX }) => minX === west.maxX)) {
        const [from, to] = [Math.max(west.minY, east.minY), Math.min(west.maxY, east.maxY)];
        for (let t = 0; t <= 1 && from < to; t += 0.1) {
          const y = from + t * (to - from);
          const [a, b] = [west, east].map((patch) => onSphere({ patches: [patch], bound })(west.maxX, y));
          expect(distance(a, b)).toBeLessThanOrEqual(2 * bound);
          met++;
        }
      }
    }
    expect(met).toBeGreaterThan(0);
  });

  it("takes one call for what is smooth, and a low degree for what is small", async () => {
    const sample = samplerOf(PROJECTIONS[4].proj4);
    const { patches } = await fitPatchwork(sample, { minX: 150e3, minY: 450e3, maxX: 160e3, maxY: 460e3 });
    expect(sample.calls).toBe(1);
    expect(patches).toHaveLength(1);
    expect(patches[0].degree).toBeLessThanOrEqual(3);
  });

  it("holds across the antimeridian, however longitudes are wrapped", async () => {
    const patchwork = await fitPatchwork(geographic, { minX: 178, minY: -20, maxX: 183, maxY: -15 });
    const fitted = onSphere(patchwork);
    for (const x of [178, 179.99, 180, 180.01, 183]) {
      expect(distance(fitted(x, -17), sphere(x * DEGREE, -17 * DEGREE))).toBeLessThan(1e-5);
    }
  });

  it("holds for geographic coordinates up to a pole", async () => {
    const patchwork = await fitPatchwork(geographic, { minX: -180, minY: -90, maxX: 180, maxY: 90 });
    expect(patchwork.patches).toHaveLength(1);
    expect(distance(onSphere(patchwork)(17, 90), sphere(0, Math.PI / 2))).toBeLessThan(1e-5);
  });

  it("holds for a domain of one point", async () => {
    const sample = samplerOf(PROJECTIONS[0].proj4);
    const patchwork = await fitPatchwork(sample, { minX: 500e3, minY: 5e6, maxX: 500e3, maxY: 5e6 });
    const [longitude, latitude] = await sample(Float64Array.of(500e3, 5e6));
    expect(distance(onSphere(patchwork)(500e3, 5e6), sphere(longitude, latitude))).toBeLessThan(
      patchwork.bound,
    );
  });

  it.each([
    ["inside", { minX: -50e3, minY: -30e3, maxX: 40e3, maxY: 60e3 }],
    ["in the middle", { minX: -1e3, minY: -1e3, maxX: 1e3, maxY: 1e3 }],
    ["on the corner", { minX: 0, minY: 0, maxX: 1e3, maxY: 1e3 }],
    ["on an edge", { minX: -500e3, minY: 0, maxX: 400e3, maxY: 900e3 }],
  ])("counts from its own middle with a pole %s of the domain", async (_, domain) => {
    const sample = samplerOf("+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +ellps=WGS84");
    const patchwork = await fitPatchwork(sample, domain);
    expect(patchwork.centre).toBeDefined();
    const fitted = onSphere(patchwork);
    const next = random(5);
    const points = Array.from({ length: 200 }, () => [
      domain.minX + next() * (domain.maxX - domain.minX),
      domain.minY + next() * (domain.maxY - domain.minY),
    ]);
    for (const [x, y] of [[0, 0], [1e-7, 0], [0, 1e-3], ...points]) {
      const [longitude, latitude] = await sample(Float64Array.of(x, y));
      expect(distance(fitted(x, y), sphere(longitude, latitude))).toBeLessThanOrEqual(patchwork.bound);
    }
  });

  it("has derivatives and an inverse up to the pole", async () => {
    const sample = samplerOf("+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +ellps=WGS84");
    const patchwork = await fitPatchwork(sample, { minX: -1e3, minY: -2e3, maxX: 3e3, maxY: 1e3 });
    const geocentric = { kind: "geocentric", ellipsoid: { a: WGS84.a, f: WGS84.f } } as const;
    const compiled = compileTransformation({ steps: [{ kind: "projection", patchwork }, geocentric] });
    const [ecef, source, plus, minus] = [0, 0, 0, 0].map(() => new Float64Array(3));
    const jacobian = new Float64Array(9);
    for (const [x, y] of [
      [0, 0],
      [1e-6, -1e-6],
      [0, 0.001],
      [-900, 800],
      [0, -1],
    ]) {
      compiled.forward(x, y, 7, ecef);
      compiled.inverse(ecef[0], ecef[1], ecef[2], source);
      expect(
        Math.max(Math.abs(source[0] - x), Math.abs(source[1] - y), Math.abs(source[2] - 7)),
      ).toBeLessThan(1e-6);
      compiled.jacobian(x, y, 7, jacobian);
      for (const column of [0, 1]) {
        compiled.forward(x + (1 - column), y + column, 7, plus);
        compiled.forward(x - (1 - column), y - column, 7, minus);
        for (let row = 0; row < 3; row++) {
          expect(jacobian[3 * row + column]).toBeCloseTo((plus[row] - minus[row]) / 2, 5);
        }
      }
    }
  });

  it("refuses a pole with most of the earth around it", async () => {
    // Degrees from the pole, in all directions.
    const sample: ProjectionSampler = async (points) => {
      const places = new Float64Array(points.length);
      for (let i = 0; i < points.length; i += 2) {
        const [x, y] = points.subarray(i, i + 2);
        places.set([Math.atan2(x, -y), Math.PI / 2 - Math.hypot(x, y) * DEGREE], i);
      }
      return places;
    };
    const domain = { minX: -100, minY: -100, maxX: 100, maxY: 100 };
    expect(await codeOf(fitPatchwork(sample, domain))).toBe("PLACE_POLE");
  });

  it("refuses longitudes that jump", async () => {
    const torn: ProjectionSampler = async (points) =>
      points.map((value, i) => (i % 2 === 0 ? value * DEGREE + (value > 0.1 ? 3 : 0) : value * DEGREE));
    expect(await codeOf(fitPatchwork(torn, { minX: -1, minY: 40, maxX: 1, maxY: 41 }))).toBe(
      "PLACE_ANTIMERIDIAN",
    );
  });

  it("refuses what is not smooth, and what is nowhere", async () => {
    const noise: ProjectionSampler = async (points) =>
      points.map((value) => value * DEGREE + 1e-6 * Math.sin(1e9 * value));
    const domain = { minX: 5, minY: 40, maxX: 6, maxY: 41 };
    expect(await codeOf(fitPatchwork(noise, domain))).toBe("PLACE_PATCHWORK");
    const nowhere: ProjectionSampler = async (points) =>
      points.map((value) => (value > 40.9 ? Number.NaN : value));
    expect(await codeOf(fitPatchwork(nowhere, domain))).toBe("PLACE_DOMAIN");
    expect(await codeOf(fitPatchwork(geographic, { ...domain, maxX: Number.NaN }))).toBe("PLACE_DOMAIN");
  });
});
