import type { Coordinate } from "ol/coordinate.js";
import type Geometry from "ol/geom/Geometry.js";
import GeometryCollection from "ol/geom/GeometryCollection.js";
import SimpleGeometry from "ol/geom/SimpleGeometry.js";

/** Coordinates as geometries of OpenLayers nest them. */
type Nested = Coordinate | Nested[];

/** A row of vertices of a geometry. */
export interface VertexRow {
  readonly geometry: SimpleGeometry;
  /** Where in the geometry's nested coordinates the row stands. */
  readonly path: readonly number[];
  readonly vertices: readonly Coordinate[];
  /** Whether its vertices are joined by a line. */
  readonly joined: boolean;
}

/** A vertex of a geometry: its row, and its place there. */
export interface Vertex {
  readonly row: VertexRow;
  readonly index: number;
}

/** All rows of vertices of a geometry: each line, each ring, and the points. A circle has none. */
export function rowsOf(geometry: Geometry | undefined): VertexRow[] {
  if (geometry instanceof GeometryCollection) return geometry.getGeometriesArray().flatMap(rowsOf);
  if (!(geometry instanceof SimpleGeometry) || geometry.getType() === "Circle") return [];
  const joined = !geometry.getType().includes("Point");
  const rows: VertexRow[] = [];
  const walk = (nested: Nested, path: readonly number[]): void => {
    if (typeof nested[0] === "number")
      rows.push({ geometry, path, vertices: [nested as Coordinate], joined });
    else if (typeof (nested[0] as Nested | undefined)?.[0] === "number") {
      rows.push({ geometry, path, vertices: nested as Coordinate[], joined });
    } else for (const [at, part] of (nested as Nested[]).entries()) walk(part, [...path, at]);
  };
  walk(geometry.getCoordinates() as Nested, []);
  return rows;
}

/** Moves a vertex; that which closes a ring goes with the one that begins it. */
export function moveVertex({ row, index }: Vertex, to: Coordinate): void {
  const { geometry, path, vertices } = row;
  const all = geometry.getCoordinates() as Nested;
  const place = geometry.getStride() > 2 ? to : to.slice(0, 2);
  if (geometry.getType() === "Point") {
    geometry.setCoordinates(place);
    return;
  }
  const own = path.reduce<Nested>((nested, at) => (nested as Nested[])[at], all) as Coordinate[];
  const last = vertices.length - 1;
  const closed = geometry.getType().includes("Polygon") && (index === 0 || index === last);
  for (const at of closed ? [0, last] : [index]) own[at] = [...place];
  geometry.setCoordinates(all as Coordinate[]);
}
