// Placing: ns per point of every scheme against proj4js, in one run. `node tests/bench/placing.bench.mjs`.
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";
import { exactTransform, fitPlacement, placeIntegers, resolveCrs } from "@groma/georef";
import proj4 from "proj4";

const POINTS = 50000;
const ROUNDS = 7;

/** CRS, node centre, and a tolerance and edge (metres) for which each scheme is the cheapest. */
const PLACES = [
  ["EPSG:32633", 500000, 5000000],
  ["EPSG:2056", 2683000, 1247000],
  ["EPSG:28992", 155000, 463000],
  ["EPSG:3857", 1000000, 6000000],
];
const NODES = [
  [10, 0.001],
  [100, 0.001],
  [1000, 0.001],
  [1000, 0.1],
  [10000, 0.001],
  [30000, 0.003],
  [100000, 0.005],
  [400000, 0.03],
];

/** Best of several rounds, nanoseconds per point. */
function time(task) {
  let best = Number.POSITIVE_INFINITY;
  for (let round = 0; round < ROUNDS; round++) {
    const began = process.hrtime.bigint();
    task();
    best = Math.min(best, Number(process.hrtime.bigint() - began) / POINTS);
  }
  return best;
}

function node(x, y, edge) {
  const domain = {
    minX: x - edge / 2,
    maxX: x + edge / 2,
    minY: y - edge / 2,
    maxY: y + edge / 2,
    minZ: 0,
    maxZ: 200,
  };
  const offset = [x, y, 0];
  const scale = [edge * 2 ** -30, edge * 2 ** -30, 1e-7];
  const xyz = new Int32Array(3 * POINTS);
  let state = 1;
  for (let i = 0; i < xyz.length; i++) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    xyz[i] = i % 3 === 2 ? state >>> 2 : (state >>> 2) - 2 ** 29;
  }
  return { domain, offset, scale, xyz };
}

/** Rows of scheme, CRS, node, ns per point, and how many times faster than proj4js's forward to longitude and latitude. */
export async function bench() {
  const epsg = createRequire(import.meta.url)("epsg-index/all.json");
  const rows = [];
  for (const [given, x, y] of PLACES) {
    const crs = resolveCrs({ file: given, given }, (code) => epsg[code]);
    const exact = exactTransform(crs);
    const toWgs84 = proj4(crs.proj4, "WGS84");
    for (const [edge, tolerance] of NODES) {
      const { domain, offset, scale, xyz } = node(x, y, edge);
      const placement = fitPlacement(exact, domain, tolerance);
      const out = new Float32Array(3 * POINTS);
      const fitted = time(() => placeIntegers(placement, xyz, POINTS, scale, offset, out));
      const parts = new Float64Array(6);
      const own = time(() => {
        for (let i = 0; i < xyz.length; i += 3) {
          exact(xyz[i] * scale[0] + offset[0], xyz[i + 1] * scale[1] + offset[1], parts, 0);
          const z = xyz[i + 2] * scale[2];
          for (let axis = 0; axis < 3; axis++) out[i + axis] = parts[axis] + z * parts[axis + 3];
        }
      });
      const library = time(() => {
        for (let i = 0; i < xyz.length; i += 3) {
          const source = [
            xyz[i] * scale[0] + offset[0],
            xyz[i + 1] * scale[1] + offset[1],
            xyz[i + 2] * scale[2],
          ];
          const [lon, lat, h] = toWgs84.forward(source);
          out[i] = lon;
          out[i + 1] = lat;
          out[i + 2] = h;
        }
      });
      const fit = time(() => fitPlacement(exact, domain, tolerance)) * POINTS;
      rows.push({
        scheme: placement.scheme,
        crs: crs.code,
        edge: `${edge} m`,
        bound: `${(placement.bound * 1000).toPrecision(2)} mm`,
        "ns/point": Number(fitted.toFixed(1)),
        "exact ns": Math.round(own),
        "proj4 ns": Math.round(library),
        "× proj4": Math.round(library / fitted),
        "fit µs": Math.round(fit / 1000),
      });
    }
  }
  return rows;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) console.table(await bench());
