import { type Alignment, noAlignment, theOne } from "./alignment.js";
import { CurveLine } from "./curves.js";

/** A vertex of a polyline, and how the stretch to the next one bends (DXF group 42: tangent of a quarter of its angle). */
interface Vertex {
  x: number;
  y: number;
  bulge: number;
}

interface Polyline {
  /** Of its layer. */
  name: string;
  closed: boolean;
  readonly vertices: Vertex[];
}

/**
 * Reads a polyline of a DXF file (ASCII; LWPOLYLINE, or POLYLINE with vertices): x and y, arcs by their bulges. DXF knows no
 * chainage: it begins with 0.
 *
 * @param layer that the polyline is on; undefined where the file has one polyline alone
 * @param file for errors
 * @throws FormatError FORMAT_ALIGNMENT where it is no such file, or has no such polyline
 */
export function readDxfLine(text: string, layer: string | undefined, file: string): Alignment {
  if (text.startsWith("AutoCAD Binary DXF"))
    throw noAlignment(file, "it is a binary DXF file", "Save it as ASCII DXF");
  const { name, vertices, closed } = theOne(polylines(text), layer, file);
  const [first, ...others] = vertices;
  if (!first || others.length === 0 || !vertices.every(({ x, y, bulge }) => Number.isFinite(x + y + bulge)))
    throw noAlignment(
      file,
      "its polyline has fewer than two vertices, or one that is no place",
      "Draw it again",
    );
  const line = new CurveLine([first.x, first.y]);
  let { bulge } = first;
  for (const vertex of closed ? [...others, first] : others) {
    bend(line, vertex, bulge);
    ({ bulge } = vertex);
  }
  return { name, vertices: line.vertices, lengths: line.lengths, start: 0, equations: [], unit: undefined };
}

/** Adds a stretch: straight, or the arc whose bulge is given, to the left positive. */
function bend(line: CurveLine, { x, y }: Vertex, bulge: number): void {
  const [ax, ay] = line.end;
  const [ux, uy] = [x - ax, y - ay];
  if (bulge === 0 || (ux === 0 && uy === 0)) {
    line.lineTo([x, y]);
    return;
  }
  // The centre lies on the bisector of the chord, at (1 - b²) / (4 b) of the chord's length to its left.
  const away = (1 - bulge * bulge) / (4 * bulge);
  line.arcTo([x, y], [(ax + x) / 2 - away * uy, (ay + y) / 2 + away * ux], 4 * Math.atan(bulge));
}

/** Polylines of the ENTITIES section, with at least one vertex. */
function polylines(text: string): Polyline[] {
  const found: Polyline[] = [];
  const lines = text.split(/\r\n|\r|\n/);
  let section = "";
  let entity = "";
  let current: Polyline | undefined;
  let vertex: Vertex | undefined;
  for (let at = 0; at + 1 < lines.length; at += 2) {
    const code = Number(lines[at]);
    const value = lines[at + 1].trim();
    if (code === 0) {
      if (value !== "VERTEX") current = undefined;
      if (value === "LWPOLYLINE" || value === "POLYLINE") {
        current = { name: "", closed: false, vertices: [] };
        if (section === "ENTITIES") found.push(current);
      } else if (value === "VERTEX") {
        current = found[found.length - 1];
        vertex = { x: Number.NaN, y: Number.NaN, bulge: 0 };
        if (entity === "POLYLINE" || entity === "VERTEX") current?.vertices.push(vertex);
      }
      entity = value;
    } else if (code === 2 && entity === "SECTION") section = value;
    else if (current && code === 8 && entity !== "VERTEX") current.name = value;
    else if (current && code === 70 && entity !== "VERTEX") current.closed = (Number(value) & 1) !== 0;
    else if (entity === "LWPOLYLINE" && current && code === 10) {
      vertex = { x: Number(value), y: Number.NaN, bulge: 0 };
      current.vertices.push(vertex);
    } else if (entity === "VERTEX" && vertex && code === 10) vertex.x = Number(value);
    else if ((entity === "VERTEX" || entity === "LWPOLYLINE") && vertex) {
      if (code === 20) vertex.y = Number(value);
      if (code === 42) vertex.bulge = Number(value);
    }
  }
  return found.filter(({ vertices }) => vertices.length > 0);
}
