import { type Alignment, noAlignment, theOne } from "./alignment.js";
import { CurveLine } from "./curves.js";

/** A vertex of a polyline, and how the stretch to the next one bends (DXF group 42: tangent of a quarter of its angle). */
interface Vertex {
  readonly x: number;
  readonly y: number;
  readonly bulge: number;
}

interface Polyline {
  /** Of its layer. */
  readonly name: string;
  readonly closed: boolean;
  /** How its own plane lies to that of x and y: on it, on it and seen from below, or otherwise (group 210). */
  readonly plane: "above" | "below" | "tilted";
  readonly vertices: Vertex[];
}

/** Pairs of codes and values, as the entities of a file have them. */
type Groups = readonly (readonly [code: number, value: string])[];

/** An entity of a file, or the begin of a section. */
interface Entity {
  readonly type: string;
  readonly groups: Groups;
}

/** Bits of group 70 (DXF reference: POLYLINE, VERTEX). */
const CLOSED = 1;
const NO_LINE = 16 | 64; // a mesh of polygons, of faces
const SPLINE_FRAME = 16; // a control point of a fitted curve, which is not drawn
const IN_SPACE = 8; // vertices of a polyline in space stand in the world, whatever its plane

/**
 * Metres in the units of `$INSUNITS` that a drawing in map coordinates bears on purpose: foot, metre, kilometre, yard, US survey
 * foot. Inches and millimetres are those of templates, whatever is drawn on them.
 */
const UNITS: ReadonlyMap<string, number> = new Map([
  ["2", 0.3048],
  ["6", 1],
  ["7", 1000],
  ["10", 0.9144],
  ["21", 1200 / 3937],
]);

/**
 * Reads a polyline of a DXF file (ASCII; LWPOLYLINE, or POLYLINE with vertices) in model space: x and y of the world, arcs by their
 * bulges, of fitted curves the vertices that are drawn; its unit by `$INSUNITS`, unless that is inches or millimetres, which
 * templates bear. DXF knows no chainage: it begins with 0.
 *
 * @param layer that the polyline is on; undefined where the file has one polyline alone
 * @param file for errors
 * @throws FormatError FORMAT_ALIGNMENT where it is no such file, has no such polyline, or one in a tilted plane
 */
export function readDxfLine(text: string, layer: string | undefined, file: string): Alignment {
  if (text.startsWith("AutoCAD Binary DXF"))
    throw noAlignment(file, "it is a binary DXF file", "Save it as ASCII DXF");
  const without = "give a file with a polyline; lines, arcs and splines have to be joined to one first";
  const { lines, unit } = readDrawing(text);
  const { name, vertices, closed, plane } = theOne(lines, layer, file, without);
  const places = vertices.every(({ x, y, bulge }) => Number.isFinite(x + y + bulge));
  if (vertices.length < 2 || !places)
    throw noAlignment(
      file,
      "its polyline has fewer than two vertices, or one that is no place",
      "Draw it again",
    );
  if (plane === "tilted")
    throw noAlignment(file, "its polyline lies in a tilted plane", "Draw it in the plane of x and y");
  const [first, ...others] = plane === "below" ? vertices.map(mirrored) : vertices;
  const line = new CurveLine([first.x, first.y]);
  let { bulge } = first;
  for (const vertex of closed ? [...others, first] : others) {
    bend(line, vertex, bulge);
    ({ bulge } = vertex);
  }
  const { lengths, headings } = line;
  return { name, vertices: line.vertices, lengths, headings, start: 0, equations: [], unit };
}

/** From a plane that is seen from below to that of the world (DXF reference, arbitrary axis algorithm). */
function mirrored({ x, y, bulge }: Vertex): Vertex {
  return { x: -x, y, bulge: -bulge };
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

/** Polylines of the model space, with at least one vertex, and the unit that the header names, metres. */
function readDrawing(text: string): { readonly lines: Polyline[]; readonly unit: number | undefined } {
  const found: Polyline[] = [];
  let unit: number | undefined;
  let section = "";
  let current: Polyline | undefined;
  for (const { type, groups } of entities(text)) {
    if (type === "SECTION") section = textOf(groups, 2) ?? "";
    if (section === "HEADER") unit ??= unitOf(groups);
    if (section !== "ENTITIES") continue;
    if (type === "VERTEX") {
      if (current && (flags(groups) & SPLINE_FRAME) === 0) current.vertices.push(...verticesOf(groups));
      continue;
    }
    current = type === "POLYLINE" || type === "LWPOLYLINE" ? polylineOf(type, groups) : undefined;
    if (current) found.push(current);
  }
  return { lines: found.filter(({ vertices }) => vertices.length > 0), unit };
}

/** The header's `$INSUNITS`, whose value follows its name. */
function unitOf(header: Groups): number | undefined {
  const at = header.findIndex(([code, value]) => code === 9 && value === "$INSUNITS");
  return UNITS.get(header[at + 1]?.[1] ?? "");
}

/** A polyline, with its vertices where these stand in it; undefined for one on a sheet, or for a mesh. */
function polylineOf(type: "POLYLINE" | "LWPOLYLINE", groups: Groups): Polyline | undefined {
  const own = type === "POLYLINE";
  const onSheet = Number(textOf(groups, 67) ?? 0) === 1;
  if (onSheet || (own && (flags(groups) & NO_LINE) !== 0)) return undefined;
  const inSpace = own && (flags(groups) & IN_SPACE) !== 0;
  return {
    name: textOf(groups, 8) ?? "",
    closed: (flags(groups) & CLOSED) !== 0,
    plane: inSpace ? "above" : planeOf(groups),
    vertices: own ? [] : verticesOf(groups),
  };
}

/** How the plane of an entity lies, by its normal. */
function planeOf(groups: Groups): Polyline["plane"] {
  const [x, y, z] = [210, 220, 230].map((code) => Number(textOf(groups, code) ?? (code === 230 ? 1 : 0)));
  if (Math.hypot(x, y) > 1e-9 * Math.abs(z)) return "tilted";
  return z < 0 ? "below" : "above";
}

/** The vertices that stand in an entity, each begun by its x. */
function verticesOf(groups: Groups): Vertex[] {
  const found: { x: number; y: number; bulge: number }[] = [];
  for (const [code, value] of groups) {
    const last = found[found.length - 1];
    if (code === 10) found.push({ x: Number(value), y: Number.NaN, bulge: 0 });
    else if (code === 20 && last) last.y = Number(value);
    else if (code === 42 && last) last.bulge = Number(value);
  }
  return found;
}

function textOf(groups: Groups, wanted: number): string | undefined {
  return groups.find(([code]) => code === wanted)?.[1];
}

function flags(groups: Groups): number {
  return Number(textOf(groups, 70) ?? 0);
}

function* entities(text: string): Generator<Entity> {
  const lines = text.split(/\r\n|\r|\n/);
  let groups: [number, string][] = [];
  let type = "";
  for (let at = 0; at + 1 < lines.length; at += 2) {
    const code = Number(lines[at]);
    const value = lines[at + 1].trim();
    if (code !== 0) {
      groups.push([code, value]);
      continue;
    }
    yield { type, groups };
    [type, groups] = [value, []];
  }
  yield { type, groups };
}
