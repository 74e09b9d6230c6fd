import type { Scheme } from "./placement.js";

/** Highest degrees kept of P and of n: of the product's total, or of x and of y each (`tensor`). */
interface Shape {
  readonly kind: "total" | "tensor";
  readonly degreeP: number;
  readonly degreeN: number;
}

/** A scheme that approximates, as opposed to `exact`. */
export type FittedScheme = Exclude<Scheme, "exact">;

/** Cheapest first. */
export const FITTED_SCHEMES: readonly FittedScheme[] = [
  "affine",
  "affineLinearNormal",
  "quadratic",
  "cubic",
  "quartic",
  "tensor6",
];

/** Nanoseconds per point in V8, measured; only their order and rough ratios matter. */
export const COSTS: Readonly<Record<FittedScheme, number>> = {
  affine: 6,
  affineLinearNormal: 8,
  quadratic: 11,
  cubic: 17,
  quartic: 26,
  tensor6: 180,
};
/** The same for what a grid adds: looked up in its cells, looked up for up alone, one or two lines in closed form. */
export const REMAINDER_COST = 35;
export const RELIEF_COST = 4;
export const CREASES_COST = 2;

const SHAPES: Readonly<Record<FittedScheme, Shape>> = {
  affine: { kind: "total", degreeP: 1, degreeN: 0 },
  affineLinearNormal: { kind: "total", degreeP: 1, degreeN: 1 },
  quadratic: { kind: "total", degreeP: 2, degreeN: 1 },
  cubic: { kind: "total", degreeP: 3, degreeN: 2 },
  quartic: { kind: "total", degreeP: 4, degreeN: 3 },
  tensor6: { kind: "tensor", degreeP: 6, degreeN: 6 },
};

/** Which of the six functions: three of P, three of n. */
export type Part = "P" | "n";

function degreeOf(scheme: FittedScheme, part: Part): number {
  return part === "P" ? SHAPES[scheme].degreeP : SHAPES[scheme].degreeN;
}

/** Whether the scheme keeps the term of degree k in x and l in y. */
export function keeps(scheme: FittedScheme, part: Part, k: number, l: number): boolean {
  const degree = degreeOf(scheme, part);
  return SHAPES[scheme].kind === "total" ? k + l <= degree : k <= degree && l <= degree;
}

/** Number of terms of one component of P or n. */
export function termCount(scheme: FittedScheme, part: Part): number {
  const degree = degreeOf(scheme, part);
  return SHAPES[scheme].kind === "total" ? ((degree + 1) * (degree + 2)) / 2 : (degree + 1) ** 2;
}

/** Position of u^k v^l among the terms of one component, as documented at `Placement.coefficients`. */
export function termIndex(scheme: FittedScheme, part: Part, k: number, l: number): number {
  if (SHAPES[scheme].kind === "tensor") return k * (degreeOf(scheme, part) + 1) + l;
  const total = k + l;
  return (total * (total + 1)) / 2 + l;
}
