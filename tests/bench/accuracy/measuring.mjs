import { geodesicBetween, geodesicFrom, geodeticToEcef, planarArea } from "@groma/georef";
import { cutAndFill, measureArea, measureDistance, placeVertex } from "@groma/layer/tools";
import proj4 from "proj4";
import { surfaceArea } from "./surface-area.mjs";
import { nanoseconds, random } from "./timing.mjs";

export const WHOLE = "measureDistance, measureArea";
export const GEODESIC = "geodesic alone";
export const SPHERE = "sphere";
export const PLANAR = "chord, plane";
export const GRID = "grid (UTM)";
export const PRISMS = "cutAndFill";
export const RASTER = "raster of means";
export const LOWEST = "raster of lowest";

const DEGREE = Math.PI / 180;
/** Mean radius of the earth (IUGG), metres. */
const RADIUS = 6371008.8;
const LATITUDES = [0, 30, 60, 80];
const LENGTHS = [10, 1e3, 1e5];
const LINES = 60;

/** UTM of the zone of a place in degrees. */
function utmAt(longitude, latitude) {
  const zone = Math.floor((longitude + 180) / 6) + 1;
  return proj4("WGS84", `+proj=utm +zone=${zone}${latitude < 0 ? " +south" : ""} +datum=WGS84`);
}

const a = new Float64Array(3);
const b = new Float64Array(3);

const DISTANCES = {
  // Every distance of two points, and what each is worth.
  [WHOLE]: ({ from, to }) => measureDistance(from, to).geodesic.value,
  [GEODESIC]: ({ from, to }) =>
    geodesicBetween(from.longitude, from.latitude, to.longitude, to.latitude).distance,
  [SPHERE]: ({ from, to }) => {
    const s = Math.sin((to.latitude - from.latitude) / 2) ** 2;
    const t = Math.cos(from.latitude) * Math.cos(to.latitude);
    return 2 * RADIUS * Math.asin(Math.sqrt(s + t * Math.sin((to.longitude - from.longitude) / 2) ** 2));
  },
  [PLANAR]: ({ from, to }) => {
    geodeticToEcef(from.longitude, from.latitude, 0, a);
    geodeticToEcef(to.longitude, to.latitude, 0, b);
    return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  },
  [GRID]: ({ from, to, utm }) => {
    const [x1, y1] = utm.forward([from.longitude / DEGREE, from.latitude / DEGREE]);
    const [x2, y2] = utm.forward([to.longitude / DEGREE, to.latitude / DEGREE]);
    return Math.hypot(x2 - x1, y2 - y1);
  },
};

const AREAS = {
  [WHOLE]: ({ ring }) => measureArea(ring).geodesic.value,
  [SPHERE]: ({ ring }) => {
    // Chamberlain and Duquette, "Some algorithms for polygons on a sphere" (2007).
    let sum = 0;
    for (let i = 0; i < ring.length; i++) {
      const [one, next] = [ring[i], ring[(i + 1) % ring.length]];
      const across = next.longitude - one.longitude;
      sum += across * (2 + Math.sin(one.latitude) + Math.sin(next.latitude));
    }
    return Math.abs((sum * RADIUS ** 2) / 2);
  },
  [PLANAR]: ({ ring }) => measureArea(ring).planar.value,
  [GRID]: ({ ring, utm }) =>
    Math.abs(
      planarArea(
        ring.flatMap(({ longitude, latitude }) => utm.forward([longitude / DEGREE, latitude / DEGREE])),
      ),
    ),
};

/** Relative errors and nanoseconds a value. */
export function measureFigures() {
  return LATITUDES.flatMap((latitude) =>
    LENGTHS.flatMap((length) => [...distances(latitude, length), ...areas(latitude, length)]),
  );
}

function distances(latitude, length) {
  const next = random(length + latitude);
  const list = Array.from({ length: LINES }, () => {
    const at = [(6 * next() + 9) * DEGREE, latitude * DEGREE];
    const end = geodesicFrom(...at, 2 * Math.PI * next(), length);
    const utm = utmAt(at[0] / DEGREE, latitude);
    return {
      from: placeVertex(...at, 0),
      to: placeVertex(end.longitude, end.latitude, 0),
      utm,
      truth: length,
    };
  });
  return rows(`distance, ${latitude}°`, `${length} m`, DISTANCES, list);
}

