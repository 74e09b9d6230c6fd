import { cross, fitPlane, geodesicPolygon, planarArea, turnOut, type Vector } from "@groma/georef";
import { axesAt, combined } from "../vertex/axes.js";
import { commonGrid, scaleFactorAt } from "../vertex/grid.js";
import type { Vertex } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity, type Sensitivity } from "../worth/quantity.js";
import { scaled } from "./line.js";
import { type BestPlane, bestPlane } from "./plane.js";
import { measurePolyline, type Polyline } from "./polyline.js";
import { checkedRing, frameOf, inFrame } from "./ring.js";

/** How large a polygon is. All areas are positive, whatever the order of the vertices. */
export interface Area {
  /** On the ellipsoid of WGS 84, edges geodesics. */
  readonly geodesic: Quantity<"m²">;
  /** In the plane that fits the vertices best, through space. */
  readonly planar: Quantity<"m²">;
  /** That plane; undefined where the vertices lie on a line. */
  readonly plane?: Pick<BestPlane, "slope" | "aspect" | "deviation"> | undefined;
  /** In the plane of the projection, edges straight there; undefined without a common grid. */
  readonly grid?:
    | { readonly name: string; readonly area: Quantity<"m²">; readonly scaleFactor: number }
    | undefined;
  /** Lengths of the ring, back to the first vertex. */
  readonly perimeter: Polyline;
}

/**
 * Areas and perimeter of a polygon. One around a pole or across the antimeridian included; of the two sides of a ring
 * the smaller counts (Karney 2013).
 *
 * @throws MeasureError MEASURE_VERTICES with fewer than three vertices, MEASURE_CROSSING for a ring that crosses itself
 */
export function measureArea(vertices: readonly Vertex[], options: WorthOptions = {}): Area {
  const ring = checkedRing(vertices);
  const grid = commonGrid(ring);
  return {
    geodesic: groundArea(ring, options),
    ...planar(ring, options),
    ...(grid && {
      grid: gridArea(ring, grid, options),
    }),
    perimeter: measurePolyline(ring, { ...options, closed: true }),
  };
}

/** The geodesic area alone. @throws MeasureError as {@link measureArea} */
export function measureGroundArea(vertices: readonly Vertex[], options: WorthOptions): Quantity<"m²"> {
  return groundArea(checkedRing(vertices), options);
}

function groundArea(ring: readonly Vertex[], options: WorthOptions): Quantity<"m²"> {
  const { area } = geodesicPolygon(ring.flatMap(({ longitude, latitude }) => [longitude, latitude]));
  return quantity(Math.abs(area), "m²", [levelGradients(ring, Math.sign(area))], options);
}

function gridArea(
  ring: readonly Vertex[],
  grid: NonNullable<ReturnType<typeof commonGrid>>,
  options: WorthOptions,
): NonNullable<Area["grid"]> {
  const signed = planarArea(ring.flatMap(({ source }) => [source![0], source![1]])) * grid.unit ** 2;
  const middle = [0, 1].map((axis) => ring.reduce((sum, { source }) => sum + source![axis], 0) / ring.length);
  const scaleFactor = Math.sqrt(scaleFactorAt(grid, middle, 0) * scaleFactorAt(grid, middle, Math.PI / 2));
  const gradients = levelGradients(ring, Math.sign(signed), scaleFactor ** 2);
  return {
    name: grid.name,
    area: quantity(Math.abs(signed), "m²", [gradients], { ...options, ofRecords: true }),
    scaleFactor,
  };
}

/** Area in the plane of best fit: half the sum of the cross products, along its normal. */
function planar(ring: readonly Vertex[], options: WorthOptions): Pick<Area, "planar" | "plane"> {
  const plane = bestPlane(ring, options);
  const frame = frameOf(ring);
  const points = inFrame(ring, frame);
  const { normal } = fitPlane(points);
  const sum = [0, 0, 0];
  const at = (i: number): Vector => {
    const from = 3 * (i % ring.length);
    return [points[from], points[from + 1], points[from + 2]];
  };
  for (let i = 0; i < ring.length; i++) {
    for (const [axis, part] of cross(at(i), at(i + 1)).entries()) sum[axis] += part / 2;
  }
  const signed = sum[0] * normal[0] + sum[1] * normal[1] + sum[2] * normal[2];
  const up: Vector = scaled([normal[0], normal[1], normal[2]], signed < 0 ? -1 : 1);
  const gradients = ring.map((vertex, i): Sensitivity => {
    const [next, before] = [at(i + 1), at(i + ring.length - 1)];
    const across = cross([next[0] - before[0], next[1] - before[1], next[2] - before[2]], up);
    return { vertex, gradient: turnOut(frame, across[0] / 2, across[1] / 2, across[2] / 2) };
  });
  return {
    planar: quantity(Math.abs(signed), "m²", [gradients], options),
    ...(plane && { plane }),
  };
}

/**
 * Derivatives of an area on the ground: half the chord between the neighbours, turned outwards, in the level of each
 * vertex. @param sign 1 for vertices that run counter-clockwise
 */
function levelGradients(ring: readonly Vertex[], sign: number, factor = 1): Sensitivity[] {
  const count = ring.length;
  return ring.map((vertex, i) => {
    const [next, before] = [ring[(i + 1) % count].ecef, ring[(i + count - 1) % count].ecef];
    const axes = axesAt(vertex);
    const chord: Vector = [next[0] - before[0], next[1] - before[1], next[2] - before[2]];
    const along = (axis: Vector) => chord[0] * axis[0] + chord[1] * axis[1] + chord[2] * axis[2];
    const half = (sign * factor) / 2;
    return { vertex, gradient: combined(axes, half * along(axes.north), -half * along(axes.east), 0) };
  });
}
