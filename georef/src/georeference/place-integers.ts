import type { Creases } from "./creases.js";
import { boxOf } from "./expansion.js";
import type { GridRemainder } from "./grid-remainder.js";
import type { Placement } from "./placement.js";
import type { Relief } from "./relief.js";

/**
 * Input of a kernel: u = xyz[3i] · scaleU + offsetU and so on run from −1 to 1 over the placement's domain, so that
 * LAS scale and offset cost nothing per point.
 */
interface Integers {
  readonly xyz: Int32Array;
  readonly count: number;
  readonly scaleU: number;
  readonly scaleV: number;
  readonly scaleW: number;
  readonly offsetU: number;
  readonly offsetV: number;
  readonly offsetW: number;
}

/**
 * Places the integer records of a node: LAS integers to float32 metres of the node frame.
 * Coordinates outside the placement's domain are placed too, but nothing is certified about them.
 *
 * @param xyz x, y, z of each record, 3 · count integers
 * @param scale LAS scale factors, 3 values, source units
 * @param offset LAS offsets, 3 values, source units
 * @param out receives east, north, up of each point, 3 · count values
 */
export function placeIntegers(
  placement: Placement,
  xyz: Int32Array,
  count: number,
  scale: ArrayLike<number>,
  offset: ArrayLike<number>,
  out: Float32Array,
): void {
  const { scheme, coefficients } = placement;
  if (scheme === "exact") {
    placeExactly(placement, xyz, count, scale, offset, out);
    return;
  }
  const box = boxOf(placement.domain);
  const integers: Integers = {
    xyz,
    count,
    scaleU: scale[0] / box.halfX,
    scaleV: scale[1] / box.halfY,
    scaleW: scale[2] / box.halfZ,
    offsetU: (offset[0] - box.x) / box.halfX,
    offsetV: (offset[1] - box.y) / box.halfY,
    offsetW: (offset[2] - box.z) / box.halfZ,
  };
  const { creases, relief, remainders } = placement;
  if (scheme === "quadratic" && relief) quadraticOnRelief(integers, coefficients, relief, out);
  else if (scheme === "quadratic" && creases) quadraticWithCreases(integers, coefficients, creases, out);
  else {
    out.fill(0, 0, 3 * count);
    for (const remainder of remainders) addRemainders(integers, remainder, out);
    if (relief) addReliefOfEach(integers, relief, out);
    if (creases) addCreasesOfEach(integers, creases, out);
    KERNELS[scheme](integers, coefficients, out);
  }
}

/** What the cells of a relief add, per point, as `addRelief`; before the kernels, as remainders. */
function addReliefOfEach(integers: Integers, { columns, position, cells }: Relief, out: Float32Array): void {
  const { xyz, count, scaleU, scaleV, offsetU, offsetV } = integers;
  const [x0, xu, xv, y0, yu, yv] = position;
  const stride = columns + 1;
  const mask = cells.length - 1;
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const u = xyz[i] * scaleU + offsetU;
    const v = xyz[i + 1] * scaleV + offsetV;
    const x = x0 + u * xu + v * xv;
    const y = y0 + u * yu + v * yv;
    // Truncation is floor here, but for the sliver below zero that belongs to cell 0 anyway.
    const at = ((Math.imul(y | 0, stride) + (x | 0)) << 2) & mask;
    out[i + 2] += cells[at] + x * cells[at + 1] + y * (cells[at + 2] + x * cells[at + 3]);
  }
}

/** What the lines of grids add, per point, as `addCreases`; before the kernels, as remainders. */
function addCreasesOfEach(integers: Integers, { lines, folds }: Creases, out: Float32Array): void {
  const { xyz, count, scaleU, scaleV, offsetU, offsetV } = integers;
  const [s0, su, sv, t0 = 0, tu = 0, tv = 0] = lines;
  const [as, bs, cs, at = 0, bt = 0, ct = 0] = folds;
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const u = xyz[i] * scaleU + offsetU;
    const v = xyz[i + 1] * scaleV + offsetV;
    const s = Math.abs(s0 + u * su + v * sv);
    const t = Math.abs(t0 + u * tu + v * tv);
    out[i] += s * as + t * at;
    out[i + 1] += s * bs + t * bt;
    out[i + 2] += s * cs + t * ct;
  }
}

/**
 * What a grid adds, per point, as `addRemainder` but with everything at hand. Before the kernels, so that the sum is
 * rounded to float32 but once.
 */
