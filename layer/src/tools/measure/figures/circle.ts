import { cross, dot, type Frame, turnOut, type Vector } from "@groma/georef";
import { ecefVertex, type Vertex } from "../vertex/vertex.js";
import { acrossError, lengthTerm, spreadOf } from "../worth/near-noise.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type OwnError, type Quantity, quantity, type Sensitivity } from "../worth/quantity.js";
import { lengthOf } from "./distance.js";
import { lineOf, scaled, spaceTerm } from "./line.js";
import { collinear } from "./refusals.js";
import { frameOf, inFrame } from "./ring.js";

/** The circle through three vertices, and the arc from the first through the second to the third. */
export interface Circle {
  readonly centre: Vertex;
  /** Unit vector of ECEF across its plane, the side from which the arc runs counter-clockwise. */
  readonly normal: Vector;
  readonly radius: Quantity<"m">;
  readonly circumference: Quantity<"m">;
  readonly area: Quantity<"m²">;
  readonly arc: {
    readonly length: Quantity<"m">;
    /** 0 … 2π. */
    readonly angle: Quantity<"rad">;
    /** From end to end. */
    readonly chord: Quantity<"m">;
    /** From the middle of the chord to that of the arc (rise of an arch, mid-ordinate of a curve). */
    readonly sagitta: Quantity<"m">;
  };
}

/** Sine of the angle between two sides below which three points are one line. */
const ON_A_LINE = 1e-9;

/** Share of an arc's rise that its band takes: below, radii are linear in it; above, there may be no circle. */
const [SLIGHT, FLAT] = [0.02, 0.8];

/**
 * A circle and an arc in space.
 * @throws MeasureError MEASURE_COLLINEAR for vertices on a line, two in one place included
 */
export function measureCircle(a: Vertex, b: Vertex, c: Vertex, options: WorthOptions = {}): Circle {
  const vertices = [a, b, c];
  const frame = frameOf(vertices);
  const points = inFrame(vertices, frame);
  const found = circleThrough(points);
  if (!found) throw collinear("a circle");
  const { centre, normal, chord } = found;
  const [x, y, z] = turnOut(frame, ...centre);
  const { origin } = frame;

  const sensitivities = (of: (circle: PlaneCircle) => number) =>
    sensitivitiesIn({ vertices, points, frame, found }, of);
  const sagittaOf = (circle: PlaneCircle) => 2 * circle.radius * Math.sin(circle.angle / 4) ** 2;
  const rise = sensitivities(sagittaOf);
  const sideways = outOfPlane(rise, turnOut(frame, ...normal));
  const both = () => [rise, sideways];
  const bent = lengthTerm(sagittaOf(found), rise, both, options);
  const isFlat = bent.sensitivities.length > 1;
  const spread = isFlat || bent.across > 0 ? spreadOf(both(), options) : 0;
  /** Radii grow without bound as the rise of the arc goes to 0. */
  const widened = (linear: number, power: number): OwnError[] => {
    const share = (1.96 * Math.sqrt(spreadOf([rise], options))) / sagittaOf(found);
    if (share < SLIGHT) return [];
    const standard = share < FLAT ? linear * Math.sqrt((1 - share) ** (-2 * power) - 1) : null;
    return [{ name: "flatness", standard, note: "the arc rises by little more than its points are off" }];
  };
  const told = <Unit extends "m" | "m²" | "rad">(
    unit: Unit,
    of: (circle: PlaneCircle) => number,
    own: (linear: number) => OwnError[],
  ) => {
    const lists = [sensitivities(of)];
    return quantity(of(found), unit, lists, { ...options, own: own(Math.sqrt(spreadOf(lists, options))) });
  };
  const flatAngle = () => {
    const lists = both().map((list) => scaledAll(list, 8 / chord));
    return quantity(found.angle, "rad", lists, options);
  };
  const bentAngle = () =>
    told(
      "rad",
      (circle) => circle.angle,
      () => acrossError((8 / chord) * bent.across),
    );
  return {
    centre: ecefVertex([origin[0] + x, origin[1] + y, origin[2] + z]),
    normal: turnOut(frame, ...normal),
    radius: told(
      "m",
      (circle) => circle.radius,
      (linear) => widened(linear, 1),
    ),
    circumference: told(
      "m",
      (circle) => 2 * Math.PI * circle.radius,
      (linear) => widened(linear, 1),
    ),
    area: told(
      "m²",
      (circle) => Math.PI * circle.radius ** 2,
      (linear) => widened(linear, 2),
    ),
    arc: {
      length: told(
        "m",
        (circle) => circle.radius * circle.angle,
        () => acrossError(((8 / 3) * spread) / chord),
      ),
      angle: isFlat ? flatAngle() : bentAngle(),
      chord: lengthOf(chord, spaceTerm(lineOf(a, c), options), options),
      sagitta: lengthOf(sagittaOf(found), bent, options),
    },
  };
}

