import { MEASUREMENT_KINDS, type MeasurementKind } from "../measurement/measurement.js";

/** One figure of a geometry that another program wrote: positions as they stand there. */
export interface ForeignFigure {
  readonly kind: MeasurementKind;
  readonly positions: readonly unknown[];
}

/** Where the two halves of a line that was cut at the antimeridian meet, degrees of longitude and latitude. */
const SEAM = 1e-9;

/**
 * What can be measured of a geometry: a figure for each of its parts; lines that were cut at the antimeridian are put
 * together again.
 * @param named the kind that an attribute names, taken where the geometry has its shape and its number of vertices
 * @returns why nothing can be measured of it, in English, where nothing can
 */
export function figuresIn(
  geometry: Readonly<Record<string, unknown>>,
  named: MeasurementKind | undefined,
): readonly ForeignFigure[] | string {
  const { type, coordinates } = geometry;
  if (!Array.isArray(coordinates)) return "its geometry has no coordinates";
  const parts = partsOf(type, coordinates);
  if (!parts)
    return `its geometry is ${JSON.stringify(type)?.slice(0, 40)}, of which nothing can be measured`;
  const found = parts.map((part) => figureOf(part, named));
  return found.find((one) => typeof one === "string") ?? (found as ForeignFigure[]);
}

interface Part {
  readonly shape: "points" | "line" | "ring";
  readonly coordinates: unknown;
}

function partsOf(type: unknown, coordinates: readonly unknown[]): Part[] | undefined {
  const each = (shape: Part["shape"]) => coordinates.map((one) => ({ shape, coordinates: one }));
  switch (type) {
    case "Point":
      return [{ shape: "points", coordinates }];
    case "MultiPoint":
      return each("points");
    case "LineString":
      return [{ shape: "line", coordinates }];
    case "MultiLineString":
      return together(coordinates).map((one) => ({ shape: "line", coordinates: one }));
    case "Polygon":
      return [{ shape: "ring", coordinates }];
    case "MultiPolygon":
      return each("ring");
    default:
      return undefined;
  }
}

function figureOf({ shape, coordinates }: Part, named: MeasurementKind | undefined): ForeignFigure | string {
  if (!Array.isArray(coordinates)) return "its geometry has no coordinates";
  // Holes would have to be taken off the area.
  if (shape === "ring" && coordinates.length > 1) return "its polygon has holes";
  const positions =
    shape === "points" ? [coordinates] : shape === "line" ? coordinates : openRing(coordinates[0]);
  const fits = (kind: MeasurementKind) => {
    const { least, most } = MEASUREMENT_KINDS[kind];
    return MEASUREMENT_KINDS[kind].shape === shape && positions.length >= least && positions.length <= most;
  };
  if (named && fits(named)) return { kind: named, positions };
  const line = positions.length === 2 ? "distance" : "polyline";
  const kind = shape === "points" ? "point" : shape === "line" ? line : "area";
  return fits(kind) ? { kind, positions } : "its geometry has too few positions";
}

/** Positions of a ring, without the first one repeated at its end. */
function openRing(ring: unknown): readonly unknown[] {
  if (!Array.isArray(ring)) return [];
  const [first, last] = [ring[0], ring[ring.length - 1]];
  return ring.length > 1 && JSON.stringify(first) === JSON.stringify(last) ? ring.slice(0, -1) : ring;
}

/** Lines that go on where the one before ends at the antimeridian, as one, without the places of the cut. */
function together(lines: readonly unknown[]): unknown[] {
  const joined: unknown[] = [];
  for (const line of lines) {
    const before = joined[joined.length - 1];
    const meets = isLine(before) && isLine(line) && meetAtSeam(before[before.length - 1], line[0]);
    if (meets) joined[joined.length - 1] = [...before.slice(0, -1), ...line.slice(1)];
    else joined.push(line);
  }
  return joined;
}

function isLine(line: unknown): line is unknown[] {
  return Array.isArray(line) && line.length > 1;
}

function meetAtSeam(a: unknown, b: unknown): boolean {
  if (!Array.isArray(a) || !Array.isArray(b)) return false;
  return (
    [a, b].every(([longitude]) => Math.abs(Math.abs(longitude) - 180) < SEAM) &&
    Math.sign(a[0]) === -Math.sign(b[0]) &&
    Math.abs(a[1] - b[1]) < SEAM
  );
}
