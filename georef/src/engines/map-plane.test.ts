import proj4 from "proj4";
import { describe, expect, it } from "vitest";
import { random } from "../cartesian/points.fixture.js";
import { lookup } from "../crs/epsg-table.fixture.js";
import {
  compileTransformation,
  type Domain,
  exactTransform,
  fitPatchwork,
  fitPlacement,
  type GridWindow,
  isOwnPlane,
  levelFrame,
  type MapPlane,
  placeIntegers,
  planeTransform,
  pointTransform,
  resolveCrs,
  type Step,
  type StepwiseTruth,
  type Truth,
  truthOnMap,
  truthOnWebMercator,
  WEB_MERCATOR_PLANE,
  WGS84,
} from "../index.js";
import { samplerOf } from "../transformation/sampler.fixture.js";

const DEGREE = Math.PI / 180;

/** The plane of an EPSG code. @param middle degrees */
function planeOf(code: string, middle: number, more: Partial<MapPlane> = {}): MapPlane {
  const crs = resolveCrs({ file: code, given: code }, lookup);
  const { kind, size } = crs.horizontalUnit;
  const metresPerUnit = kind === "angular" ? 6378137 * size : size;
  const common = { code, definition: crs.proj4, metresPerUnit, middle: middle * DEGREE };
  return { ...common, wraps: false, own: false, ...more };
}

/** Greatest distance of stored points of a node from what `want` says, in the plane, and what is certified. */
function worst(truth: Truth, domain: Domain, want: (x: number, y: number) => readonly number[]) {
  const placement = fitPlacement(truth, domain, 0.001, "node", levelFrame);
  const next = random(7);
  const low = [domain.minX, domain.minY, domain.minZ];
  const scale = [domain.maxX, domain.maxY, domain.maxZ].map((high, axis) => (high - low[axis]) / 2 ** 30);
  const xyz = Int32Array.from({ length: 300 }, () => Math.floor(next() * 2 ** 30));
  const local = new Float32Array(300);
  placeIntegers(placement, xyz, 100, scale, low, local);
  let off = 0;
  for (let i = 0; i < 300; i += 3) {
    const [x, y] = want(xyz[i] * scale[0] + low[0], xyz[i + 1] * scale[1] + low[1]);
    const { origin } = placement.frame;
    off = Math.max(off, Math.hypot(origin[0] + local[i] - x, origin[1] + local[i + 1] - y));
  }
  return { off, ...placement };
}

const NODES: readonly (readonly [source: string, x: number, y: number, edge: number, middle: number])[] = [
  ["EPSG:32632", 520e3, 5260e3, 1000, 9.3],
  ["EPSG:2056", 2683e3, 1247e3, 1000, 8.5],
  ["EPSG:2994", 637e3, 850e3, 3000, -123],
  ["EPSG:4326", 8.5, 47.3, 0.01, 8.5],
  ["EPSG:3413", 1e5, -2e6, 1000, -42],
];

