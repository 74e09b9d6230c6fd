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
  if (row.geometry.getType() === "Point") {
    row.geometry.setCoordinates(fitted(row, to));
    return;
  }
  change(row, (own) => {
    const last = own.length - 1;
    for (const at of isRing(row) && (index === 0 || index === last) ? [0, last] : [index]) {
      own[at] = fitted(row, to);
    }
  });
}

/** Puts a vertex into the side that begins at one. @returns the vertex, in the row as it is then */
export function insertVertex({ row, index }: Vertex, at: Coordinate): Vertex {
  const vertices = change(row, (own) => own.splice(index + 1, 0, fitted(row, at)));
  return { row: { ...row, vertices }, index: index + 1 };
}

/** Takes a vertex out of a line or ring. @returns whether enough are left for one; else nothing is done */
export function removeVertex({ row, index }: Vertex): boolean {
  const ring = isRing(row);
  if (!row.joined || row.vertices.length <= (ring ? 4 : 2)) return false;
  change(row, (own) => {
    const last = own.length - 1;
    own.splice(ring && index === last ? 0 : index, 1);
    if (ring && (index === 0 || index === last)) own[own.length - 1] = [...own[0]];
  });
  return true;
}

function isRing({ geometry }: VertexRow): boolean {
  return geometry.getType().includes("Polygon");
}

/** A coordinate with as many numbers as those of a row. */
function fitted({ geometry }: VertexRow, coordinate: Coordinate): Coordinate {
  return coordinate.slice(0, geometry.getStride() > 2 ? 3 : 2);
}

/** Changes the vertices of a row in its geometry. @returns them, as they are then */
function change({ geometry, path }: VertexRow, work: (own: Coordinate[]) => void): Coordinate[] {
  const all = geometry.getCoordinates() as Nested;
  const own = path.reduce<Nested>((nested, at) => (nested as Nested[])[at], all) as Coordinate[];
  work(own);
  geometry.setCoordinates(all as Coordinate[]);
  return own;
}
