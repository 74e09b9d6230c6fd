import { planarArea } from "@groma/georef";
import type { Vertex } from "../vertex/vertex.js";

/** Longitude, latitude in degrees, height above the ellipsoid in metres. */
export type Position = readonly [number, number, number];

/** The geometries of RFC 7946 that measurements are written as. */
export type Geometry =
  | { readonly type: "Point"; readonly coordinates: Position }
  | { readonly type: "MultiPoint" | "LineString"; readonly coordinates: readonly Position[] }
  | { readonly type: "MultiLineString" | "Polygon"; readonly coordinates: readonly (readonly Position[])[] }
  | { readonly type: "MultiPolygon"; readonly coordinates: readonly (readonly (readonly Position[])[])[] };

const DEGREE = Math.PI / 180;

/** A position of GeoJSON: longitude and latitude in degrees, height above WGS 84 in metres. */
export function positionOf({ longitude, latitude, height }: Vertex): Position {
  return [longitude / DEGREE, latitude / DEGREE, height];
}

/** Vertices as a geometry; lines and rings across the antimeridian are cut there (RFC 7946, 3.1.9). */
export function geometryOf(vertices: readonly Vertex[], shape: "points" | "line" | "ring"): Geometry {
  const positions = vertices.map(positionOf);
  if (positions.length === 1) return { type: "Point", coordinates: positions[0] };
  if (shape === "points") return { type: "MultiPoint", coordinates: positions };
  return shape === "line" ? lineGeometry(positions) : ringGeometry(positions);
}

/** Longitudes brought together, so that neighbours are less than half a turn apart. */
function unrolled(positions: readonly Position[]): Position[] {
  let before = positions[0][0];
  return positions.map(([longitude, latitude, height]) => {
    before = longitude - 360 * Math.round((longitude - before) / 360);
    return [before, latitude, height];
  });
}

/** The place where the way from one position to another meets a meridian. */
function meeting(a: Position, b: Position, meridian: number): Position {
  const share = (meridian - a[0]) / (b[0] - a[0]);
  return [meridian, a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])];
}

/** The odd multiple of 180° between two longitudes, if there is one. */
function seamBetween(a: number, b: number): number | undefined {
  const seam = 180 * (2 * Math.ceil((Math.min(a, b) - 180) / 360) + 1);
  return seam > Math.min(a, b) && seam < Math.max(a, b) ? seam : undefined;
}

/** As RFC 7946 wants longitudes, on the side of the seam that a part lies on. */
function wrapped(part: readonly Position[]): Position[] {
  const longitudes = part.map(([longitude]) => longitude);
  const middle = (Math.min(...longitudes) + Math.max(...longitudes)) / 2;
  const turns = 360 * Math.round(middle / 360);
  return part.map(([longitude, latitude, height]) => [longitude - turns, latitude, height]);
}

function lineGeometry(positions: readonly Position[]): Geometry {
  const way = unrolled(positions);
  const parts: Position[][] = [[way[0]]];
  for (let i = 1; i < way.length; i++) {
    const seam = seamBetween(way[i - 1][0], way[i][0]);
    if (seam !== undefined) {
      const at = meeting(way[i - 1], way[i], seam);
      parts[parts.length - 1].push(at);
      parts.push([at]);
    }
    parts[parts.length - 1].push(way[i]);
  }
  if (parts.length === 1) return { type: "LineString", coordinates: positions };
  return { type: "MultiLineString", coordinates: parts.map(wrapped) };
}

function ringGeometry(positions: readonly Position[]): Geometry {
  const ring = unrolled(positions);
  const around = unrolled([...positions, positions[0]]).at(-1)![0] - ring[0][0];
  const seams = new Set(
    ring.flatMap(([longitude], i) => seamBetween(longitude, ring[(i + 1) % ring.length][0]) ?? []),
  );
  const [seam] = seams;
  // A ring around a pole has no inside in the plane of longitudes and latitudes: it stays as it is.
  if (seam === undefined || Math.abs(around) > 180) {
    return { type: "Polygon", coordinates: [closed(positions)] };
  }
  const halves = [1, -1].map((side) => cut(ring, seam, side)).filter((half) => half.length > 2);
  return { type: "MultiPolygon", coordinates: halves.map((half) => [closed(wrapped(half))]) };
}

/** The part of a ring on one side of a meridian (Sutherland and Hodgman, 1974). */
function cut(ring: readonly Position[], seam: number, side: number): Position[] {
  return ring.flatMap((at, i) => {
    const next = ring[(i + 1) % ring.length];
    const [here, there] = [side * (at[0] - seam) <= 0, side * (next[0] - seam) <= 0];
    const kept = here ? [at] : [];
    return here === there ? kept : [...kept, meeting(at, next, seam)];
  });
}

/** Counter-clockwise, the first position repeated at the end (RFC 7946, 3.1.6). */
function closed(ring: readonly Position[]): Position[] {
  const way = unrolled(ring);
  const turned = planarArea(way.flatMap((position) => position.slice(0, 2))) < 0 ? [...ring].reverse() : ring;
  return [...turned, turned[0]];
}
