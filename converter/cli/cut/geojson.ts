import { readFile } from "node:fs/promises";
import { GromaError } from "@groma/georef";

/** A file with a line or a polygon cannot be read. Codes: GEOJSON_NOT_FOUND, GEOJSON_SYNTAX, GEOJSON_GEOMETRY. */
class GeoJsonError extends GromaError {
  static override readonly kind = "GeoJsonError";
}

/** x and y, or longitude and latitude in degrees. */
export type Position = readonly [number, number];

type GeometryType = "LineString" | "Polygon";

/**
 * The one geometry of a type in a GeoJSON file (RFC 7946): bare, in a feature, or in a collection with others.
 * @returns its coordinates, as they stand
 */
async function geometry(file: string, type: GeometryType): Promise<unknown> {
  const refuse = (code: string, cause: string) =>
    new GeoJsonError({ code: `GEOJSON_${code}`, file, cause, fix: `give a GeoJSON file with one ${type}` });
  let text: string;
  try {
    text = await readFile(file, "utf8");
  } catch (error) {
    const reason = error instanceof Error && "code" in error ? ` (${error.code})` : "";
    throw refuse("NOT_FOUND", `it cannot be read${reason}`);
  }
  let value: unknown;
  try {
    value = JSON.parse(text.replace(/^\uFEFF/, ""));
  } catch {
    throw refuse("SYNTAX", "it is no JSON");
  }
  const found = geometriesOf(value).filter((one) => one.type === type);
  if (found.length !== 1)
    throw refuse("GEOMETRY", `it has ${found.length === 0 ? "no" : found.length} ${type}`);
  return found[0]!.coordinates;
}

interface Geometry {
  readonly type: unknown;
  readonly coordinates: unknown;
}

/** All geometries in a GeoJSON value, at any depth of collections. */
function geometriesOf(value: unknown): Geometry[] {
  if (typeof value !== "object" || value === null) return [];
  const { type, coordinates, geometry, geometries, features } = value as Record<string, unknown>;
  if (type === "Feature") return geometriesOf(geometry);
  if (type === "FeatureCollection") return list(features).flatMap(geometriesOf);
  if (type === "GeometryCollection") return list(geometries).flatMap(geometriesOf);
  return [{ type, coordinates }];
}

function list(value: unknown): unknown[] {
  return Array.isArray(value) ? value : [];
}

/** Pairs of finite numbers; what follows them, a height, is passed over. @throws GeoJsonError GEOJSON_GEOMETRY */
function positions(value: unknown, file: string, fewest: number): Position[] {
  const found = list(value).flatMap((one): Position[] => {
    const [x, y] = list(one);
    return Number.isFinite(x) && Number.isFinite(y) ? [[x as number, y as number]] : [];
  });
  if (found.length === list(value).length && found.length >= fewest) return found;
  throw new GeoJsonError({
    code: "GEOJSON_GEOMETRY",
    file,
    cause: `its coordinates are not ${fewest} or more positions`,
    fix: "give finite numbers, x or longitude first",
  });
}

/** Vertices of the LineString in a file. @throws GeoJsonError */
export async function readLine(file: string): Promise<Position[]> {
  return positions(await geometry(file, "LineString"), file, 2);
}

/** Rings of the Polygon in a file: the outer one, then its holes. @throws GeoJsonError */
export async function readPolygon(file: string): Promise<Position[][]> {
  const rings = list(await geometry(file, "Polygon"));
  if (rings.length === 0) positions([], file, 4);
  return rings.map((ring) => positions(ring, file, 4));
}
