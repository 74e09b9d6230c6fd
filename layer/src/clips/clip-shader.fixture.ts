import { HAS_BOTTOM, HAS_TOP, PRISM_HEADER, STARTS_INSIDE } from "./clip-roles.js";
import { clipTexture, type NodeClips } from "./clip-volumes.js";
import type { SourceSpace } from "./volume.js";

const f = Math.fround;

/** For volumes that are given in geodetic coordinates. */
export const EARTH: SourceSpace = {
  place: (_x, _y, _z, out) => out,
  boundingBox: { min: [0, 0, 0], max: [1, 1, 1] },
};

/**
 * What the shader makes of a point of a node, in float32 as it computes: numbers of records that keep, of these around the
 * point, that cut around it, that highlight around it.
 */
export function rolesOf(node: NodeClips, point: readonly [number, number, number]): number[] {
  const { data, records } = clipTexture([node]);
  const texel = (index: number) => data.subarray(4 * index, 4 * index + 4);
  const p = point.map(f);
  const roles = [0, 0, 0, 0];
  let at: number = records[0][0];
  for (let record = 0; record < records[0][1]; record++) {
    const [kind, role, count, bits] = texel(at++);
    const inside = kind > 0.5 ? insidePrism(texel, at, count, bits, p) : insidePlanes(texel, at, count, p);
    at += count + (kind > 0.5 ? PRISM_HEADER - 1 : 0);
    if (role === 0) roles[0]++;
    if (inside) roles[role + 1]++;
  }
  return roles;
}

/** Whether the shader draws a point. */
export function draws(node: NodeClips, point: readonly [number, number, number]): boolean {
  if (node.state !== "crossing") return node.state === "in";
  const [keeping, around, cut] = rolesOf(node, point);
  return cut === 0 && (keeping === 0 || around > 0);
}

type Texels = (index: number) => Float32Array;

function insidePlanes(texel: Texels, from: number, count: number, [x, y, z]: number[]): boolean {
  for (let i = 0; i < count; i++) {
    const [a, b, c, d] = texel(from + i);
    if (f(f(f(f(a * x) + f(b * y)) + f(c * z)) + d) < 0) return false;
  }
  return true;
}

function insidePrism(texel: Texels, from: number, edges: number, bits: number, [x, y, z]: number[]): boolean {
  const [ix, iy, tiltX, tiltY] = texel(from);
  const [middle, bottom, top, curvature] = texel(from + 1);
  if ((bits & (HAS_BOTTOM | HAS_TOP)) !== 0) {
    const [bx, by, tx, ty] = texel(from + 2);
    const across = f(f(f(x * x) * ix) + f(f(y * y) * iy));
    const along = f(1 + f(z * curvature));
    const height = f(z + f(across / f(along + f(Math.sqrt(f(f(along * along) + f(across * curvature)))))));
    if ((bits & HAS_BOTTOM) !== 0 && height < f(bottom + f(f(bx * x) + f(by * y)))) return false;
    if ((bits & HAS_TOP) !== 0 && height > f(top + f(f(tx * x) + f(ty * y)))) return false;
  }
  const shrink = [f(z * ix), f(z * iy)];
  const qx = f(f(x - f(x * f(shrink[0] / f(1 + shrink[0])))) - f(f(z - middle) * tiltX));
  const qy = f(f(y - f(y * f(shrink[1] / f(1 + shrink[1])))) - f(f(z - middle) * tiltY));
  let inside = (bits & STARTS_INSIDE) !== 0;
  for (let i = 0; i < edges; i++) {
    const [ax, ay, bx, by] = texel(from + PRISM_HEADER - 1 + i);
    if (ay > qy === by > qy) continue;
    const [dx, dy] = [f(bx - ax), f(by - ay)];
    const side = f(f(f(qx - ax) * dy) - f(f(qy - ay) * dx));
    if (side > 0 === dy > 0) inside = !inside;
  }
  return inside;
}
