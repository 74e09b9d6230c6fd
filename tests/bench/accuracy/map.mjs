import { fitPlacement, levelFrame, placeIntegers, truthOnMap } from "@groma/georef";
import proj4 from "proj4";
import { nodeOf, openCrs, sourceOf } from "./nodes.mjs";
import { nanoseconds } from "./timing.mjs";

/** Metres. */
export const TOLERANCE = 0.001;
/** The data set: UTM, 200 m high. */
const SOURCE = { code: "EPSG:32632", x: 600000, y: 5500000, height: 200 };
/** Projections of maps: their definitions, and metres per unit. */
const MAPS = [
  ["EPSG:3857", "EPSG:3857", 1, true],
  ["EPSG:4326", "EPSG:4326", (6378137 * Math.PI) / 180, true],
  ["EPSG:3035", "+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=GRS80 +units=m", 1, false],
  [
    "EPSG:31468",
    "+proj=tmerc +lat_0=0 +lon_0=12 +k=1 +x_0=4500000 +ellps=bessel +towgs84=598.1,73.7,418.2,0.202,0.045,-2.455,6.7 +units=m",
    1,
    false,
  ],
  ["EPSG:3413", "+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +k=1 +datum=WGS84 +units=m", 1, false],
];
const EDGES = [100, 1000, 10000];
/** Of one round; proj4js is a hundred times slower than the fits. */
const POINTS = 50000;
const ENGINE_POINTS = 4000;

export const GLOBE = "fit to the globe";
export const FIT = "fit to the map";
export const FORWARD = "proj4.forward";

/**
 * Placing by fit and by proj4js, per projection of the map and size of node: ns per point, and the greatest distance
 * (nominal metres of the map) from proj4js of points as the page stores them, float32 in the node's frame.
 */
export function measureMap() {
  const { crs, exact } = openCrs(SOURCE.code);
  return MAPS.flatMap(([code, definition, metresPerUnit, wraps]) =>
    EDGES.flatMap((edge) => {
      const node = nodeOf(SOURCE.x, SOURCE.y, edge, SOURCE.height, POINTS);
      const plane = { code, definition, metresPerUnit, wraps, middle: (10.4 * Math.PI) / 180, own: false };
      return measureNode(crs, exact, plane, node).map((row) => ({ map: code, edge, ...row }));
    }),
  );
}

function measureNode(crs, exact, plane, node) {
  const truth = truthOnMap(exact, plane, SOURCE.height / 2, 1, plane.code);
  const onMap = fitPlacement(truth, node.domain, TOLERANCE, plane.code, levelFrame);
  const onGlobe = fitPlacement(exact, node.domain, TOLERANCE);
  const forward = proj4(crs.proj4, plane.definition).forward;
  const out = new Float32Array(3 * POINTS);
  const byFit = (placement) => () => placeIntegers(placement, node.xyz, POINTS, node.scale, node.offset, out);
  const { xyz, scale, offset } = node;
  const { origin } = onMap.frame;
  const engine = () => {
    for (let i = 0; i < ENGINE_POINTS; i++) {
      const [x, y] = forward([xyz[3 * i] * scale[0] + offset[0], xyz[3 * i + 1] * scale[1] + offset[1]]);
      out[3 * i] = x * plane.metresPerUnit - origin[0];
      out[3 * i + 1] = y * plane.metresPerUnit - origin[1];
      out[3 * i + 2] = xyz[3 * i + 2] * scale[2] + offset[2] - origin[2];
    }
  };
  const tasks = [
    { task: byFit(onGlobe), items: POINTS },
    { task: byFit(onMap), items: POINTS },
    { task: engine, items: ENGINE_POINTS },
  ];
  const times = nanoseconds(tasks);
  /** Of what a task has stored. */
  const error = (task) => {
    task();
    let greatest = 0;
    for (let i = 0; i < ENGINE_POINTS; i++) {
      const [x, y] = forward(sourceOf(node, i).slice(0, 2));
      const away = Math.hypot(
        origin[0] + out[3 * i] - x * plane.metresPerUnit,
        origin[1] + out[3 * i + 1] - y * plane.metresPerUnit,
      );
      greatest = Math.max(greatest, away);
    }
    return greatest;
  };
  return [
    { method: GLOBE, scheme: onGlobe.scheme, ns: times[0], bound: onGlobe.bound },
    { method: FIT, scheme: onMap.scheme, ns: times[1], bound: onMap.bound, error: error(tasks[1].task) },
    { method: FORWARD, ns: times[2], error: error(tasks[2].task) },
  ];
}
