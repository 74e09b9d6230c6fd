import { dot, type Vector } from "@groma/georef";
import { type Axes, axesAt, combined } from "../vertex/axes.js";
import { isSameRecord, type MeasuredCloud, recordKey, type Vertex } from "../vertex/vertex.js";
import { COVERAGE, coverageFactor, RECTANGULAR_KURTOSIS } from "./coverage.js";
import { lackOf } from "./lack.js";
import { cloudErrors, type PointError, type WorthOptions } from "./point-errors.js";

/** SI units of values; 1: a ratio. */
export type SiUnit = "m" | "m²" | "m³" | "rad" | "1";

/** A measured value and what it is worth (JCGM 100:2008, "GUM"). */
export interface Quantity<Unit extends SiUnit = SiUnit> {
  readonly value: number;
  readonly unit: Unit;
  /** Half width of the band that holds the true value in 95 % of cases; `null` as soon as one part is unknown. */
  readonly uncertainty: number | null;
  /** The same of the known parts alone: the uncertainty is not less. */
  readonly atLeast: number;
  readonly coverage: number;
  /** What makes up the uncertainty, greatest first, unknown parts before all. */
  readonly parts: readonly UncertaintyPart[];
}

/** What one kind of error does to a value. */
export interface UncertaintyPart {
  readonly name: string;
  /** One standard deviation of the value, in its unit; `null` when it is not known. */
  readonly standard: number | null;
  /** Correlation of the errors of two points as far apart as those measured: 0 each has its own, 1 they are the same. */
  readonly correlation: number;
  readonly note?: string;
}

/** How a value changes with the place of a vertex: its derivative along the axes of ECEF, in the value's unit a metre. */
export interface Sensitivity {
  readonly vertex: Vertex;
  readonly gradient: Vector;
}

/** Further errors that no vertex has: what a surface lacks between its points, say. */
export interface OwnError {
  readonly name: string;
  /** One standard deviation, in the value's unit; `null` when it is not known. */
  readonly standard: number | null;
  readonly note?: string;
}

/** What is known of a value besides its derivatives. */
export interface QuantityOptions extends WorthOptions {
  /** The value is formed of recorded coordinates: errors of the place derived from them have no part in it. */
  readonly ofRecords?: boolean;
  readonly own?: readonly OwnError[];
}

/** Share of an unknown error that may be left when it cancels, for its effect to count as bounded. */
const CANCELS = 0.01;

/**
 * A value with its uncertainty, by the law of propagation of uncertainty (GUM 5.2.2): correlated errors of one data set
 * cancel as far as the derivatives do; those of two data sets never.
 *
 * @param sensitivities derivatives by vertex; several lists where the value is the length of a vector that has no
 *   direction yet, one for each of its components
 */
export function quantity<Unit extends SiUnit>(
  value: number,
  unit: Unit,
  sensitivities: readonly (readonly Sensitivity[])[],
  options: QuantityOptions = {},
): Quantity<Unit> {
  const sums = new Map<string, Sum>();
  for (const list of sensitivities) addList(sums, list, options);
  const own: UncertaintyPart[] = (options.own ?? []).map((part) => ({ correlation: 0, ...part }));
  let variance = own.reduce((total, { standard }) => total + (standard ?? 0) ** 2, 0);
  let fourth = 0;
  const parts = [...sums].map(([name, sum]): UncertaintyPart => {
    const { known, correlation, note } = sum;
    if (known) {
      variance += sum.variance;
      fourth += sum.fourth;
    }
    return {
      ...{ name, standard: known ? Math.sqrt(sum.variance) : null, correlation },
      ...(note !== undefined && { note }),
    };
  });
  parts.push(...own);
  const weight = ({ standard }: UncertaintyPart) => standard ?? Number.POSITIVE_INFINITY;
  parts.sort((a, b) => (weight(a) === weight(b) ? 0 : weight(b) - weight(a)));
  const factor = coverageFactor(variance > 0 ? fourth / variance ** 2 : 0);
  const atLeast = factor * Math.sqrt(variance);
  const complete = parts.every(({ standard }) => standard !== null);
  return { value, unit, uncertainty: complete ? atLeast : null, atLeast, coverage: COVERAGE, parts };
}

/** The share of one kind of error. */
interface Sum {
  variance: number;
  /** Fourth cumulant. */
  fourth: number;
  known: boolean;
  correlation: number;
  note: string | undefined;
  /** The data set whose points share it, the first of several. */
  sharedBy: MeasuredCloud | undefined;
}