describe("placing in the plane of a map", () => {
  const planes = ["EPSG:3857", "EPSG:32632", "EPSG:2056", "EPSG:3413", "EPSG:4326"];
  const pairs = NODES.flatMap((node) => planes.map((plane) => [node[0], plane, node] as const));

  it.each(pairs)("puts %s where proj4js puts it in %s", (source, code, [, x, y, edge, middle]) => {
    const crs = resolveCrs({ file: source, given: source }, lookup);
    const plane = planeOf(code, middle);
    const domain = { minX: x, minY: y, minZ: 0, maxX: x + edge, maxY: y + edge, maxZ: 40 };
    const truth = truthOnMap(exactTransform(crs, 20), plane, 20, crs.verticalUnit.size, source);
    const there = proj4(crs.proj4, plane.definition as string);
    const { off, bound } = worst(truth, domain, (px, py) => {
      // Without its own height: 0 is what proj4js takes for a place in plane, as OpenLayers has it.
      const at = there.forward([px, py]);
      return at.map((value) => value * plane.metresPerUnit);
    });
    // A datum shift at 40 m is not the same as at 0 m: 40 m of 6,400 km of what it shifts.
    const shifted = /towgs84=(?!0,0,0)/.test(crs.proj4 + plane.definition) ? 0.006 : 0;
    expect(off).toBeLessThanOrEqual(bound + shifted + 1e-6);
  });

  it("keeps x and y of the source in its own plane, whatever its transformation says", async () => {
    const own = planeOf("EPSG:32632", 9, { own: true });
    const next = random(3);
    const window: GridWindow = {
      ...{ grid: "chance", columns: 14, rows: 14, channels: 2, unit: 1 },
      ...{ west: 8.9 * DEGREE, south: 45.9 * DEGREE },
      ...{ stepLongitude: DEGREE / 60, stepLatitude: DEGREE / 60 },
      values: Float32Array.from({ length: 392 }, () => 1e-7 * next()),
    };
    const area = { minX: 494e3, minY: 5085e3, maxX: 504e3, maxY: 5096e3 };
    const patchwork = await fitPatchwork(samplerOf("+proj=utm +zone=32 +ellps=WGS84"), area);
    const steps: Step[] = [
      { kind: "projection", patchwork },
      { kind: "horizontalShift", direction: "forward", window },
      { kind: "geocentric", ellipsoid: WGS84 },
    ];
    const domain = { minX: 498e3, minY: 5090e3, minZ: 0, maxX: 500e3, maxY: 5092e3, maxZ: 50 };
    const compiled = compileTransformation({ steps });
    const stays = (x: number, y: number) => [x, y];
    const kept = worst(truthOnMap(compiled, own, 0, 1, "own"), domain, stays);
    expect(kept.off).toBeLessThanOrEqual(1e-4);
    // As any other plane it is where the shift puts it: some decimetres away.
    const other = worst(truthOnMap(compiled, { ...own, own: false }, 0, 1, "own"), domain, stays);
    expect(other.off).toBeGreaterThan(0.1);
    const { evaluate } = truthOnMap(compiled, { ...own, own: false }, 0, 1, "own") as StepwiseTruth;
    const out = new Float64Array(3);
    const certified = worst(truthOnMap(compiled, { ...own, own: false }, 0, 1, "own"), domain, (x, y) => {
      evaluate(x, y, 25, out, 0);
      return [...out];
    });
    expect(certified.off).toBeLessThanOrEqual(certified.bound);
    expect(certified.bound).toBeLessThanOrEqual(0.001);
  });

  it.each([
    // The same plane in other words, with a shift that one text does not name, and with another of the same code.
    [
      "EPSG:2994",
      "+proj=lcc +lat_0=41.75 +lon_0=-120.5 +lat_1=43 +lat_2=45.5 +x_0=400000 +ellps=GRS80 +units=ft",
      true,
    ],
    [
      "EPSG:21781",
      "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +x_0=600000 +y_0=200000 +ellps=bessel",
      true,
    ],
    ["EPSG:28992", "EPSG:28992", true],
    ["EPSG:3857", "EPSG:3857", true],
    ["EPSG:4326", "EPSG:4326", true],
    // Another unit, ellipsoid, projection or datum.
    [
      "EPSG:2994",
      "+proj=lcc +lat_0=41.75 +lon_0=-120.5 +lat_1=43 +lat_2=45.5 +x_0=400000 +ellps=GRS80 +units=m",
      false,
    ],
    ["EPSG:25832", "+proj=utm +zone=32 +datum=WGS84", false],
    ["EPSG:32632", "+proj=utm +zone=33 +datum=WGS84", false],
    ["EPSG:23032", "+proj=utm +zone=32 +ellps=intl +towgs84=-104.1,-49.1,-9.9,0,0,0,0", false],
    ["EPSG:4326", "EPSG:3857", false],
  ])("tells whether the plane of %s is that of %s", (source, map, own) => {
    const crs = resolveCrs({ file: source, given: source }, lookup);
    const definition = map.startsWith("+") ? map : resolveCrs({ file: map, given: map }, lookup).proj4;
    const [x, y] = crs.horizontalUnit.kind === "angular" ? [8, 47] : [6.2e5, 2.4e5];
    const rectangle = { minX: x, minY: y, maxX: x * 1.001, maxY: y * 1.001 };
    expect(isOwnPlane(crs, { code: map, definition }, rectangle)).toBe(own);
  });

  it("goes on beyond the edge of the world where the map does", () => {
    const out = new Float64Array(2);
    const degrees = (plane: MapPlane, longitude: number) => {
      planeTransform(plane)(longitude * DEGREE, 0.1, out, 0);
      return (out[0] / 6378137) * (1 / DEGREE);
    };
    const beyond = planeOf("EPSG:3857", 179.9, { wraps: true });
    expect(degrees(beyond, -179.9)).toBeCloseTo(180.1, 9);
    expect(degrees(beyond, 179.9)).toBeCloseTo(179.9, 9);
    expect(degrees({ ...beyond, wraps: false }, -179.9)).toBeCloseTo(-179.9, 9);
  });

  it("places a node across 180° in one piece, and in two where the map ends there", () => {
    // 2 km around the antimeridian, on the edge of UTM zones 60 and 1.
    const crs = resolveCrs({ file: "utm", given: "EPSG:32760" }, lookup);
    const out = new Float64Array(2);
    const utm = proj4(crs.proj4).forward([180, -17]);
    const domain = {
      minX: utm[0] - 1000,
      minY: utm[1] - 1000,
      minZ: 0,
      maxX: utm[0] + 1000,
      maxY: utm[1] + 1000,
      maxZ: 9,
    };
    const plane = planeOf("EPSG:3857", 179.995, { wraps: true });
    const truth = truthOnMap(exactTransform(crs, 5), plane, 5, 1, "utm");
    const placed = fitPlacement(truth, domain, 0.001, "node", levelFrame);
    expect([placed.scheme, placed.bound < 0.001]).toEqual(["quadratic", true]);
    const { off, bound } = worst(truth, domain, (x, y) => {
      const [longitude, latitude] = proj4(crs.proj4).inverse([x, y]);
      planeTransform(plane)(longitude * DEGREE, latitude * DEGREE, out, 0);
      return [...out];
    });
    expect(off).toBeLessThanOrEqual(bound);
    // Where the map does not go on, the far half would lie a world away: no scheme can hold that.
    const ends = truthOnMap(exactTransform(crs, 5), { ...plane, wraps: false }, 5, 1, "utm");
    expect(fitPlacement(ends, domain, 0.001, "node", levelFrame).scheme).toBe("exact");
  });

  it("has no place at the pole of Mercator's map, and refuses what is no projection", () => {
    const out = new Float64Array(2);
    planeTransform(planeOf("EPSG:3857", 0))(0, Math.PI / 2, out, 0);
    expect(out.some(Number.isFinite)).toBe(false);
    expect(() => planeTransform({ ...planeOf("EPSG:3857", 0), definition: "+proj=none" })).toThrow(
      /CRS_UNSUPPORTED: EPSG:3857/,
    );
  });

  it("has the plane of Web Mercator without proj4js where proj4js has it, on the turn of the middle", () => {
    const crs = resolveCrs({ file: "utm", given: "+proj=utm +zone=1 +south +ellps=WGS84 +units=m" });
    const plane: MapPlane = { ...WEB_MERCATOR_PLANE, middle: 179.995 * DEGREE, own: false };
    const exact = exactTransform(crs, 5);
    const own = pointTransform(truthOnWebMercator(exact, plane, 5, 1, "utm")!);
    const other = pointTransform(truthOnMap(exact, plane, 5, 1, "utm"));
    const [here, there] = [new Float64Array(3), new Float64Array(3)];
    for (const [x, y] of [
      [166_021, 8_000_000],
      [500_000, 5_000_000],
      [833_000, 1_200_000],
    ]) {
      own(x, y, 40, here, 0);
      other(x, y, 40, there, 0);
      expect([...there].every(Number.isFinite)).toBe(true);
      expect(Math.hypot(...here.map((value, axis) => value - there[axis]))).toBeLessThan(1e-7);
    }
    for (const foreign of [
      { ...plane, wraps: false },
      { ...plane, definition: "+proj=longlat" },
    ])
      expect(truthOnWebMercator(exact, foreign, 5, 1, "utm")).toBeUndefined();
  });
});
