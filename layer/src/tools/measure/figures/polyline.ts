import type { Vertex } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity, type Sensitivity } from "../worth/quantity.js";
import { commonHeights, type Distance, type GridDistance, measureDistance } from "./distance.js";
import {
  joined,
  type Line,
  levelSensitivity,
  lineOf,
  scaled,
  spaceSensitivity,
  verticalSensitivity,
} from "./line.js";
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
  /**
   * Sum of all rises and of all falls, both from 0 on. A part that may rise as well as fall, for all that is known, counts
   * with the whole of its uncertainty: many of them add up to a rise that is none.
   */
  readonly ascent: Quantity<"m">;
  readonly descent: Quantity<"m">;
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
    ascent: climb(parts, lines, 1, options),
    descent: climb(parts, lines, -1, options),
  };
}

/** The sum of all rises, or of all falls. @param sign 1: rises */
function climb(
  parts: readonly Distance[],
  lines: readonly Line[],
  sign: 1 | -1,
  options: WorthOptions,
): Quantity<"m"> {
  let total = 0;
  let level: number | null = 0;
  let undecided = false;
  const terms: Sensitivity[][][] = [];
  for (const [i, { vertical }] of parts.entries()) {
    const rise = sign * vertical.value;
    total += Math.max(0, rise);
    if (Math.abs(rise) <= vertical.atLeast) {
      undecided = true;
      level = vertical.uncertainty === null || level === null ? null : level + vertical.uncertainty / 2;
    } else if (rise > 0) {
      terms.push(
        verticalSensitivity(lines[i]).map((list) =>
          list.map(({ vertex, gradient }) => ({ vertex, gradient: scaled(gradient, sign) })),
        ),
      );
    }
  }
  const note = "parts that may rise or fall";
  return quantity(total, "m", joined(terms), {
    ...options,
    ofRecords: lines.every(({ a, b }) => commonHeights(a, b) !== undefined),
    own: undecided ? [{ name: "level parts", standard: level, note }] : [],
  });
}