/** Three vertices, their places in a frame (x, y, z of each, metres), and the circle through them. */
interface FoundCircle {
  readonly vertices: readonly Vertex[];
  readonly points: Float64Array;
  readonly frame: Frame;
  readonly found: PlaneCircle;
}

/** Derivatives of what is told of a circle, from a step much greater than rounding and much less than its size. */
function sensitivitiesIn(
  { vertices, points, frame, found }: FoundCircle,
  of: (circle: PlaneCircle) => number,
): Sensitivity[] {
  const step = 1e-6 * found.chord;
  return vertices.map((vertex, i) => {
    const along = [0, 1, 2].map((axis) => {
      const [ahead, behind] = [1, -1].map((sign) => {
        const moved = Float64Array.from(points);
        moved[3 * i + axis] += sign * step;
        return of(circleThrough(moved) ?? found);
      });
      return (ahead - behind) / (2 * step);
    });
    return { vertex, gradient: turnOut(frame, along[0], along[1], along[2]) };
  });
}

/** Derivatives of an arc's rise out of the plane of its three points, in which it bends as easily where it is nearly straight. */
function outOfPlane(rise: readonly Sensitivity[], out: Vector): Sensitivity[] {
  const towards = scaled(rise[1].gradient, 1 / Math.hypot(...rise[1].gradient));
  return rise.map(({ vertex, gradient }) => ({ vertex, gradient: scaled(out, dot(gradient, towards)) }));
}

function scaledAll(list: readonly Sensitivity[], factor: number): Sensitivity[] {
  return list.map(({ vertex, gradient }) => ({ vertex, gradient: scaled(gradient, factor) }));
}

/** A circle in the frame of its three points, metres. */
interface PlaneCircle {
  readonly centre: Vector;
  readonly normal: Vector;
  readonly radius: number;
  readonly angle: number;
  readonly chord: number;
}

/** @param p x, y, z of three points, metres */
function circleThrough(p: Float64Array): PlaneCircle | undefined {
  const u: Vector = [p[3] - p[0], p[4] - p[1], p[5] - p[2]];
  const v: Vector = [p[6] - p[0], p[7] - p[1], p[8] - p[2]];
  const w: Vector = [p[6] - p[3], p[7] - p[4], p[8] - p[5]];
  const across = cross(u, v);
  const [uu, vv, twice] = [dot(u, u), dot(v, v), Math.hypot(...across)];
  const ww = dot(w, w);
  // Against the two longest sides: a point beside one of two others is as good as on their line.
  const longest = Math.sqrt(Math.max(uu * vv, vv * ww, uu * ww));
  if (!(twice > ON_A_LINE * longest)) return undefined;
  // Circumcentre from the first point: (|u|² v − |v|² u) × (u × v) / 2 |u × v|², up to its sign.
  const mixed: Vector = [uu * v[0] - vv * u[0], uu * v[1] - vv * u[1], uu * v[2] - vv * u[2]];
  const to = cross(mixed, across).map((part) => part / (2 * twice ** 2));
  const radius = Math.sqrt(uu * vv * ww) / (2 * twice);
  // The angle at the second point over the chord is half of what the arc leaves of the full turn.
  const inscribed = Math.atan2(twice, -dot(u, w));
  return {
    centre: [p[0] + to[0], p[1] + to[1], p[2] + to[2]],
    normal: [across[0] / twice, across[1] / twice, across[2] / twice],
    radius,
    angle: 2 * Math.PI - 2 * inscribed,
    chord: Math.sqrt(vv),
  };
}
