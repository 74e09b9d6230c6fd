import { eastNorthUp, pointIn, type Vector } from "@groma/georef";
import { axesAt } from "../vertex/axes.js";
import type { Vertex, VertexRecord } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity } from "../worth/quantity.js";
import { measureHeight } from "./distance.js";
import { scaled } from "./line.js";

/** Where one vertex is, in every frame. */
export interface ReadOut {
  readonly record: VertexRecord | undefined;
  /** x, y, z in the units of `crs`; undefined for places of no data set. */
  readonly source: Vector | undefined;
  /** Name of the source's coordinate system. */
  readonly crs: string | undefined;
  /** Of WGS 84. Uncertainties of both are those along the ground over the earth's radius. */
  readonly longitude: Quantity<"rad">;
  readonly latitude: Quantity<"rad">;
  /** Above the ellipsoid. */
  readonly height: Quantity<"m">;
  /** EPSG:4978, metres. */
  readonly ecef: Vector;
  /** East, north and up of the origin, metres; only where one is given. */
  readonly local: readonly [Quantity<"m">, Quantity<"m">, Quantity<"m">] | undefined;
}

/** @param options.origin where the local axes begin; their directions are its own */
export function readOut(vertex: Vertex, options: WorthOptions & { origin?: Vertex } = {}): ReadOut {
  const { cloud, source, record, ecef, longitude, latitude } = vertex;
  const { east, north } = axesAt(vertex);
  const radius = Math.hypot(...ecef);
  const fromAxis = Math.hypot(ecef[0], ecef[1]);
  const angle = (value: number, along: Vector, reach: number) =>
    // On the axis a longitude may be any.
    quantity(value, "rad", [[{ vertex, gradient: scaled(along, 1 / Math.max(reach, 1)) }]], options);
  return {
    ...{ record, source, ecef, crs: cloud?.crs.name },
    longitude: angle(longitude, east, fromAxis),
    latitude: angle(latitude, north, radius),
    height: measureHeight(vertex, options),
    local: options.origin && localPlace(vertex, options.origin, options),
  };
}

function localPlace(vertex: Vertex, origin: Vertex, options: WorthOptions): NonNullable<ReadOut["local"]> {
  const { east, north, up } = axesAt(origin);
  const [e, n, u] = pointIn(eastNorthUp(origin.ecef), ...vertex.ecef);
  const along = (value: number, gradient: Vector) =>
    quantity(
      value,
      "m",
      [
        [
          { vertex, gradient },
          { vertex: origin, gradient: scaled(gradient, -1) },
        ],
      ],
      options,
    );
  return [along(e, east), along(n, north), along(u, up)];
}