function addRemainders(
  integers: Integers,
  { columns, rows, cells, position }: GridRemainder,
  out: Float32Array,
): void {
  const { xyz, count, scaleU, scaleV, offsetU, offsetV } = integers;
  const [x0, xu, xv, xuu, xuv, xvv, y0, yu, yv, yuu, yuv, yvv] = position;
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const u = xyz[i] * scaleU + offsetU;
    const v = xyz[i + 1] * scaleV + offsetV;
    const x = x0 + u * (xu + u * xuu + v * xuv) + v * (xv + v * xvv);
    const y = y0 + u * (yu + u * yuu + v * yuv) + v * (yv + v * yvv);
    // Truncation is floor here, but for the sliver below zero that belongs to cell 0 anyway.
    const column = Math.max(0, Math.min(columns - 1, x | 0));
    const row = Math.max(0, Math.min(rows - 1, y | 0));
    const e = x - column;
    const n = y - row;
    const at = 12 * (row * columns + column);
    out[i] += cells[at] + e * cells[at + 1] + n * (cells[at + 2] + e * cells[at + 3]);
    out[i + 1] += cells[at + 4] + e * cells[at + 5] + n * (cells[at + 6] + e * cells[at + 7]);
    out[i + 2] += cells[at + 8] + e * cells[at + 9] + n * (cells[at + 10] + e * cells[at + 11]);
  }
}

/** Adds the polynomials of a scheme to what `out` holds. */
type Kernel = (integers: Integers, coefficients: Float64Array, out: Float32Array) => void;

/** The three components in one pass, the fastest up to here (measured: 10 ns against 14 for the quadratic one). */
const affine: Kernel = (integers, coefficients, out) => {
  const { xyz, count, scaleU, scaleV, scaleW, offsetU, offsetV, offsetW } = integers;
  const [a0, a1, a2, an, b0, b1, b2, bn, c0, c1, c2, cn] = coefficients;
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const u = xyz[i] * scaleU + offsetU;
    const v = xyz[i + 1] * scaleV + offsetV;
    const w = xyz[i + 2] * scaleW + offsetW;
    out[i] += a0 + u * a1 + v * a2 + w * an;
    out[i + 1] += b0 + u * b1 + v * b2 + w * bn;
    out[i + 2] += c0 + u * c1 + v * c2 + w * cn;
  }
};

const affineLinearNormal: Kernel = (integers, coefficients, out) => {
  const { xyz, count, scaleU, scaleV, scaleW, offsetU, offsetV, offsetW } = integers;
  const [a0, a1, a2, an0, an1, an2, b0, b1, b2, bn0, bn1, bn2, c0, c1, c2, cn0, cn1, cn2] = coefficients;
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const u = xyz[i] * scaleU + offsetU;
    const v = xyz[i + 1] * scaleV + offsetV;
    const w = xyz[i + 2] * scaleW + offsetW;
    out[i] += a0 + u * a1 + v * a2 + w * (an0 + u * an1 + v * an2);
    out[i + 1] += b0 + u * b1 + v * b2 + w * (bn0 + u * bn1 + v * bn2);
    out[i + 2] += c0 + u * c1 + v * c2 + w * (cn0 + u * cn1 + v * cn2);
  }
};

const quadratic: Kernel = (integers, coefficients, out) => {
  const { xyz, count, scaleU, scaleV, scaleW, offsetU, offsetV, offsetW } = integers;
  const [a0, au, av, auu, auv, avv, an, anu, anv] = coefficients;
  const [b0, bu, bv, buu, buv, bvv, bn, bnu, bnv] = coefficients.subarray(9);
  const [c0, cu, cv, cuu, cuv, cvv, cn, cnu, cnv] = coefficients.subarray(18);
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const u = xyz[i] * scaleU + offsetU;
    const v = xyz[i + 1] * scaleV + offsetV;
    const w = xyz[i + 2] * scaleW + offsetW;
    out[i] += a0 + u * (au + u * auu + v * auv) + v * (av + v * avv) + w * (an + u * anu + v * anv);
    out[i + 1] += b0 + u * (bu + u * buu + v * buv) + v * (bv + v * bvv) + w * (bn + u * bnu + v * bnv);
    out[i + 2] += c0 + u * (cu + u * cuu + v * cuv) + v * (cv + v * cvv) + w * (cn + u * cnu + v * cnv);
  }
};

