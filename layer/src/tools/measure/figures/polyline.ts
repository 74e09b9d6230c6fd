import type { Vertex } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity, type Sensitivity } from "../worth/quantity.js";
import { type Distance, type GridDistance, measureDistance } from "./distance.js";
import { levelSensitivity, lineOf, spaceSensitivity } from "./line.js";
import { tooFew } from "./refusals.js";

/** The lengths of a line of several parts. */
export interface Polyline {
  /** Each part, from vertex to vertex. */
  readonly parts: readonly Distance[];
  readonly space: Quantity<"m">;
  readonly geodesic: Quantity<"m">;
  readonly horizontal: Quantity<"m">;
  /** In the plane of the projection; undefined where one of the parts has no grid, or another one. */
  readonly grid?: Omit<GridDistance, "elevationFactor" | "combinedFactor"> | undefined;
  /** Sum of all rises and of all falls, metres, both from 0 on. */
  readonly ascent: number;
  readonly descent: number;
}

/**
 * Lengths of a line through vertices; the uncertainty of a sum is that of the whole, in which what two parts share at
 * the vertex between them is counted once.
 *
 * @param options.closed whether it leads back to the first vertex
 * @throws MeasureError MEASURE_VERTICES with fewer than two vertices
 */
export function measurePolyline(
  vertices: readonly Vertex[],
  options: WorthOptions & { closed?: boolean } = {},
): Polyline {
  if (vertices.length < 2) throw tooFew("a line", 2, vertices.length);
  const pairs = vertices.flatMap((vertex, i) => {
    const next = vertices[i + 1] ?? (options.closed ? vertices[0] : undefined);
    return next ? [[vertex, next] as const] : [];
  });
  const parts = pairs.map(([a, b]) => measureDistance(a, b, options));
  const lines = pairs.map(([a, b]) => lineOf(a, b));
  const sum = (of: (part: Distance) => number) => parts.reduce((total, part) => total + of(part), 0);
  const grids = parts.flatMap(({ grid }) => grid ?? []);
  const level = joined(lines.map((line) => levelSensitivity(line)));
  const gridLength = grids.reduce((total, { distance }) => total + distance.value, 0);
  const onEllipsoid = grids.reduce((total, grid) => total + grid.distance.value / grid.scaleFactor, 0);
  const common = grids.length === parts.length && grids.every(({ name }) => name === grids[0].name);
  return {
    parts,
    space: quantity(
      sum(({ space }) => space.value),
      "m",
      joined(lines.map((line) => spaceSensitivity(line))),
      options,
    ),
    geodesic: quantity(
      sum(({ geodesic }) => geodesic.value),
      "m",
      level,
      options,
    ),
    horizontal: quantity(
      sum(({ horizontal }) => horizontal.value),
      "m",
      level,
      options,
    ),
    ...(common && {
      grid: {
        name: grids[0].name,
        distance: quantity(gridLength, "m", level, { ...options, ofRecords: true }),
        scaleFactor: onEllipsoid > 0 ? gridLength / onEllipsoid : grids[0].scaleFactor,
      },
    }),
    ascent: sum(({ vertical }) => Math.max(0, vertical.value)),
    descent: sum(({ vertical }) => Math.max(0, -vertical.value)),
  };
}

/** Derivatives of a sum: those of its terms by vertex, and lists of their own where a term has no direction. */
function joined(terms: readonly Sensitivity[][][]): Sensitivity[][] {
  const whole = new Map<Vertex, [number, number, number]>();
  const apart: Sensitivity[][] = [];
  for (const lists of terms) {
    if (lists.length > 1) {
      apart.push(...lists);
      continue;
    }
    for (const { vertex, gradient } of lists[0]) {
      const [x, y, z] = whole.get(vertex) ?? [0, 0, 0];
      whole.set(vertex, [x + gradient[0], y + gradient[1], z + gradient[2]]);
    }
  }
  return [[...whole].map(([vertex, gradient]) => ({ vertex, gradient })), ...apart];
}
