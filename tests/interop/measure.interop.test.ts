import {
  MeasureError,
  measureArea,
  measureDirection,
  measureDistance,
  placeVertex,
  sourceVertex,
  type Vertex,
} from "@groma/layer/tools";
import { describe, expect, it } from "vitest";
import { random } from "../../georef/src/cartesian/points.fixture.js";
import { cloudOf, type FixtureCloud } from "../../layer/src/tools/measure/cloud.fixture.js";
import { pythonMissing, runPython } from "../python.js";

const DEGREE = Math.PI / 180;
const next = random(14);
const between = (least: number, greatest: number) => least + (greatest - least) * next();

type Ring = readonly (readonly [number, number])[];

interface Referee {
  readonly lines: [distance: number, forward: number, back: number][];
  readonly rings: [area: number, perimeter: number][];
  readonly grids: {
    readonly lines: [geodesic: number, scale: number, convergence: number][];
    readonly rings: [area: number, simple: boolean][];
  }[];
}

const GRIDS: readonly [proj4: string, x: number, y: number][] = [
  ["+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m", 620000, 5300000],
  [
    "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +k_0=1 +x_0=2600000 +y_0=1200000 +ellps=bessel +towgs84=674.374,15.056,405.346,0,0,0,0 +units=m",
    2700000,
    1150000,
  ],
  [
    "+proj=lcc +lat_1=43 +lat_2=45.5 +lat_0=41.75 +lon_0=-120.5 +x_0=400000 +y_0=0 +ellps=GRS80 +towgs84=0,0,0,0,0,0,0 +units=m",
    194000,
    264000,
  ],
];

/** Lines of 1 mm to 20,000 km, from anywhere. */
function globalLine(): [number, number, number, number] {
  const [lon, lat] = [between(-180, 180), Math.asin(between(-1, 1)) / DEGREE];
  if (next() < 0.3) return [lon, lat, between(-180, 180), Math.asin(between(-1, 1)) / DEGREE];
  const reach = 10 ** between(-8, 2);
  const to = Math.max(-90, Math.min(90, lat + reach * between(-1, 1)));
  return [lon, lat, lon + reach * between(-1, 1), to];
}

/** A ring around a middle, vertex by vertex; one that crosses itself where its vertices are out of order. */
function ringAround(x: number, y: number, size: number, mixed: boolean): [number, number][] {
  const count = 3 + Math.floor(8 * next());
  const vertices = Array.from({ length: count }, (_, i): [number, number] => {
    const [angle, radius] = [(2 * Math.PI * i) / count, size * between(0.3, 1)];
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
  return mixed ? vertices.sort(() => next() - 0.5) : vertices;
}

const lines = Array.from({ length: 6000 }, globalLine);
const rings = Array.from({ length: 1000 }, () =>
  ringAround(between(-180, 180), between(-80, 80), 10 ** between(-4, 0.7), false),
);
const grids = GRIDS.map(([proj4, x, y]) => ({
  proj4,
  lines: Array.from({ length: 500 }, (): [number, number, number, number] => {
    const [x1, y1, size] = [x + between(-5e4, 5e4), y + between(-5e4, 5e4), 10 ** between(1, 4)];
    return [x1, y1, x1 + size * between(-1, 1), y1 + size * between(-1, 1)];
  }),
  rings: Array.from({ length: 500 }, () =>
    ringAround(x + between(-5e4, 5e4), y + between(-5e4, 5e4), 10 ** between(0, 4), next() < 0.5),
  ),
}));

const title = `measured values${pythonMissing ? ` (${pythonMissing})` : ""}`;

describe.skipIf(pythonMissing)(`${title} are those of pyproj and shapely`, { timeout: 120_000 }, () => {
  const referee = () =>
    runPython<Referee>("interop/measured.py", [], JSON.stringify({ lines, rings, grids }));
  let asked: Referee | undefined;
  const wanted = () => {
    asked ??= referee();
    return asked;
  };
  const onGround = (ring: Ring) => ring.map(([lon, lat]) => placeVertex(lon * DEGREE, lat * DEGREE, 0));

  it("along 6,000 geodesics", () => {
    for (const [i, [lon1, lat1, lon2, lat2]] of lines.entries()) {
      const [a, b] = onGround([
        [lon1, lat1],
        [lon2, lat2],
      ]);
      const [distance, forward] = wanted().lines[i];
      expect(Math.abs(measureDistance(a, b).geodesic.value - distance)).toBeLessThan(3e-8);
      const azimuth = measureDirection(a, b).forward?.value ?? 0;
      const off = Math.abs(Math.sin((azimuth - forward * DEGREE) / 2));
      // Rounding of a place (1 nm) turns short lines, and any direction will do near the antipodes.
      const reduced = Math.abs(Math.sin(distance / 6.37e6)) * 6.37e6;
      expect(off * Math.min(distance, reduced)).toBeLessThan(1e-7);
    }
  });

  it("around 1,000 polygons", () => {
    for (const [i, ring] of rings.entries()) {
      const { geodesic, perimeter } = measureArea(onGround(ring));
      const [area, around] = wanted().rings[i];
      // Sums down to the equator leave the referee some square centimetres.
      expect(Math.abs(geodesic.value - area)).toBeLessThan(0.1 + 1e-9 * area);
      expect(Math.abs(perimeter.geodesic.value - around)).toBeLessThan(1e-6);
    }
  });

  it.each(GRIDS.map(([proj4], at) => [proj4.split(" ")[0], at] as const))("in the grid of %s", (_, at) => {
    const { proj4, lines: inGrid, rings: ringsInGrid } = grids[at];
    const cloud: FixtureCloud = cloudOf(proj4);
    const vertex = (x: number, y: number): Vertex => sourceVertex(cloud, [x, y, 0]);
    for (const [i, [x1, y1, x2, y2]] of inGrid.entries()) {
      const [a, b] = [vertex(x1, y1), vertex(x2, y2)];
      const [geodesic, , convergence] = wanted().grids[at].lines[i];
      const length = Math.hypot(x2 - x1, y2 - y1);
      const { grid } = measureDistance(a, b);
      expect(Math.abs(grid!.distance.value - length)).toBeLessThan(1e-9);
      if (length > 10) expect(Math.abs(length / grid!.scaleFactor - geodesic)).toBeLessThan(2e-7);
      // The scale of the first metres is PROJ's scale at the point.
      const near = measureDistance(a, vertex(x1 + 1, y1)).grid!;
      expect(Math.abs(near.scaleFactor - wanted().grids[at].lines[i][1])).toBeLessThan(1e-8);
      const bearing = measureDirection(a, b).grid!;
      expect(Math.abs(Math.sin(Math.abs(bearing.convergence) - Math.abs(convergence * DEGREE)))).toBeLessThan(
        1e-8,
      );
    }
    let crossed = 0;
    for (const [i, ring] of ringsInGrid.entries()) {
      const [area, simple] = wanted().grids[at].rings[i];
      const measure = () => measureArea(ring.map(([x, y]) => vertex(x, y)));
      if (simple) {
        expect(Math.abs(measure().grid!.area.value - area)).toBeLessThan(1e-7 + 1e-12 * area);
        continue;
      }
      crossed++;
      expect(measure).toThrow(MeasureError);
    }
    expect(crossed).toBeGreaterThan(50);
  });
});
