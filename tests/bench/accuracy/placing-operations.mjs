import { compileTransformation, fitPlacement, placeIntegers } from "@groma/georef";
import { runPipeline } from "../../../converter/dist/proj/cct.js";
import { listOperations } from "../../../converter/dist/proj/operation.js";
import { parsePipeline } from "../../../converter/dist/proj/pipeline.js";
import { findProj } from "../../../converter/dist/proj/program/find.js";
import { projTransformation } from "../../../converter/dist/proj/transformation.js";
import { nodeOf, offBy, sourceOf } from "./nodes.mjs";
import { TOLERANCE } from "./placing.mjs";
import { EVALUATE } from "./placing-grids.mjs";
import { nanoseconds } from "./timing.mjs";

/** CRS, what of it, and the middle of a node, metres. */
const PLACES = [
  ["EPSG:30200", "Cassini, in Clarke's links", 430000, 325000, 0.201166195164],
  ["EPSG:2048", "south-orientated Mercator", -20000, 3700000, 1],
  ["EPSG:29701", "Laborde", 400000, 800000, 1],
  ["EPSG:8857", "Equal Earth", 1000000, 6000000, 1],
  ["ESRI:54031", "two-point equidistant", 1000000, 2000000, 1],
  ["EPSG:23031", "ED50, in Spain's operation", 450000, 4760000, 1],
];
/** The same where two operations of ED50 meet in the node, Spain's and France's. */
const BORDER = ["EPSG:23031", 450000, 1];
const EDGE = 1000;
const HEIGHT = 200;
const POINTS = 50000;
const EXACT_POINTS = 4000;
/** Points that PROJ is asked for. */
const COMPARED = 2000;

/**
 * Operations whose projection the page has no closed form for, carried as certified patchworks, and one whose data set has
 * two operations: nodes of 1 km against PROJ itself.
 *
 * @returns {Promise<object[]>} none where PROJ is not there
 */
export async function measureOperations() {
  const proj = await findProj();
  if (!proj) return [];
  const rows = [];
  for (const [code, what, x, y, unit] of PLACES) {
    const half = 10000 / unit;
    const domain = { minX: x - half, maxX: x + half, minY: y - half, maxY: y + half, minZ: 0, maxZ: HEIGHT };
    const { transformation, report } = await projTransformation(proj, crsOf(code, unit), domain);
    const node = nodeOf(x, y, EDGE / unit, HEIGHT, POINTS);
    const truth = await byProj(proj, code, report.operation, node);
    rows.push(
      ...measure(transformation, node, truth).map((row) => ({ crs: code, what, edge: EDGE, ...row })),
    );
  }
  return rows;
}

/** A node on the border of two operations, against the transformation point by point, which PROJ has checked. */
export async function measureBorder() {
  const proj = await findProj();
  if (!proj) return [];
  const [code, x, unit] = BORDER;
  const domain = { minX: x - 5e4, maxX: x + 5e4, minY: 4.7e6, maxY: 4.9e6, minZ: 0, maxZ: HEIGHT };
  const { transformation } = await projTransformation(proj, crsOf(code, unit), domain);
  const y = transformation.steps[1].ways[0].area.maxY;
  const node = nodeOf(x, y, EDGE, HEIGHT, EXACT_POINTS);
  const { evaluate } = compileTransformation(transformation);
  const truth = new Float64Array(3 * COMPARED);
  for (let i = 0; i < COMPARED; i++) evaluate(...sourceOf(node, i), truth, 3 * i);
  return measure(transformation, node, truth).map((row) => ({ crs: code, edge: EDGE, ...row }));
}

function crsOf(code, unit) {
  const plane = { name: "unit", kind: "linear", size: unit, declared: true };
  const metre = { name: "metre", kind: "linear", size: 1, declared: true };
  const height = { kind: "unknown" };
  return { name: code, code, proj4: "", horizontalUnit: plane, verticalUnit: metre, height };
}

async function byProj(proj, code, name, node) {
  const operations = await listOperations(proj, { text: code, name: code });
  const { pipeline } = parsePipeline(operations.find((operation) => operation.name === name).pipeline);
  const points = Array.from({ length: COMPARED }, (_, i) => sourceOf(node, i));
  return runPipeline(proj, pipeline, Float64Array.from(points.flat()));
}

function measure(transformation, node, truth) {
  const compiled = compileTransformation(transformation);
  const placement = fitPlacement(compiled, node.domain, TOLERANCE);
  const out = new Float32Array(3 * node.count);
  const ecef = new Float64Array(3 * EXACT_POINTS);
  const sources = Array.from({ length: EXACT_POINTS }, (_, i) => sourceOf(node, i));
  const times = nanoseconds([
    {
      task: () => placeIntegers(placement, node.xyz, node.count, node.scale, node.offset, out),
      items: node.count,
    },
    {
      task: () => {
        for (let i = 0; i < EXACT_POINTS; i++) compiled.evaluate(...sources[i], ecef, 3 * i);
      },
      items: EXACT_POINTS,
    },
  ]);
  const worst = (distance) => {
    return Math.max(
      ...Array.from({ length: COMPARED }, (_, i) => distance(i, truth.subarray(3 * i, 3 * i + 3))),
    );
  };
  return [
    {
      method: EVALUATE,
      ns: times[1],
      error: worst((i, there) => Math.hypot(...[0, 1, 2].map((axis) => ecef[3 * i + axis] - there[axis]))),
      chosen: false,
    },
    {
      method: placement.scheme,
      ns: times[0],
      error: worst((i, there) => offBy(placement.frame, out, i, there)),
      bound: placement.bound,
      chosen: true,
    },
  ];
}
