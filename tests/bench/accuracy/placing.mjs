import { fitPlacement, geodeticToEcef, place, placeIntegers } from "@groma/georef";
import proj4 from "proj4";
import { nodeOf, offBy, openCrs, sourceOf, store } from "./nodes.mjs";
import { nanoseconds } from "./timing.mjs";

/** Metres. */
export const TOLERANCE = 0.001;

/** CRS and node centre, source units: series, closed form, Newton and datum shifts, feet, a sphere. */
const PLACES = [
  ["EPSG:32633", 600000, 5500000],
  ["EPSG:2056", 2683000, 1247000],
  ["EPSG:28992", 155000, 463000],
  ["EPSG:2994", 1312000, 900000],
  ["EPSG:3857", 1000000, 6000000],
];
const EDGES = [100, 1000, 10000, 100000];
/** Metres. */
const HEIGHT = 200;
const DEGREE = Math.PI / 180;
/** Of one round; the engines are a hundred times slower than the schemes. */
const POINTS = 50000;
const ENGINE_POINTS = 4000;

export const SCHEMES = ["affine", "affineLinearNormal", "quadratic", "cubic", "quartic", "tensor6"];
export const EXACT = "exact";
export const FORWARD = "proj4.forward";

/** Placements of one domain by scheme: each bound, just undercut, calls for the next scheme. */
export function ladder(exact, domain) {
  const found = new Map();
  for (let tolerance = 1e9; ; ) {
    const placement = fitPlacement(exact, domain, tolerance);
    if (placement.scheme === "exact") return [...found.values()];
    found.set(placement.scheme, placement);
    tolerance = Math.min(tolerance, placement.bound) * (1 - 1e-9);
  }
}

/**
 * Every scheme and engine at every CRS and node size: ns per point, and the greatest distance (metres) from the exact
 * transform of points as the page stores them, float32 in the node frame.
 */
export function measurePlacing() {
  return PLACES.flatMap(([given, x, y]) => {
    const { crs, exact } = openCrs(given);
    const unit = crs.horizontalUnit.size;
    return EDGES.flatMap((edge) => {
      const node = nodeOf(x, y, edge / unit, HEIGHT / crs.verticalUnit.size, POINTS);
      return measureNode(crs, exact, node).map((row) => ({ crs: given, edge, ...row }));
    });
  });
}

function measureNode(crs, exact, node) {
  const placements = ladder(exact, node.domain);
  const chosen = fitPlacement(exact, node.domain, TOLERANCE);
  const { frame } = placements[0];
  const out = new Float32Array(3 * POINTS);
  const engines = [
    [EXACT, exactTask(exact, node, frame, out)],
    [FORWARD, forwardTask(crs, node, frame, out)],
  ];
  const tasks = [
    ...placements.map((placement) => ({
      task: () => placeIntegers(placement, node.xyz, POINTS, node.scale, node.offset, out),
      items: POINTS,
    })),
    ...engines.map(([, task]) => ({ task, items: ENGINE_POINTS })),
  ];
  const times = nanoseconds(tasks);
  const rows = tasks.map(({ task, items }, i) => {
    task();
    const placement = placements[i];
    return {
      method: placement?.scheme ?? engines[i - placements.length][0],
      ns: times[i],
      error: worst(exact, node, Math.min(items, ENGINE_POINTS), (point, ecef) =>
        offBy(frame, out, point, ecef),
      ),
      ...(placement
        ? {
            fitError: fitError(exact, node, placement),
            fitBound: placement.fitBound,
            bound: placement.bound,
          }
        : {}),
      chosen: placement?.scheme === chosen.scheme,
    };
  });
  return rows;
}

/** proj4js's inverse projection, then ECEF in this project's own arithmetic. */
function exactTask(exact, { xyz, scale, offset }, frame, out) {
  const parts = new Float64Array(6);
  const ecef = new Float64Array(3);
  return () => {
    for (let i = 0; i < ENGINE_POINTS; i++) {
      const z = xyz[3 * i + 2] * scale[2] + offset[2];
      exact(xyz[3 * i] * scale[0] + offset[0], xyz[3 * i + 1] * scale[1] + offset[1], parts, 0);
      for (let axis = 0; axis < 3; axis++) ecef[axis] = parts[axis] + z * parts[axis + 3];
      store(frame, ecef, out, i);
    }
  };
}

/** proj4js to longitude, latitude and the height as it is, then ECEF: what a page without this project does. */
function forwardTask(crs, { xyz, scale, offset }, frame, out) {
  const toWgs84 = proj4(crs.proj4, "WGS84");
  const metres = crs.verticalUnit.size;
  const ecef = new Float64Array(3);
  return () => {
    for (let i = 0; i < ENGINE_POINTS; i++) {
      const [longitude, latitude, height] = toWgs84.forward([
        xyz[3 * i] * scale[0] + offset[0],
        xyz[3 * i + 1] * scale[1] + offset[1],
        (xyz[3 * i + 2] * scale[2] + offset[2]) * metres,
      ]);
      geodeticToEcef(longitude * DEGREE, latitude * DEGREE, height, ecef);
      store(frame, ecef, out, i);
    }
  };
}

function fitError(exact, node, placement) {
  const got = new Float64Array(3);
  return worst(exact, node, ENGINE_POINTS, (i, ecef) => {
    place(placement, ...sourceOf(node, i), got);
    return Math.hypot(got[0] - ecef[0], got[1] - ecef[1], got[2] - ecef[2]);
  });
}

function worst(exact, node, count, distance) {
  const parts = new Float64Array(6);
  const ecef = new Float64Array(3);
  let greatest = 0;
  for (let i = 0; i < count; i++) {
    const [x, y, z] = sourceOf(node, i);
    exact(x, y, parts, 0);
    for (let axis = 0; axis < 3; axis++) ecef[axis] = parts[axis] + z * parts[axis + 3];
    greatest = Math.max(greatest, distance(i, ecef));
  }
  return greatest;
}
