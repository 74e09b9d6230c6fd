import type { Vector } from "@groma/georef";
import { MeasureError } from "../../../errors/index.js";
import { shown } from "../../../options/index.js";
import type { PointOrigin } from "../../../query/index.js";
import { Plan } from "../points/local-plan.js";
import { joined, readPoints } from "../points/read-points.js";
import { axesAt } from "../vertex/axes.js";
import type { MeasuredCloud, Vertex } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity } from "../worth/quantity.js";

/** Which points are the ground around a vertex. */
export interface GroundOptions extends WorthOptions {
  /** Metres around the vertex in which points of the ground count. Default: 3, and where a roof hides these 9, then 27. */
  readonly radius?: number | undefined;
  /** Default: 2, ground. */
  readonly classes?: ReadonlySet<number> | undefined;
  /** Stops it; what is asked for ends with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
}

const GROUND: ReadonlySet<number> = new Set([2]);

/** Radii that are tried, metres: below a building there is no ground. */
const RADII = [3, 9, 27];

/** Metres to each side of the vertex over which the plan is told. */
const STEP = 0.1;

/**
 * Height of a vertex above the ground of its own data set: above the plane of least squares through the points of the
 * ground around it, along the vertical of the data set's heights. How far these points are from the plane is part of its
 * worth.
 *
 * @throws MeasureError MEASURE_OPTION; MEASURE_GROUND where there are not three such points, MEASURE_DATASET for vertices of no data set;
 *   SourceError, FormatError, DecodeError; the signal's reason when aborted
 */
export async function measureHeightAboveGround(
  cloud: MeasuredCloud & PointOrigin,
  vertex: Vertex,
  { radius, classes = GROUND, signal, ...worth }: GroundOptions = {},
): Promise<Quantity<"m">> {
  if (radius !== undefined && !(radius > 0 && radius < Number.POSITIVE_INFINITY)) {
    throw new MeasureError({
      code: "MEASURE_OPTION",
      file: cloud.name,
      cause: `radius cannot be ${shown(radius)}`,
      fix: "give a number of metres above 0, or leave it out",
    });
  }
  const { source } = vertex;
  if (!source || vertex.cloud !== cloud) {
    throw new MeasureError({
      code: "MEASURE_DATASET",
      file: cloud.name,
      cause: "the vertex does not stand on this data set",
      fix: "give the data set that it stands on",
    });
  }
  for (const reach of radius === undefined ? RADII : [radius]) {
    const ground = levelPlane(await pointsWithin(cloud, source, reach, { classes, signal }), reach);
    if (!ground) continue;
    const note = `${ground.count} points within ${reach} m`;
    return quantity(
      source[2] * cloud.crs.verticalUnit.size - ground.height,
      "m",
      [[{ vertex, gradient: axesAt(vertex).up }]],
      { ...worth, ofRecords: true, own: [{ name: "ground", standard: ground.deviation, note }] },
    );
  }
  throw new MeasureError({
    code: "MEASURE_GROUND",
    file: cloud.name,
    cause: `there are not three points of the ground within ${radius ?? RADII[RADII.length - 1]} m of the vertex`,
    fix: "give a greater radius, or the classes that the ground has in this data set",
  });
}

/** Points around a place, in a plan about it. */
async function pointsWithin(
  cloud: MeasuredCloud & PointOrigin,
  [x, y, z]: Vector,
  radius: number,
  options: Pick<GroundOptions, "classes" | "signal">,
): Promise<Float64Array> {
  // About the vertex the plan has it in the middle; close to it, since beside a data set there may be no places.
  const step =
    STEP / cloud.crs.horizontalUnit.size / (cloud.crs.horizontalUnit.kind === "angular" ? 6.4e6 : 1);
  const plan = new Plan(cloud, [
    [x - step, y - step, z],
    [x + step, y + step, z],
  ]);
  const [eastX, northX, , eastY, northY] = plan.take(Float64Array.of(x + step, y, z, x, y + step, z));
  const reachX = (radius * step) / Math.hypot(eastX, northX);
  const reachY = (radius * step) / Math.hypot(eastY, northY);
  const around = [x - reachX, y - reachY, x + reachX, y + reachY] as const;
  return joined(await readPoints(cloud, around, { plan, ...options }));
}

/** The plane z = a + b x + c y of least squares: its height in the middle, and how far points are from it. */
function levelPlane(points: Float64Array, radius: number) {
  const near: number[] = [];
  for (let i = 0; i < points.length; i += 3) {
    if (Math.hypot(points[i], points[i + 1]) <= radius) near.push(i);
  }
  const count = near.length;
  if (count < 3) return undefined;
  const mean = [0, 1, 2].map((axis) => near.reduce((sum, i) => sum + points[i + axis], 0) / count);
  let [xx, xy, yy, xz, yz] = [0, 0, 0, 0, 0];
  for (const i of near) {
    const [dx, dy, dz] = [0, 1, 2].map((axis) => points[i + axis] - mean[axis]);
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    xz += dx * dz;
    yz += dy * dz;
  }
  const determinant = xx * yy - xy * xy;
  // On a line, or in one place.
  if (!(determinant > 1e-12 * (xx + yy) ** 2)) return undefined;
  const b = (xz * yy - yz * xy) / determinant;
  const c = (yz * xx - xz * xy) / determinant;
  const squares = near.reduce((sum, i) => {
    const [dx, dy, dz] = [0, 1, 2].map((axis) => points[i + axis] - mean[axis]);
    return sum + (dz - b * dx - c * dy) ** 2;
  }, 0);
  // How far the middle is from the points counts too: a plane is worth less beside them.
  const leverage =
    (mean[0] ** 2 * yy - 2 * mean[0] * mean[1] * xy + mean[1] ** 2 * xx) / determinant + 1 / count;
  return {
    count,
    height: mean[2] - b * mean[0] - c * mean[1],
    // Of three points none is left over to tell by.
    deviation: count > 3 ? Math.sqrt((squares / (count - 3)) * (1 + leverage)) : null,
  };
}