/** The quadratic scheme and what a grid adds in one pass; in two they cost half as much again. */
type FusedKernel<Added> = (
  integers: Integers,
  coefficients: Float64Array,
  added: Added,
  out: Float32Array,
) => void;

const quadraticOnRelief: FusedKernel<Relief> = (integers, coefficients, relief, out) => {
  const { xyz, count, scaleU, scaleV, scaleW, offsetU, offsetV, offsetW } = integers;
  const [a0, au, av, auu, auv, avv, an, anu, anv] = coefficients;
  const [b0, bu, bv, buu, buv, bvv, bn, bnu, bnv] = coefficients.subarray(9);
  const [c0, cu, cv, cuu, cuv, cvv, cn, cnu, cnv] = coefficients.subarray(18);
  const [x0, xu, xv, y0, yu, yv] = relief.position;
  const { cells } = relief;
  const stride = relief.columns + 1;
  const mask = cells.length - 1;
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const u = xyz[i] * scaleU + offsetU;
    const v = xyz[i + 1] * scaleV + offsetV;
    const w = xyz[i + 2] * scaleW + offsetW;
    out[i] = a0 + u * (au + u * auu + v * auv) + v * (av + v * avv) + w * (an + u * anu + v * anv);
    out[i + 1] = b0 + u * (bu + u * buu + v * buv) + v * (bv + v * bvv) + w * (bn + u * bnu + v * bnv);
    const x = x0 + u * xu + v * xv;
    const y = y0 + u * yu + v * yv;
    const at = ((Math.imul(y | 0, stride) + (x | 0)) << 2) & mask;
    const c = c0 + u * (cu + u * cuu + v * cuv) + v * (cv + v * cvv) + w * (cn + u * cnu + v * cnv);
    out[i + 2] = c + (cells[at] + x * cells[at + 1] + y * (cells[at + 2] + x * cells[at + 3]));
  }
};

const quadraticWithCreases: FusedKernel<Creases> = (integers, coefficients, { lines, folds }, out) => {
  const { xyz, count, scaleU, scaleV, scaleW, offsetU, offsetV, offsetW } = integers;
  const [a0, au, av, auu, auv, avv, an, anu, anv] = coefficients;
  const [b0, bu, bv, buu, buv, bvv, bn, bnu, bnv] = coefficients.subarray(9);
  const [c0, cu, cv, cuu, cuv, cvv, cn, cnu, cnv] = coefficients.subarray(18);
  const [s0, su, sv, t0 = 0, tu = 0, tv = 0] = lines;
  const [as, bs, cs, at = 0, bt = 0, ct = 0] = folds;
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const u = xyz[i] * scaleU + offsetU;
    const v = xyz[i + 1] * scaleV + offsetV;
    const w = xyz[i + 2] * scaleW + offsetW;
    const s = Math.abs(s0 + u * su + v * sv);
    const t = Math.abs(t0 + u * tu + v * tv);
    const a = a0 + u * (au + u * auu + v * auv) + v * (av + v * avv) + w * (an + u * anu + v * anv);
    out[i] = a + s * as + t * at;
    const b = b0 + u * (bu + u * buu + v * buv) + v * (bv + v * bvv) + w * (bn + u * bnu + v * bnv);
    out[i + 1] = b + s * bs + t * bt;
    const c = c0 + u * (cu + u * cuu + v * cuv) + v * (cv + v * cvv) + w * (cn + u * cnu + v * cnv);
    out[i + 2] = c + s * cs + t * ct;
  }
};

