import { fitPlane } from "@groma/georef";
import type { Held, VolumeBase } from "./base.js";
import { areaWithin } from "./prisms.js";
import type { RingIndex } from "./ring-index.js";
import type { Tin } from "./tin.js";

/**
 * How a volume changes with the places of points that are each off by themselves: the roots of the sums of the squares of its
 * derivatives by their heights, and by their places in plan (their lengths). Cubic metres a metre.
 */
export interface Sensitivity {
  readonly up: number;
  readonly plan: number;
}

/** By the points of the surface, by those of another surface that it is held against, and by the ring's vertices. */
export interface Sensitivities {
  readonly surface: Sensitivity;
  readonly base: Sensitivity;
  readonly ring: Sensitivity;
}

/** What they are worked out of. */
interface Worked {
  readonly points: Float64Array;
  readonly ring: Float64Array;
  readonly kind: VolumeBase["kind"];
  readonly held: Held;
  readonly differences: Tin;
  readonly index: RingIndex;
}

const NONE: Sensitivity = { up: 0, plan: 0 };

/**
 * To first order: the height of a point counts by the area that it stands for; a point that moves in plan takes its height
 * along on the slope of its surface; an edge of the ring that moves takes in what stands above it.
 */
export function sensitivitiesOf({ points, ring, kind, held, differences, index }: Worked): Sensitivities {
  const edges = ofEdges(ring, differences);
  if (!held.surfaces) {
    const heights = Float64Array.from({ length: points.length / 3 }, (_, i) => points[3 * i + 2]);
    const surface = summed(ofSurface(differences, heights, index));
    return { surface, base: NONE, ring: summed(edges, ofLevel(ring, kind, index)) };
  }
  const [surface, base] = held.surfaces.map((one) => () => ofSurface(one, one.z, index));
  return kind === "ring"
    ? { surface: summed(surface()), base: NONE, ring: summed(edges, base()) }
    : { surface: summed(surface()), base: summed(base()), ring: summed(edges) };
}

/** Derivatives by each point: along x and y, and by its height. */
interface Derivatives {
  readonly x: Float64Array;
  readonly y: Float64Array;
  readonly up: Float64Array;
}

function derivatives(count: number): Derivatives {
  return { x: new Float64Array(count), y: new Float64Array(count), up: new Float64Array(count) };
}

/** @param further of the same points */
function summed(of: Derivatives, further?: Derivatives): Sensitivity {
  let [up, plan] = [0, 0];
  for (let i = 0; i < of.up.length; i++) {
    up += (of.up[i] + (further?.up[i] ?? 0)) ** 2;
    plan += (of.x[i] + (further?.x[i] ?? 0)) ** 2 + (of.y[i] + (further?.y[i] ?? 0)) ** 2;
  }
  return { up: Math.sqrt(up), plan: Math.sqrt(plan) };
}

/** By the points of a surface, or, with the other sign of `up`, of one that is taken off. @param z their heights */
function ofSurface({ triangles, xy }: Tin, z: Float64Array, index: RingIndex): Derivatives {
  const found = derivatives(z.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
    const third = areaWithin(index, xy, a, b, c) / 3;
    if (third === 0) continue;
    const [ux, uy, uz] = [xy[2 * b] - xy[2 * a], xy[2 * b + 1] - xy[2 * a + 1], z[b] - z[a]];
    const [vx, vy, vz] = [xy[2 * c] - xy[2 * a], xy[2 * c + 1] - xy[2 * a + 1], z[c] - z[a]];
    const twice = ux * vy - uy * vx;
    const [x, y] = [(third * (uz * vy - vz * uy)) / twice, (third * (vz * ux - uz * vx)) / twice];
    for (const point of [a, b, c]) {
      found.x[point] += x;
      found.y[point] += y;
      found.up[point] -= third;
    }
  }
  return found;
}

/** By the ring's vertices, as those of the level or the plane that they make. */
function ofLevel(
  ring: Float64Array,
  kind: VolumeBase["kind"],
  { area, ring: outline }: RingIndex,
): Derivatives {
  const count = ring.length / 3;
  const found = derivatives(count);
  if (kind === "lowest" || kind === "highest") {
    const sign = kind === "lowest" ? 1 : -1;
    let chosen = 0;
    for (let i = 1; i < count; i++) if (sign * (ring[3 * i + 2] - ring[3 * chosen + 2]) < 0) chosen = i;
    found.up[chosen] = -area;
  }
  if (kind !== "plane") return found;
  // The height of the plane of least squares over the centroid, by the heights of its points.
  const { centre, normal } = fitPlane(ring);
  let [xx, xy, yy] = [0, 0, 0];
  for (let i = 0; i < ring.length; i += 3) {
    const [x, y] = [ring[i] - centre[0], ring[i + 1] - centre[1]];
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  const [middleX, middleY] = centroid(outline);
  const [x, y] = [middleX - centre[0], middleY - centre[1]];
  const determinant = xx * yy - xy * xy;
  const [alongX, alongY] = [(yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant];
  for (let i = 0; i < count; i++) {
    const share =
      area * (1 / count + alongX * (ring[3 * i] - centre[0]) + alongY * (ring[3 * i + 1] - centre[1]));
    found.up[i] = -share;
    found.x[i] = (-share * normal[0]) / normal[2];
    found.y[i] = (-share * normal[1]) / normal[2];
  }
  return found;
}

/** By the places of the ring's vertices; what stands above an edge is taken to be linear between its ends. */
function ofEdges(ring: Float64Array, above: Tin): Derivatives {
  const count = ring.length / 3;
  const found = derivatives(count);
  const heights = Float64Array.from({ length: count }, (_, i) => {
    const height = above.heightAt(ring[3 * i], ring[3 * i + 1]);
    // Where the points do not reach, nothing is taken in.
    return Number.isNaN(height) ? 0 : height;
  });
  let twice = 0;
  for (let i = 0; i < count; i++) {
    const j = (i + 1) % count;
    const [x, y] = [ring[3 * j] - ring[3 * i], ring[3 * j + 1] - ring[3 * i + 1]];
    twice += (ring[3 * i] - ring[0]) * (ring[3 * j + 1] - ring[1]);
    twice -= (ring[3 * j] - ring[0]) * (ring[3 * i + 1] - ring[1]);
    const [atI, atJ] = [(2 * heights[i] + heights[j]) / 6, (heights[i] + 2 * heights[j]) / 6];
    found.x[i] += y * atI;
    found.y[i] -= x * atI;
    found.x[j] += y * atJ;
    found.y[j] -= x * atJ;
  }
  if (twice < 0) {
    for (let i = 0; i < count; i++) {
      found.x[i] *= -1;
      found.y[i] *= -1;
    }
  }
  return found;
}

/** Of a ring's area. @param outline x, y of each vertex, counter-clockwise */
function centroid(outline: Float64Array): [number, number] {
  // From the first vertex on, so that no digits are lost far from the origin.
  const [x0, y0] = outline;
  let [twice, x, y] = [0, 0, 0];
  for (let i = 0, j = outline.length - 2; i < outline.length; j = i, i += 2) {
    const [ax, ay, bx, by] = [outline[j] - x0, outline[j + 1] - y0, outline[i] - x0, outline[i + 1] - y0];
    const cross = ax * by - bx * ay;
    twice += cross;
    x += (ax + bx) * cross;
    y += (ay + by) * cross;
  }
  return [x0 + x / (3 * twice), y0 + y / (3 * twice)];
}