function areas(latitude, size) {
  const centre = [10 * DEGREE, latitude * DEGREE];
  const corners = Array.from({ length: 6 }, (_, i) => {
    const end = geodesicFrom(...centre, (-2 * Math.PI * i) / 6, size / 2);
    return [end.longitude, end.latitude];
  });
  const ring = corners.map(([longitude, lat]) => placeVertex(longitude, lat, 0));
  const one = {
    ring,
    utm: utmAt(10, latitude),
    truth: surfaceArea(centre, Float64Array.from(corners.flat())),
  };
  return rows(`area, ${latitude}°`, `${size} m`, AREAS, [one]);
}

function rows(panel, place, methods, list) {
  const entries = Object.entries(methods);
  const times = nanoseconds(
    entries.map(([, of]) => ({ task: () => list.forEach((one) => void of(one)), items: list.length })),
  );
  return entries.map(([method, of], i) => ({
    ...{ panel, place, method, ns: times[i] },
    error: Math.max(...list.map((one) => Math.abs(of(one) / one.truth - 1))),
    chosen: method === WHOLE,
  }));
}

const SOLIDS = {
  cone: [(x, y) => Math.max(0, 10 - Math.hypot(x, y)), (Math.PI * 1000) / 3],
  "half ball": [(x, y) => Math.sqrt(Math.max(0, 100 - x * x - y * y)), (2 * Math.PI * 1000) / 3],
  bell: [(x, y) => 10 * Math.exp(-(x * x + y * y) / 8), 80 * Math.PI],
};
const SPACINGS = [2, 1, 0.5, 0.25, 0.1];
const HALF = 12;

/** Relative errors of volumes and nanoseconds a point. */
export function measureVolumes() {
  return SPACINGS.flatMap((spacing) =>
    Object.entries(SOLIDS).flatMap(([solid, [height, truth]]) => {
      const points = shaken(spacing, height);
      const items = points.length / 3;
      const ring = Float64Array.of(-HALF, -HALF, 0, HALF, -HALF, 0, HALF, HALF, 0, -HALF, HALF, 0);
      const methods = [
        [PRISMS, () => cutAndFill(points, ring, { kind: "height", height: 0 }).cut],
        [RASTER, () => raster(points, 2 * spacing, (cell) => cell.sum / cell.count)],
        [LOWEST, () => raster(points, 2 * spacing, (cell) => cell.least)],
      ];
      const times = nanoseconds(methods.map(([, task]) => ({ task, items })));
      return methods.map(([method, of], i) => ({
        ...{ panel: `volume, points every ${spacing} m`, place: solid, method, ns: times[i] },
        error: Math.abs(of() / truth - 1),
        chosen: method === PRISMS,
      }));
    }),
  );
}

/** Points of a surface, on a grid shaken by 40 % of its spacing. */
function shaken(spacing, height) {
  const next = random(spacing * 1000);
  const points = [];
  for (let x = -HALF - 2 * spacing; x <= HALF + 2 * spacing; x += spacing) {
    for (let y = -HALF - 2 * spacing; y <= HALF + 2 * spacing; y += spacing) {
      const [px, py] = [x + 0.4 * spacing * (next() - 0.5), y + 0.4 * spacing * (next() - 0.5)];
      points.push(px, py, height(px, py));
    }
  }
  return Float64Array.from(points);
}

/** Sum over cells in the square, each of one height. */
function raster(points, size, heightOf) {
  const across = Math.round((2 * HALF) / size);
  const cell = (2 * HALF) / across;
  const cells = Array.from({ length: across * across }, () => ({ sum: 0, count: 0, least: Infinity }));
  for (let i = 0; i < points.length; i += 3) {
    const [column, row] = [Math.floor((points[i] + HALF) / cell), Math.floor((points[i + 1] + HALF) / cell)];
    if (column < 0 || row < 0 || column >= across || row >= across) continue;
    const one = cells[row * across + column];
    one.sum += points[i + 2];
    one.count++;
    one.least = Math.min(one.least, points[i + 2]);
  }
  return cells.reduce((sum, one) => sum + (one.count > 0 ? heightOf(one) * cell * cell : 0), 0);
}
