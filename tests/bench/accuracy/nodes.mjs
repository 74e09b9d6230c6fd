import { createRequire } from "node:module";
import { exactTransform, resolveCrs } from "@groma/georef";
import { random } from "./timing.mjs";

const epsg = createRequire(import.meta.url)("epsg-index/all.json");

/** A CRS by its EPSG code, with its exact transform. */
export function openCrs(given) {
  const crs = resolveCrs({ file: given, given }, (code) => epsg[code]);
  return { crs, exact: exactTransform(crs) };
}

/**
 * Random LAS integers of a square node, of 2⁻³⁰ of its edge and of its height.
 *
 * @param {number} edge source units, as the centre
 * @param {number} height of the box, from z = 0
 */
export function nodeOf(x, y, edge, height, count) {
  const offset = [x, y, 0];
  const scale = [edge * 2 ** -30, edge * 2 ** -30, height * 2 ** -30];
  const next = random(20261122);
  const xyz = Int32Array.from({ length: 3 * count }, (_, i) =>
    Math.floor((next() - (i % 3 === 2 ? 0 : 0.5)) * 2 ** 30),
  );
  // The corners, where polynomials err most.
  for (let i = 0; i < 4; i++) {
    xyz.set([i & 1 ? 2 ** 29 : -(2 ** 29), i & 2 ? 2 ** 29 : -(2 ** 29), i % 3 ? 0 : 2 ** 30], 3 * i);
  }
  const domain = {
    ...{ minX: x - edge / 2, maxX: x + edge / 2, minY: y - edge / 2, maxY: y + edge / 2 },
    ...{ minZ: 0, maxZ: height },
  };
  return { domain, offset, scale, xyz, count };
}

/** Source coordinates of point i. */
export function sourceOf({ xyz, scale, offset }, i) {
  return [0, 1, 2].map((axis) => xyz[3 * i + axis] * scale[axis] + offset[axis]);
}

/** Distance of a point stored in a node frame (float32) from where it belongs in ECEF. */
export function offBy({ origin, rotation: r }, local, i, ecef) {
  const [e, n, u] = local.subarray(3 * i, 3 * i + 3);
  return Math.hypot(...[0, 1, 2].map((k) => origin[k] + r[k] * e + r[k + 3] * n + r[k + 6] * u - ecef[k]));
}

/** Writes ECEF into the node frame at point i, as the page stores it. */
export function store({ origin, rotation: r }, ecef, local, i) {
  const x = ecef[0] - origin[0];
  const y = ecef[1] - origin[1];
  const z = ecef[2] - origin[2];
  local[3 * i] = r[0] * x + r[1] * y + r[2] * z;
  local[3 * i + 1] = r[3] * x + r[4] * y + r[5] * z;
  local[3 * i + 2] = r[6] * x + r[7] * y + r[8] * z;
}
