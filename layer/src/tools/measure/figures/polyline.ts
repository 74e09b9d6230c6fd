import { commonGrid } from "../vertex/grid.js";
import type { Vertex } from "../vertex/vertex.js";
import type { Term } from "../worth/near-noise.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity, type Sensitivity } from "../worth/quantity.js";
import {
  commonHeights,
  type Distance,
  type GridDistance,
  gridFactor,
  heightDifference,
  lengthOf,
  measureDistance,
} from "./distance.js";
import {
  joined,
  type Line,
  levelTerm,
  lineOf,
  raised,
  scaled,
  spaceTerm,
  summed,
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
  const lines = pairs.map(([a, b]) => lineOf(a, b));
  const parts = once(() => lines.map(({ a, b }) => measureDistance(a, b, options)));
  const level = once(() => summed(lines.map((line) => levelTerm(line, options))));
  const sumOf = (of: (line: Line) => number, term: Term) =>
    lengthOf(
      lines.reduce((total, line) => total + of(line), 0),
      term,
      options,
    );
  const space = once(() =>
    sumOf((line) => line.space, summed(lines.map((line) => spaceTerm(line, options)))),
  );
  const geodesic = once(() => sumOf((line) => line.geodesic.distance, level()));
  const horizontal = once(() => sumOf((line) => line.geodesic.distance * raised(line), level()));
  const grid = once(() => gridLength(lines, options));
  const [ascent, descent] = ([1, -1] as const).map((sign) => once(() => climb(lines, sign, options)));
  // Each is worked out when it is asked for: of a perimeter most are not.
  return {
    get parts() {
      return parts();
    },
    get space() {
      return space();
    },
    get geodesic() {
      return geodesic();
    },
    get horizontal() {
      return horizontal();
    },
    get grid() {
      return grid();
    },
    get ascent() {
      return ascent();
    },
    get descent() {
      return descent();
    },
  };
}

function once<Value>(of: () => Value): () => Value {
  let known: { readonly value: Value } | undefined;
  return () => {
    known ??= { value: of() };
    return known.value;
  };
}

function gridLength(lines: readonly Line[], options: WorthOptions): Polyline["grid"] {
  const grid = commonGrid(lines.flatMap(({ a, b }) => [a, b]));
  if (!grid) return undefined;
  const lengths = lines.map(({ a, b }) => {
    const [from, to] = [a.source!, b.source!];
    return Math.hypot(to[0] - from[0], to[1] - from[1]) * grid.unit;
  });
  const length = lengths.reduce((sum, one) => sum + one, 0);
  const ofRecords = { ...options, ofRecords: true };
  const scaleFactor = once(() => {
    const factors = lines.map((line) => gridFactor(grid, line));
    const onEllipsoid = lengths.reduce((sum, one, i) => sum + one / factors[i], 0);
    return onEllipsoid > 0 ? length / onEllipsoid : factors[0];
  });
  return {
    name: grid.name,
    distance: lengthOf(length, summed(lines.map((line) => levelTerm(line, ofRecords))), ofRecords),
    get scaleFactor() {
      return scaleFactor();
    },
  };
}

/** The sum of all rises, or of all falls. @param sign 1: rises */
function climb(lines: readonly Line[], sign: 1 | -1, options: WorthOptions): Quantity<"m"> {
  let total = 0;
  let level: number | null = 0;
  let undecided = false;
  const terms: Sensitivity[][][] = [];
  for (const line of lines) {
    const { vertical } = heightDifference(line, options);
    const rise = sign * vertical.value;
    total += Math.max(0, rise);
    if (Math.abs(rise) <= vertical.atLeast) {
      undecided = true;
      level = vertical.uncertainty === null || level === null ? null : level + vertical.uncertainty / 2;
    } else if (rise > 0) {
      terms.push(
        verticalSensitivity(line).map((list) =>
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
