import {
  boundsOfPlaces,
  type Crs,
  CrsError,
  type CrsNote,
  compileTransformation,
  deriveTransformation,
  domainAround,
  EGM96,
  EGM96_NOTE,
  type EpsgLookup,
  ecefToGeodetic,
  egm96Step,
  encodeTransformation,
  everyStep,
  type GeoreferenceRecord,
  type Grid,
  isAboveGeoid,
  isInside,
  type OperationReport,
  PlacementError,
  pointTransform,
  resolveWithNotes,
  similarSystems,
  spread,
  type Transformation,
  type Truth,
  verticalLookup,
  withHeights,
} from "@groma/georef";
import type { HeightData } from "./height-data.js";
import type { Declared } from "./recorded-georeference.js";

const DEGREE = Math.PI / 180;
const CODE = /^\s*EPSG:(\d{1,6})\s*$/i;

/**
 * A table that knows a height reference: the application's own, else the one that comes with this library.
 *
 * @param vertical `EPSG:5728` or `ellipsoidal`
 * @throws CrsError CRS_UNKNOWN for a code that neither has
 * @throws SourceError SOURCE_HEIGHTS
 */
export async function lookupFor(
  vertical: string,
  file: string,
  epsg: EpsgLookup | undefined,
  data: HeightData,
): Promise<EpsgLookup | undefined> {
  const code = Number(CODE.exec(vertical)?.[1] ?? Number.NaN);
  if (Number.isNaN(code)) {
    if (!/^\s*ellipsoidal\s*$/i.test(vertical)) await refuseWithSuggestions(vertical, file, data);
    return epsg;
  }
  if (epsg?.(code)) return epsg;
  const own = verticalLookup(await data.systems());
  if (own(code)) return (asked) => epsg?.(asked) ?? own(asked);
  throw new CrsError({
    code: "CRS_UNKNOWN",
    file,
    cause: `EPSG:${code} is not a vertical coordinate system of EPSG`,
    fix: "give the code of a vertical coordinate system, such as EPSG:5728, or ellipsoidal",
  });
}

/** Names the systems that a height reference in words may mean; silent where none is like it or the table cannot be had. */
async function refuseWithSuggestions(vertical: string, file: string, data: HeightData): Promise<void> {
  const systems = await data.systems().catch(() => []);
  const similar = similarSystems(systems, vertical, undefined);
  if (similar.length === 0) return;
  const names = similar.map(({ code, name }) => `EPSG:${code} (${name})`).join(", ");
  throw new CrsError({
    ...{ code: "CRS_UNKNOWN", file, cause: `"${vertical}" is not a known height reference` },
    fix: `give its EPSG code: ${names}; or ellipsoidal`,
  });
}

/**
 * The coordinate system of a record with another height reference, and what has to be known of it. The horizontal part
 * stays as the conversion settled it, and so does the unit of z as `resolveWithNotes` has it.
 *
 * @param vertical `EPSG:5728` or `ellipsoidal`
 * @throws CrsError CRS_UNKNOWN; CRS_UNSUPPORTED for a data set without a coordinate system
 */
export function crsWithHeights(
  { crs, similarity }: Pick<GeoreferenceRecord, "crs" | "similarity">,
  vertical: string,
  file: string,
  epsg: EpsgLookup | undefined,
): { readonly crs: Crs; readonly notes: readonly CrsNote[] } {
  if (similarity) throw placedAsBody(file);
  const sources = { file, given: crs.proj4, givenVertical: vertical, recordedHeights: crs };
  const { crs: resolved, notes } = resolveWithNotes(sources, epsg);
  const { height, verticalUnit } = resolved;
  const { code, wkt: _, ...rest } = crs;
  // Names and codes of compound systems are those of their parts, joined by a plus.
  const [horizontalCode] = code?.split("+") ?? [];
  const [horizontalName] = crs.name.split(" + ");
  const heights = height.kind === "geoid" ? height.model : `${height.kind} height`;
  return {
    crs: {
      ...rest,
      ...(horizontalCode !== undefined && { code: horizontalCode }),
      ...{ name: `${horizontalName} + ${heights}`, height, verticalUnit },
    },
    notes,
  };
}

/**
 * Name of a given height system whose area of use the middle of the data set lies outside of; undefined within it, and
 * for systems that the table beside this library does not have.
 *
 * @throws SourceError SOURCE_HEIGHTS
 */