/** A derivative along the axes of its vertex. */
interface Member {
  readonly vertex: Vertex;
  readonly axes: Axes;
  readonly east: number;
  readonly north: number;
  readonly up: number;
}

function addList(sums: Map<string, Sum>, list: readonly Sensitivity[], options: QuantityOptions): void {
  const clouds = new Map<MeasuredCloud | undefined, Member[]>();
  for (const { vertex, gradient } of byRecord(list)) {
    const axes = axesAt(vertex);
    const [east, north, up] = [dot(gradient, axes.east), dot(gradient, axes.north), dot(gradient, axes.up)];
    const member = { vertex, axes, east, north, up };
    const members = clouds.get(vertex.cloud);
    if (members) members.push(member);
    else clouds.set(vertex.cloud, [member]);
  }
  for (const [cloud, members] of clouds) {
    const { ofRecords, ofPlaces, shared } = cloudErrors(cloud, options.precision);
    for (const member of members) {
      for (const error of member.vertex.record ? ofRecords : ofPlaces) {
        if (!options.ofRecords || error.of === "record") addOwn(sumOf(sums, error), error, member);
      }
    }
    if (options.ofRecords) continue;
    for (const error of shared) addShared(sumOf(sums, error), error, { cloud, members });
  }
}

/** One derivative for each record: one that was picked twice is one point. */
function byRecord(list: readonly Sensitivity[]): readonly Sensitivity[] {
  const [first, second] = list;
  if (list.length === 1 || (list.length === 2 && !isSameRecord(first.vertex, second.vertex))) return list;
  const found = new Map<unknown, { readonly vertex: Vertex; readonly gradient: [number, number, number] }>();
  for (const { vertex, gradient } of list) {
    const key = recordKey(vertex);
    const there = found.get(key);
    if (!there) found.set(key, { vertex, gradient: [gradient[0], gradient[1], gradient[2]] });
    else for (let axis = 0; axis < 3; axis++) there.gradient[axis] += gradient[axis];
  }
  return [...found.values()];
}

function sumOf(sums: Map<string, Sum>, { name, note }: PointError): Sum {
  let sum = sums.get(name);
  if (!sum) {
    sum = { variance: 0, fourth: 0, known: true, correlation: 0, note, sharedBy: undefined };
    sums.set(name, sum);
  } else if (note !== undefined && sum.note !== note && !sum.note?.split("; ").includes(note)) {
    // Of several data sets each has its own.
    sum.note = sum.note === undefined ? note : `${sum.note}; ${note}`;
  }
  return sum;
}

/** An error that each point has for itself. */
function addOwn(sum: Sum, { known, horizontal, up, shape }: PointError, member: Member): void {
  const east = (member.east * horizontal) ** 2;
  const north = (member.north * horizontal) ** 2;
  const above = (member.up * up) ** 2;
  sum.variance += east + north + above;
  if (shape === "rectangular") sum.fourth += RECTANGULAR_KURTOSIS * (east ** 2 + north ** 2 + above ** 2);
  sum.known &&= known;
}

/**
 * An error that the points of a data set share, with the covariance exp(−(d / reach)²/ 2) of two of them: formed of what a
 * common error leaves and of how far the covariances fall short of it, so that it cancels to the last digit.
 */
function addShared(
  sum: Sum,
  { known, reach, horizontal, up }: PointError,
  { cloud, members }: { readonly cloud: MeasuredCloud | undefined; readonly members: readonly Member[] },
): void {
  let [x, y, z, whole] = [0, 0, 0, 0];
  const weighted = members.map(({ axes, east, north, up: above }) => {
    const vector = combined(axes, east * horizontal, north * horizontal, above * up);
    x += vector[0];
    y += vector[1];
    z += vector[2];
    whole += Math.sqrt(east * east + north * north + above * above) * Math.max(horizontal, up);
    return vector;
  });
  const left = x * x + y * y + z * z;
  const { lack, correlation } = lackOf(
    members.map(({ vertex }) => vertex.ecef),
    weighted,
    reach,
  );
  sum.variance += Math.max(0, left - lack);
  // What points of two data sets have in common is nothing.
  const alone = sum.sharedBy === undefined || sum.sharedBy === cloud;
  sum.correlation = alone ? correlation : 0;
  sum.sharedBy ??= cloud;
  sum.known &&= known || Math.sqrt(left) <= CANCELS * whole;
}
