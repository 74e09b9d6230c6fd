import type { MeasuredCloud } from "../vertex/vertex.js";
import { type CloudErrors, cloudErrors, type PointError, type WorthOptions } from "./point-errors.js";
import { type OwnError, type QuantityOptions, quantity, type Sensitivity } from "./quantity.js";

/**
 * A length, or a tilt, is that of a vector whose components are each off by themselves. Far from 0 only the one along it
 * counts; near its noise the others lengthen it, and in it there is no direction. The spread is the sum of the variances of all
 * components.
 */

/**
 * Square of a length over its spread, below which it may be noise alone. It is 3 for records that are one step of their
 * integers apart on a plane, which noise alone can be, and a little more for the scale factor of projections.
 */
const NOISE = 3.02;

/** What the components across add to a length, in its spread over it: half of what they reach in 95 % of cases, over 1.96. */
const ACROSS = 0.5;

/** Square of a length over a bound of its spread, from which on what is across it does not count. */
const FAR = 6000;

/** How a length changes with the places of vertices, and what noise across it adds. */
export interface Term {
  readonly sensitivities: readonly (readonly Sensitivity[])[];
  /** One standard deviation, in the unit of the length. */
  readonly across: number;
}

/**
 * @param length the value itself
 * @param along its derivatives
 * @param components derivatives of all components of the vector
 */
export function lengthTerm(
  length: number,
  along: readonly Sensitivity[],
  components: () => readonly (readonly Sensitivity[])[],
  options: QuantityOptions,
): Term {
  if (length ** 2 > FAR * bound(along, options)) return { sensitivities: [along], across: 0 };
  const all = components();
  const spread = spreadOf(all, options);
  if (length ** 2 < NOISE * spread) return { sensitivities: all, across: 0 };
  return { sensitivities: [along], across: (ACROSS * spread) / length };
}

/** The part of noise across lines in what is made of them. */
export function acrossError(across: number): OwnError[] {
  const note = "points that are off sideways lengthen what is short";
  return across > 0 ? [{ name: "noise across", standard: across, note }] : [];
}

/** How a direction changes: undefined where noise alone may have made it. */
export function directionTerm(
  length: number,
  turning: readonly Sensitivity[],
  components: () => readonly (readonly Sensitivity[])[],
  options: QuantityOptions,
): readonly Sensitivity[] | undefined {
  // The derivatives are those of the turn, by 1 / length.
  if (1 > FAR * bound(turning, options)) return turning;
  const share = spreadOf(components(), options) / length ** 2;
  if (1 < NOISE * share) return undefined;
  // What is measured is longer than what is there, by its noise.
  const factor = 1 / Math.sqrt(1 - share);
  return turning.map(({ vertex, gradient: [x, y, z] }) => ({
    vertex,
    gradient: [x * factor, y * factor, z * factor],
  }));
}

/** A direction that may be any: half a turn either way. */
export const ANY_DIRECTION: readonly OwnError[] = [
  { name: "direction", standard: Math.PI / 1.96, note: "what it is the direction of may be noise" },
];

/** Sum of the variances of components. */
export function spreadOf(components: readonly (readonly Sensitivity[])[], options: QuantityOptions): number {
  let sum = 0;
  for (const { standard } of quantity(0, "m", components, options).parts) sum += (standard ?? 0) ** 2;
  return sum;
}

/** A bound of the spread, by the greatest error of each vertex along any axis. */
function bound(along: readonly Sensitivity[], { precision }: WorthOptions): number {
  let sum = 0;
  const [first] = along;
  const several = along.some(({ vertex }) => vertex.cloud !== first?.vertex.cloud);
  // Of most lists all vertices stand on one data set.
  let last: { readonly cloud: MeasuredCloud | undefined; readonly errors: CloudErrors } | undefined;
  for (const { vertex, gradient } of along) {
    const { cloud } = vertex;
    if (last?.cloud !== cloud || !last) last = { cloud, errors: cloudErrors(cloud, precision) };
    const { ofRecords, ofPlaces, shared } = last.errors;
    const square = gradient[0] ** 2 + gradient[1] ** 2 + gradient[2] ** 2;
    sum += square * variance(vertex.record ? ofRecords : ofPlaces);
    if (several) sum += square * variance(shared);
  }
  return 3 * sum;
}

function variance(errors: readonly PointError[]): number {
  let sum = 0;
  for (const { known, horizontal, up } of errors) if (known) sum += Math.max(horizontal, up) ** 2;
  return sum;
}
