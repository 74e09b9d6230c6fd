import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import {
  chordPolygon,
  geodesicBetween,
  geodesicFrom,
  geodesicPolygon,
  geodeticToEcef,
  planarArea,
} from "@groma/georef";
import proj4 from "proj4";
import { surfaceArea } from "./surface-area.mjs";
import { nanoseconds, random } from "./timing.mjs";

export const GEOGRAPHICLIB = "geographiclib";
export const POLYGON = "geodesicPolygon";
export const HAVERSINE = "haversine";
export const CHORD = "ECEF chord";
export const UTM = "planar UTM";

/** The library as georef has it. */
const geographiclib = createRequire(import.meta.resolve("@groma/georef"))("geographiclib-geodesic").Geodesic
  .WGS84;

const DEGREE = Math.PI / 180;
/** Mean radius of the earth (IUGG), metres. */
const RADIUS = 6371008.8;
const LENGTHS = [100, 1e3, 1e4, 1e5, 1e6];
const LINES = 500;
const SIZES = [10, 100, 1e3, 1e4, 1e5];
const VERTICES = 24;
/** Degrees: on the equator, in between, at the antimeridian, around a pole. */
const PLACES = [
  [0, 0],
  [10, 20],
  [-70, 45],
  [179.9999, 52],
  [30, -65],
  [100, 89.9999],
];

const name = (metres) => (metres < 1000 ? `${metres} m` : `${metres / 1000} km`);

/** UTM of the zone of a place (radians). */
function utmAt(longitude, latitude) {
  const zone = (Math.floor((longitude / DEGREE + 180) / 6) % 60) + 1;
  return proj4("WGS84", `+proj=utm +zone=${zone}${latitude < 0 ? " +south" : ""} +datum=WGS84`);
}

const a = new Float64Array(3);
const b = new Float64Array(3);

/** Distances between two places in radians; planar ones in the UTM zone of the first, given to them. */
const DISTANCES = {
  [GEOGRAPHICLIB]: (lon1, lat1, lon2, lat2) => geodesicBetween(lon1, lat1, lon2, lat2).distance,
  [HAVERSINE]: (lon1, lat1, lon2, lat2) => {
    const s = Math.sin((lat2 - lat1) / 2) ** 2;
    const t = Math.cos(lat1) * Math.cos(lat2) * Math.sin((lon2 - lon1) / 2) ** 2;
    return 2 * RADIUS * Math.asin(Math.min(1, Math.sqrt(s + t)));
  },
  [CHORD]: (lon1, lat1, lon2, lat2) => {
    geodeticToEcef(lon1, lat1, 0, a);
    geodeticToEcef(lon2, lat2, 0, b);
    return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  },
  [UTM]: (lon1, lat1, lon2, lat2, utm) => {
    const [x1, y1] = utm.forward([lon1 / DEGREE, lat1 / DEGREE]);
    const [x2, y2] = utm.forward([lon2 / DEGREE, lat2 / DEGREE]);
    return Math.hypot(x2 - x1, y2 - y1);
  },
};

/** Areas of a ring in radians, vertices counted once. */
const AREAS = {
  [POLYGON]: (ring) => geodesicPolygon(ring).area,
  [GEOGRAPHICLIB]: (ring) => {
    const polygon = geographiclib.Polygon();
    for (let i = 0; i < ring.length; i += 2) polygon.AddPoint(ring[i + 1] / DEGREE, ring[i] / DEGREE);
    return polygon.Compute(false, true).area;
  },
  [CHORD]: (ring) => chordPolygon(ring).area,
  [UTM]: (ring, utm) => {
    const plane = new Float64Array(ring.length);
    for (let i = 0; i < ring.length; i += 2) {
      plane.set(utm.forward([ring[i] / DEGREE, ring[i + 1] / DEGREE]), i);
    }
    return planarArea(plane);
  },
};

/** Rows of distances and areas; errors in metres and square metres. */
export function measureGeodesic(root) {
  return [
    ...LENGTHS.flatMap((length) => lines(name(length), localLines(length))),
    ...global(root),
    ...areas(),
  ];
}

function lines(panel, list) {
  const methods = Object.entries(DISTANCES).filter(
    ([method]) => method !== UTM || list.every(({ utm }) => utm),
  );
  const times = nanoseconds(
    methods.map(([, distance]) => ({
      task: () => {
        for (const { from, to, utm } of list) distance(...from, ...to, utm);
      },
      items: list.length,
    })),
  );
  return methods.map(([method, distance], i) => ({
    panel: `distance, ${panel}`,
    method,
    ns: times[i],
    error: Math.max(
      ...list.map(({ from, to, utm, length }) => Math.abs(distance(...from, ...to, utm) - length)),
    ),
    chosen: method === GEOGRAPHICLIB,
  }));
}

/** Lines of one length, from anywhere up to 75° of latitude. */
function localLines(length) {
  const next = random(length);
  return Array.from({ length: LINES }, () => {
    const from = [(2 * next() - 1) * Math.PI, (150 * next() - 75) * DEGREE];
    const end = geodesicFrom(...from, 2 * Math.PI * next(), length);
    return { from, to: [end.longitude, end.latitude], length, utm: utmAt(...from) };
  });
}

/** Karney's test set: lines of any length, many of them near-antipodal. */
function global(root) {
  const path = join(root, "../shared/data/truth/geodtest.dat");
  if (!existsSync(path)) return [];
  const rows = readFileSync(path, "utf8").trim().split("\n");
  const list = rows.map((line) => {
    const [lat1, lon1, , lat2, lon2, , length] = line.split(" ").map(Number);
    return { from: [lon1 * DEGREE, lat1 * DEGREE], to: [lon2 * DEGREE, lat2 * DEGREE], length };
  });
  return lines("GeodTest", list);
}

function areas() {
  return SIZES.flatMap((size) =>
    PLACES.flatMap(([lon, lat]) => {
      const centre = [lon * DEGREE, lat * DEGREE];
      const ring = star(centre, size / 2);
      const truth = surfaceArea(centre, ring);
      const utm = utmAt(...centre);
      const methods = Object.entries(AREAS).filter(([method]) => method !== UTM || lat < 84);
      const times = nanoseconds(
        methods.map(([, area]) => ({
          task: () => {
            for (let i = 0; i < 20; i++) area(ring, utm);
          },
          items: 20 * VERTICES,
        })),
      );
      return methods.map(([method, area], i) => ({
        panel: `area, ${name(size)}`,
        place: `${lon}, ${lat}`,
        method,
        ns: times[i],
        error: Math.abs(area(ring, utm) - truth),
        chosen: method === POLYGON,
      }));
    }),
  );
}

/** A star-shaped ring, counter-clockwise. */
function star([longitude, latitude], radius) {
  return Float64Array.from(
    Array.from({ length: VERTICES }, (_, i) => {
      const azimuth = (-2 * Math.PI * i) / VERTICES;
      const end = geodesicFrom(longitude, latitude, azimuth, radius * (1 + 0.3 * Math.cos(3 * azimuth + 1)));
      return [end.longitude, end.latitude];
    }).flat(),
  );
}
