import { addCreases } from "./creases.js";
import { boxOf } from "./expansion.js";
import { addRemainder } from "./grid-remainder.js";
import type { Placement } from "./placement.js";
import { addRelief } from "./relief.js";
import { type FittedScheme, keeps, termCount, termIndex } from "./scheme.js";

/**
 * Places one point, float64 throughout.
 *
 * @param x source coordinate, as `y` and `z`; inside the placement's domain, outside it nothing is certified
 * @param out receives ECEF, metres
 * @param offset index in `out` of X
 */
export function place(
  placement: Placement,
  x: number,
  y: number,
  z: number,
  out: Float64Array,
  offset = 0,
): void {
  const { scheme, frame, exact } = placement;
  if (scheme === "exact") {
    exact?.(x, y, z, out, offset);
    return;
  }
  const box = boxOf(placement.domain);
  const u = (x - box.x) / box.halfX;
  const v = (y - box.y) / box.halfY;
  const w = (z - box.z) / box.halfZ;
  const local = polynomial(placement.coefficients, scheme, u, v, w);
  for (const remainder of placement.remainders) addRemainder(remainder, u, v, local);
  if (placement.creases) addCreases(placement.creases, u, v, local);
  if (placement.relief) addRelief(placement.relief, u, v, local);
  const { origin, rotation } = frame;
  for (let axis = 0; axis < 3; axis++) {
    const turned = rotation[axis] * local[0] + rotation[axis + 3] * local[1] + rotation[axis + 6] * local[2];
    out[offset + axis] = origin[axis] + turned;
  }
}

function polynomial(
  coefficients: Float64Array,
  scheme: FittedScheme,
  u: number,
  v: number,
  w: number,
): Float64Array {
  const local = new Float64Array(3);
  const termsP = termCount(scheme, "P");
  const stride = termsP + termCount(scheme, "n");
  for (const [part, first, factor] of [
    ["P", 0, 1],
    ["n", termsP, w],
  ] as const) {
    for (let k = 0; keeps(scheme, part, k, 0); k++) {
      for (let l = 0; keeps(scheme, part, k, l); l++) {
        const basis = factor * u ** k * v ** l;
        const term = first + termIndex(scheme, part, k, l);
        for (let axis = 0; axis < 3; axis++) local[axis] += basis * coefficients[axis * stride + term];
      }
    }
  }
  return local;
}
