import { type Crs, CrsError, type Unit } from "@groma/georef";
import type { Proj } from "./program/find.js";
import { type CrsText, idOf, inside, type ProjAxis, type ProjJson, projJson, written } from "./source.js";

const METRE: Unit = { name: "metre", kind: "linear", size: 1 };
/** Units that PROJJSON has a name for. */
const NAMED: ReadonlyMap<string, Unit> = new Map([
  ["metre", METRE],
  ["degree", { name: "degree", kind: "angular", size: Math.PI / 180 }],
]);

/**
 * A CRS as PROJ knows it, for one that `resolveCrs` does not take: only PROJ can place it, and `proj4` is what its PROJ
 * string has left of it, without the datum.
 *
 * @throws CrsError CRS_UNKNOWN when PROJ does not know it either, CRS_UNSUPPORTED when it is no place on the earth (a
 *   height system alone, geocentric or engineering coordinates)
 */
export async function knownCrs(proj: Proj, source: CrsText, signal?: AbortSignal): Promise<Crs> {
  const given = await projJson(proj, source, signal);
  const { crs: whole = given, coordinateEpoch: epoch } = given;
  const [plane, vertical] =
    whole.type === "CompoundCRS" && whole.components ? whole.components : [whole, undefined];
  const [x, , z] = axesOf(plane);
  const horizontalUnit = x && unitOf(x, isProjected(plane) ? "linear" : "angular");
  if (!horizontalUnit || !ON_EARTH.has(inside(plane).type ?? "")) {
    throw unsupported(source.name, `"${whole.name}" has no places in plane`);
  }
  const up = vertical ? axesOf(vertical)[0] : z;
  const upwards = up && unitOf(up, "linear");
  const declared = upwards && up.direction === "down" ? { ...upwards, size: -upwards.size } : upwards;
  const fallback = horizontalUnit.kind === "linear" ? horizontalUnit : METRE;
  const code = codeOf(whole, plane, vertical);
  const at = epoch === undefined ? "" : `@${epoch}`;
  return {
    name: `${whole.name ?? source.name}${epoch === undefined ? "" : `, epoch ${epoch}`}`,
    ...(code !== undefined && { code: `EPSG:${code}${at}` }),
    proj4: await projString(proj, source, plane, signal),
    wkt: await written(proj, source, "WKT2:2019", signal),
    horizontalUnit,
    verticalUnit: { ...(declared ?? fallback), declared: declared !== undefined },
    height: heightOf(plane, vertical, z),
    datum: {
      operation: `as PROJ knows "${plane.name}"`,
      accuracy: null,
      ...(isOfWgs84(plane) && { datum: WGS84_ENSEMBLE }),
    },
  };
}

/** EPSG code of the ensemble of all realisations of WGS 84. */
export const WGS84_ENSEMBLE = 6326;

function isOfWgs84(crs: ProjJson): boolean {
  const { base_crs: base, datum_ensemble: ensemble, datum = ensemble } = inside(crs);
  if (base) return isOfWgs84(base);
  return (
    datum !== undefined &&
    (idOf(datum) === WGS84_ENSEMBLE || /^World Geodetic System 1984( ensemble)?$/.test(datum.name ?? ""))
  );
}

const ON_EARTH: ReadonlySet<string> = new Set([
  ...["GeographicCRS", "GeodeticCRS", "ProjectedCRS", "DerivedGeographicCRS", "DerivedGeodeticCRS"],
  "DerivedProjectedCRS",
]);

function isProjected(crs: ProjJson): boolean {
  return /ProjectedCRS$/.test(inside(crs).type ?? "");
}

function axesOf(crs: ProjJson): readonly ProjAxis[] {
  const { coordinate_system: system } = inside(crs);
  return (system?.subtype === "Cartesian" && !isProjected(crs) ? undefined : system?.axis) ?? [];
}

function unitOf({ unit }: ProjAxis, kind: Unit["kind"]): Unit | undefined {
  const found = typeof unit === "string" ? NAMED.get(unit) : sized(unit, kind);
  return found?.kind === kind ? found : undefined;
}

function sized(unit: ProjAxis["unit"], kind: Unit["kind"]): Unit | undefined {
  if (typeof unit !== "object" || unit === null) return undefined;
  const { name = "unit", conversion_factor: size } = unit;
  return typeof size === "number" && size > 0 ? { name, kind, size } : undefined;
}

function codeOf(whole: ProjJson, plane: ProjJson, vertical: ProjJson | undefined) {
  const parts = vertical ? [idOf(plane), idOf(vertical)] : [idOf(whole)];
  return parts.every((part) => part !== undefined) ? parts.join("+") : idOf(whole);
}

function heightOf(plane: ProjJson, vertical: ProjJson | undefined, z: ProjAxis | undefined): Crs["height"] {
  const system = vertical && inside(vertical);
  if (system && (isUnshifted(vertical) || isUnnamed(vertical))) return { kind: "unknown" };
  if (!system && z) return { kind: "ellipsoidal", ...(!isOfWgs84(plane) && { ellipsoid: "own" }) };
  if (!system) return { kind: "unknown" };
  const epsg = idOf(system);
  return { kind: "geoid", model: system.name ?? "unnamed", ...(epsg !== undefined && { epsg }) };
}

/** Whether nobody knows a vertical datum, and no grid stands for it. */
function isUnnamed({ type, name, datum }: ProjJson): boolean {
  return type !== "BoundCRS" && /^unknown(?![a-z])/i.test(datum?.name ?? name ?? "");
}

/** Whether the grid of a bound CRS is PROJ's `@null`: heights are to be taken as they are. */
function isUnshifted({ transformation }: ProjJson): boolean {
  return (transformation?.parameters ?? []).some(({ value }) => /^@?null(,|$)/.test(`${value}`));
}

/** In place of the PROJ string of a derived CRS, which has none: what proj4js refuses by name. */
const DERIVED = "+proj=derived +no_defs";

async function projString(
  proj: Proj,
  source: CrsText,
  plane: ProjJson,
  signal: AbortSignal | undefined,
): Promise<string> {
  try {
    const text = await written(proj, { name: source.name, text: JSON.stringify(plane) }, "PROJ", signal);
    return text.replace(/ \+type=crs$/, "");
  } catch (error) {
    if (error instanceof CrsError && inside(plane).type?.startsWith("Derived")) return DERIVED;
    throw error;
  }
}

function unsupported(file: string, cause: string): CrsError {
  return new CrsError({
    ...{ code: "CRS_UNSUPPORTED", file, cause },
    fix: "give the coordinate reference system of the points in plane with --crs, their heights with --vertical",
  });
}
