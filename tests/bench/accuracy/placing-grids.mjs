import { compileTransformation, fitPlacement, geodeticToEcef, placeIntegers } from "@groma/georef";
import proj4 from "proj4";
import { around, egm96Package, numerics, truthRows } from "./grids.mjs";
import { nodeOf, offBy, openCrs } from "./nodes.mjs";
import { FORWARD, TOLERANCE } from "./placing.mjs";
import { nanoseconds } from "./timing.mjs";

/** Names of the pipelines, and the horizontal CRS that proj4js is given. */
const NAMES = { "EPSG:7415": "EPSG:28992", "EPSG:2056+5728": "EPSG:2056" };
const EDGE = 1000;
const HEIGHT = 200;
const DEGREE = Math.PI / 180;
/** Of the rows, those that a node of its own is fitted around. */
const NODES = 150;
const POINTS = 50000;

export const FALLBACK = "proj4.forward + EGM96";
export const EVALUATE = "transformation";
/** Nodes that no single function is near enough to, because they lie across lines of a grid: a fold for each of one or two. */
export const CREASED = "fit + grid lines";
/** The same where more lines cross a grid of heights: each point looks its cell up. */
export const RELIEF = "fit + heights of cells";
/** The same for any grid, along all axes. */
export const REMAINDER = "fit + grid cells";

/**
 * RD New with heights above NAP, and LV95 with heights above LN02, against PROJ with its grids: proj4js as it is, with
 * the geoid EGM96, the transformation of the georeference record, and nodes fitted to it.
 *
 * @returns {Promise<object[]>} none where the grids or the truth are not there
 */
export async function measureWithGrids(root) {
  const { missingFor, PIPELINES, pipeline } = await numerics(root);
  const all = [];
  for (const [name, horizontal] of Object.entries(NAMES)) {
    if (missingFor(name)) continue;
    const rows = truthRows(root, PIPELINES[name].truth);
    const compiled = compileTransformation(await pipeline(name, around(rows)), name);
    const measured = [...measureEngines(root, compiled, rows, horizontal), ...measureNodes(compiled, rows)];
    all.push(...measured.map((row) => ({ crs: name, edge: EDGE, ...row })));
  }
  return all;
}

function measureEngines(root, compiled, rows, horizontal) {
  const { crs } = openCrs(horizontal);
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
      const placement = fitPlacement(compiled, inside(domain, around(rows)), TOLERANCE);
      placeIntegers(placement, Int32Array.of(0, 0, 0), 1, [1, 1, 1], [x, y, z], local);
      return { x, y, z, placement, error: offBy(placement.frame, local, 0, truth) };
    });
  const kinds = [...new Set(fitted.map(({ placement }) => kindOf(placement)))].map((kind) =>
    fitted.filter(({ placement }) => kindOf(placement) === kind),
  );
  const out = new Float32Array(3 * POINTS);
  const times = nanoseconds(kinds.map(([node]) => ({ task: placeTask(node, out), items: POINTS })));
  return kinds.map((kind, i) => ({
    method: kindOf(kind[0].placement),
    ns: times[i],
    error: Math.max(...kind.map(({ error }) => error)),
    bound: Math.max(...kind.map(({ placement }) => placement.bound)),
    nodes: kind.length,
    chosen: true,
  }));
}

function kindOf({ scheme, remainders, creases, relief }) {
  if (remainders.length > 0) return REMAINDER;
  if (relief) return RELIEF;
  return creases ? CREASED : scheme;
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
