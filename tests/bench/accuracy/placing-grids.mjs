import { compileTransformation, fitPlacement, geodeticToEcef, placeIntegers } from "@groma/georef";
import proj4 from "proj4";
import { around, egm96Package, numerics, truthRows } from "./grids.mjs";
import { nodeOf, offBy, openCrs } from "./nodes.mjs";
import { FORWARD, TOLERANCE } from "./placing.mjs";
import { nanoseconds } from "./timing.mjs";

const NAME = "EPSG:7415";
const EDGE = 1000;
const HEIGHT = 200;
const DEGREE = Math.PI / 180;
/** Of the rows, those that a node of its own is fitted around. */
const NODES = 150;
const POINTS = 50000;

export const FALLBACK = "proj4.forward + EGM96";
export const EVALUATE = "transformation";
/** Nodes that no single function is near enough to, because they lie across lines of a grid. */
export const REMAINDER = "fit + grid remainder";

/**
 * RD New with heights above NAP against PROJ with its grids: proj4js as it is, with the geoid EGM96, the transformation
 * of the georeference record, and nodes fitted to it.
 *
 * @returns {Promise<object[] | undefined>} undefined where the grids or the truth are not there
 */
export async function measureWithGrids(root) {
  const { missingFor, PIPELINES, pipeline } = await numerics(root);
  if (missingFor(NAME)) return undefined;
  const rows = truthRows(root, PIPELINES[NAME].truth);
  const compiled = compileTransformation(await pipeline(NAME, around(rows)), NAME);
  return [...measureEngines(root, compiled, rows), ...measureNodes(compiled, rows)].map((row) => ({
    crs: NAME,
    edge: EDGE,
    ...row,
  }));
}

function measureEngines(root, compiled, rows) {
  const { crs } = openCrs("EPSG:28992");
  const { forward } = proj4(crs.proj4, "WGS84");
  const undulation = egm96Package(root);
  const ecef = new Float64Array(3);
  const throughDegrees = (height) => (x, y, z) => {
    const [longitude, latitude] = forward([x, y, z]);
    geodeticToEcef(longitude * DEGREE, latitude * DEGREE, height(longitude, latitude, z), ecef);
  };
  const engines = [
    [FORWARD, throughDegrees((_longitude, _latitude, z) => z)],
    [FALLBACK, throughDegrees((longitude, latitude, z) => z + undulation(latitude, longitude))],
    [EVALUATE, (x, y, z) => compiled.evaluate(x, y, z, ecef, 0)],
  ];
  const times = nanoseconds(
    engines.map(([, place]) => ({
      task: () => {
        for (const [x, y, z] of rows) place(x, y, z);
      },
      items: rows.length,
    })),
  );
  return engines.map(([method, place], i) => {
    let error = 0;
    for (const [x, y, z, ...truth] of rows) {
      place(x, y, z);
      error = Math.max(error, Math.hypot(...truth.map((value, axis) => ecef[axis] - value)));
    }
    return { method, ns: times[i], error, chosen: false };
  });
}

function measureNodes(compiled, rows) {
  const step = Math.max(1, Math.floor(rows.length / NODES));
  const local = new Float32Array(3);
  const fitted = rows
    .filter((_, i) => i % step === 0)
    .map(([x, y, z, ...truth]) => {
      const plane = { minX: x - EDGE / 2, maxX: x + EDGE / 2, minY: y - EDGE / 2, maxY: y + EDGE / 2 };
      const domain = { ...plane, minZ: z - HEIGHT / 2, maxZ: z + HEIGHT / 2 };
      const placement = fitPlacement(compiled, inside(domain, around(rows)), TOLERANCE, NAME);
      placeIntegers(placement, Int32Array.of(0, 0, 0), 1, [1, 1, 1], [x, y, z], local);
      return { x, y, z, placement, error: offBy(placement.frame, local, 0, truth) };
    });
  const kinds = [
    fitted.filter(({ placement }) => placement.remainders.length === 0),
    fitted.filter(({ placement }) => placement.remainders.length > 0),
  ].filter((kind) => kind.length > 0);
  const out = new Float32Array(3 * POINTS);
  const times = nanoseconds(kinds.map(([node]) => ({ task: placeTask(node, out), items: POINTS })));
  return kinds.map((kind, i) => ({
    method: kind[0].placement.remainders.length > 0 ? REMAINDER : kind[0].placement.scheme,
    ns: times[i],
    error: Math.max(...kind.map(({ error }) => error)),
    bound: Math.max(...kind.map(({ placement }) => placement.bound)),
    nodes: kind.length,
    chosen: true,
  }));
}

function placeTask({ x, y, z, placement }, out) {
  const { xyz, scale } = nodeOf(x, y, EDGE, HEIGHT, POINTS);
  const offset = [x, y, z - HEIGHT / 2];
  return () => placeIntegers(placement, xyz, POINTS, scale, offset, out);
}

/** A box cut off at the edges of a rectangle, beyond which the transformation knows no place. */
function inside(box, { minX, minY, maxX, maxY }) {
  return {
    ...box,
    ...{ minX: Math.max(box.minX, minX), maxX: Math.min(box.maxX, maxX) },
    ...{ minY: Math.max(box.minY, minY), maxY: Math.min(box.maxY, maxY) },
  };
}