const cubic: Kernel = (integers, coefficients, out) => {
  const { xyz, count, scaleU, scaleV, scaleW, offsetU, offsetV, offsetW } = integers;
  const [a00, a10, a01, a20, a11, a02, a30, a21, a12, a03] = coefficients;
  const [an00, an10, an01, an20, an11, an02] = coefficients.subarray(10);
  const [b00, b10, b01, b20, b11, b02, b30, b21, b12, b03] = coefficients.subarray(16);
  const [bn00, bn10, bn01, bn20, bn11, bn02] = coefficients.subarray(26);
  const [c00, c10, c01, c20, c11, c02, c30, c21, c12, c03] = coefficients.subarray(32);
  const [cn00, cn10, cn01, cn20, cn11, cn02] = coefficients.subarray(42);
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const u = xyz[i] * scaleU + offsetU;
    const v = xyz[i + 1] * scaleV + offsetV;
    const w = xyz[i + 2] * scaleW + offsetW;
    const a =
      a00 + u * (a10 + v * (a11 + v * a12) + u * (a20 + v * a21 + u * a30)) + v * (a01 + v * (a02 + v * a03));
    out[i] += a + w * (an00 + u * (an10 + u * an20 + v * an11) + v * (an01 + v * an02));
    const b =
      b00 + u * (b10 + v * (b11 + v * b12) + u * (b20 + v * b21 + u * b30)) + v * (b01 + v * (b02 + v * b03));
    out[i + 1] += b + w * (bn00 + u * (bn10 + u * bn20 + v * bn11) + v * (bn01 + v * bn02));
    const c =
      c00 + u * (c10 + v * (c11 + v * c12) + u * (c20 + v * c21 + u * c30)) + v * (c01 + v * (c02 + v * c03));
    out[i + 2] += c + w * (cn00 + u * (cn10 + u * cn20 + v * cn11) + v * (cn01 + v * cn02));
  }
};

/** One component per pass from here on: schemes for nodes of 100 km, of which a scene has few. */
const quartic: Kernel = (integers, coefficients, out) => {
  const { xyz, count, scaleU, scaleV, scaleW, offsetU, offsetV, offsetW } = integers;
  for (let axis = 0; axis < 3; axis++) {
    const at = coefficients.subarray(axis * 25);
    const [p00, p10, p01, p20, p11, p02, p30, p21, p12, p03, p40, p31, p22, p13, p04] = at;
    const [n00, n10, n01, n20, n11, n02, n30, n21, n12, n03] = at.subarray(15);
    for (let i = 0, end = 3 * count; i < end; i += 3) {
      const u = xyz[i] * scaleU + offsetU;
      const v = xyz[i + 1] * scaleV + offsetV;
      const w = xyz[i + 2] * scaleW + offsetW;
      const p =
        p00 +
        v * (p01 + v * (p02 + v * (p03 + v * p04))) +
        u *
          (p10 +
            v * (p11 + v * (p12 + v * p13)) +
            u * (p20 + v * (p21 + v * p22) + u * (p30 + v * p31 + u * p40)));
      const n =
        n00 +
        v * (n01 + v * (n02 + v * n03)) +
        u * (n10 + v * (n11 + v * n12) + u * (n20 + v * n21 + u * n30));
      out[i + axis] += p + w * n;
    }
  }
};

const tensor6: Kernel = (integers, coefficients, out) => {
  const { xyz, count, scaleU, scaleV, scaleW, offsetU, offsetV, offsetW } = integers;
  for (let axis = 0; axis < 3; axis++) {
    const p = axis * 98;
    const n = p + 49;
    for (let i = 0, end = 3 * count; i < end; i += 3) {
      const u = xyz[i] * scaleU + offsetU;
      const v = xyz[i + 1] * scaleV + offsetV;
      const w = xyz[i + 2] * scaleW + offsetW;
      let sum = 0;
      for (let row = 42; row >= 0; row -= 7) {
        let inner = 0;
        for (let l = row + 6; l >= row; l--)
          inner = inner * v + (coefficients[p + l] + w * coefficients[n + l]);
        sum = sum * u + inner;
      }
      out[i + axis] += sum;
    }
  }
};

const KERNELS = { affine, affineLinearNormal, quadratic, cubic, quartic, tensor6 } as const;

function placeExactly(
  { frame, exact }: Placement,
  xyz: Int32Array,
  count: number,
  scale: ArrayLike<number>,
  offset: ArrayLike<number>,
  out: Float32Array,
): void {
  if (!exact) throw new TypeError("a placement of scheme 'exact' carries its transform");
  const [ox, oy, oz] = frame.origin;
  const [ex, ey, ez, nx, ny, nz, ux, uy, uz] = frame.rotation;
  const ecef = new Float64Array(3);
  for (let i = 0, end = 3 * count; i < end; i += 3) {
    const z = xyz[i + 2] * scale[2] + offset[2];
    exact(xyz[i] * scale[0] + offset[0], xyz[i + 1] * scale[1] + offset[1], z, ecef, 0);
    const x = ecef[0] - ox;
    const y = ecef[1] - oy;
    const up = ecef[2] - oz;
    out[i] = ex * x + ey * y + ez * up;
    out[i + 1] = nx * x + ny * y + nz * up;
    out[i + 2] = ux * x + uy * y + uz * up;
  }
}