export async function systemAbroad(
  truth: Truth,
  { height }: Crs,
  { boundingBox: { min, max } }: Declared,
  data: HeightData,
): Promise<string | undefined> {
  if (height.kind !== "geoid" || height.epsg === undefined) return undefined;
  const system = (await data.systems()).find(({ code }) => code === height.epsg);
  const [x, y, z] = min.map((least, axis) => (least + max[axis]) / 2);
  const [ecef, place] = [new Float64Array(3), new Float64Array(3)];
  pointTransform(truth)(x, y, z, ecef, 0);
  ecefToGeodetic(ecef[0], ecef[1], ecef[2], place);
  const [longitude, latitude] = [place[0] / DEGREE, place[1] / DEGREE];
  const within = !system || !Number.isFinite(longitude) || isInside(system.area, { longitude, latitude });
  return within ? undefined : system.name;
}

/**
 * The way of a conversion in plane, with the heights of another reference: above a geoid by EGM96, else as they are,
 * those that count from a level of their own included.
 *
 * @param transformation of the conversion
 */
export function regiven(
  transformation: Transformation,
  crs: Crs,
  source: Declared,
  egm96: Grid | undefined,
): Uint8Array {
  const geoid = egm96 && isAboveGeoid(crs) ? egm96Step(egm96, boundsOf(transformation, source)) : undefined;
  return encodeTransformation(withHeights(transformation, { metresPerUnit: crs.verticalUnit.size, geoid }));
}

/** What the conversion said of its operation, as far as it holds with other heights. */
export function operationRegiven(
  { grids, notes, ...rest }: OperationReport,
  transformation: Transformation,
  crs: Crs,
): OperationReport {
  const steps = everyStep(transformation);
  const inPlane = steps.flatMap((step) => (step.kind === "horizontalShift" ? [step.window.grid] : []));
  const geoid = isAboveGeoid(crs);
  const told = notes.filter((note) => !/^height/.test(note));
  const replaced = steps.some(({ kind }) => kind === "verticalShift")
    ? ["what the operation does to heights is replaced by the height reference given"]
    : [];
  return {
    ...rest,
    grids: [...grids.filter((grid) => inPlane.includes(grid)), ...(geoid ? [EGM96] : [])],
    notes: [...told, ...replaced, ...(geoid ? [EGM96_NOTE] : [])],
  };
}

/**
 * The way to ECEF of a file without a transformation of its own whose heights are above a geoid: proj4js in plane,
 * EGM96 for the heights.
 *
 * @throws PlacementError PLACE_POLE, PLACE_ANTIMERIDIAN, PLACE_DOMAIN, PLACE_PATCHWORK
 */
export async function derivedByEgm96(crs: Crs, source: Declared, egm96: Grid): Promise<Uint8Array> {
  const { name: file, boundingBox, scale } = source;
  const domain = domainAround(boundingBox, scale, crs.horizontalUnit);
  return encodeTransformation(await deriveTransformation(crs, domain, { egm96, file }));
}

/** Where the data set lies on the earth. */
function boundsOf(transformation: Transformation, source: Declared) {
  const { evaluate } = compileTransformation(transformation, source.name);
  const { min, max } = source.boundingBox;
  const points = spread({
    minX: min[0],
    minY: min[1],
    minZ: min[2],
    maxX: max[0],
    maxY: max[1],
    maxZ: max[2],
  });
  const places = new Float64Array(points.length);
  const ecef = new Float64Array(3);
  for (let i = 0; i < points.length; i += 3) {
    evaluate(points[i], points[i + 1], points[i + 2], ecef, 0);
    ecefToGeodetic(ecef[0], ecef[1], ecef[2], places, i);
  }
  const bounds = boundsOfPlaces(places);
  if (bounds) return bounds;
  throw new PlacementError({
    code: "PLACE_DOMAIN",
    file: source.name,
    cause: "its coordinates lie outside what the transformation in its georeference record covers",
    fix: "convert the scan again, or give its coordinate system with the option crs",
  });
}

function placedAsBody(file: string): CrsError {
  return new CrsError({
    code: "CRS_UNSUPPORTED",
    file,
    cause:
      "it has no coordinate system and was placed by an anchor or control points: its heights are theirs",
    fix: "convert it again with other anchor or control points, or give its coordinate system with the option crs",
  });
}
