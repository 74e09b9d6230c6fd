import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { type Crs, CrsError, isAboveOwnEllipsoid, isShifted } from "@groma/georef";
import type { Proj } from "./program/find.js";
import { failed, run } from "./program/run.js";

/** A CRS in words that PROJ reads. */
export interface CrsText {
  /** For people. */
  readonly name: string;
  /** EPSG code, PROJ string, WKT or PROJJSON. */
  readonly text: string;
}

/** A CRS as PROJ is asked for it. */
export interface SourceTexts {
  /** The horizontal part alone (for a CRS of one piece: all of it). */
  readonly horizontal: CrsText;
  /** With its heights, where they are from a vertical datum that PROJ can be told. */
  readonly compound?: CrsText;
}

/**
 * A code of an authority, such as `EPSG:2154+5720` or `IGNF:RGF93LAMB93.IGN69`, with or without the epoch of the coordinates
 * (`EPSG:9309@2023.25`), or the URN of one.
 */
const CODE =
  /^([A-Za-z][A-Za-z0-9]{1,15}:[A-Za-z0-9_.]{1,60}(\+([A-Za-z][A-Za-z0-9]{1,15}:)?[A-Za-z0-9_.]{1,60})?(@\d{4}(\.\d{1,9})?)?|urn:ogc:def:crs:[A-Za-z0-9]{2,15}:[0-9.]*:[A-Za-z0-9_.]{1,60})$/;

/**
 * Calls with an argument that `projinfo` takes for the CRS: a code or PROJ string as it is, anything else as a file of
 * its own, so that no text can name a file or an option.
 *
 * @throws CrsError CRS_UNKNOWN when it is no CRS text
 */
export async function withArgument<T>(
  { name, text }: CrsText,
  use: (argument: string) => Promise<T>,
): Promise<T> {
  const trimmed = text.trim();
  if (CODE.test(trimmed)) return use(trimmed);
  if (trimmed.startsWith("+")) return use(/\+type=crs\b/.test(trimmed) ? trimmed : `${trimmed} +type=crs`);
  if (!/^(\{|[A-Za-z_]+\s*\[)/.test(trimmed)) {
    throw new CrsError({
      code: "CRS_UNKNOWN",
      file: name,
      cause: `"${trimmed.slice(0, 60)}" is not an EPSG code, PROJ string, WKT or PROJJSON`,
      fix: "name the coordinate reference system with --crs, as an EPSG code or as WKT",
    });
  }
  const folder = await mkdtemp(join(tmpdir(), "groma-crs-"));
  try {
    const path = join(folder, "crs.txt");
    await writeFile(path, trimmed);
    return await use(`@${path}`);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

/**
 * How PROJ is to be asked for a CRS whose heights may have been declared apart from it. The code goes before the WKT
 * that it came with, since PROJ knows more of it; the WKT before the PROJ string, which has lost the datum's name.
 *
 * @param own the user's own words, which go before all of these
 * @throws CrsError CRS_UNKNOWN when PROJ does not know it, CRS_OPERATION_UNSUPPORTED when it is geocentric
 */
export async function sourceTexts(
  proj: Proj,
  crs: Pick<Crs, "name" | "code" | "wkt" | "proj4" | "height">,
  own?: string,
  signal?: AbortSignal,
): Promise<SourceTexts> {
  const texts = own === undefined ? textsOf(crs) : [own];
  const { whole, json: given } = await firstKnown(proj, crs.name, texts, signal);
  const { crs: json = given, coordinateEpoch } = given;
  if (json.coordinate_system?.subtype === "Cartesian" && json.type === "GeodeticCRS") throw inSpace(crs.name);
  const [first, vertical] = json.type === "CompoundCRS" && json.components ? json.components : [json];
  const hasOther = hasThreeAxes(first) && isGivenApart(crs);
  const horizontal = hasOther ? inPlane(first) : first;
  const code = idOf(horizontal);
  const suffix = coordinateEpoch === undefined ? "" : `@${coordinateEpoch}`;
  const at = (one: ProjJson) => {
    return JSON.stringify(
      coordinateEpoch === undefined ? one : { type: "CoordinateMetadata", crs: one, coordinateEpoch },
    );
  };
  const plain =
    vertical || hasOther
      ? { name: horizontal.name ?? crs.name, text: code ? `EPSG:${code}${suffix}` : at(horizontal) }
      : whole;
  if (crs.height.kind !== "geoid") return { horizontal: plain };

  const wanted = crs.height.epsg;
  if (vertical && (wanted === undefined || wanted === idOf(vertical)))
    return { horizontal: plain, compound: whole };
  if (wanted === undefined) return { horizontal: plain };
  if (code) {
    return { horizontal: plain, compound: { name: crs.name, text: `EPSG:${code}+${wanted}${suffix}` } };
  }
  const heights = await projJson(proj, { name: crs.height.model, text: `EPSG:${wanted}` }, signal);
  const components = [horizontal, heights] as const;
  const compound = { type: "CompoundCRS", name: crs.name, components };
  return { horizontal: plain, compound: { name: crs.name, text: at(compound) } };
}

/** Whether heights were given that are not those of a third axis. */
function isGivenApart({ height, proj4 }: Pick<Crs, "height" | "proj4">): boolean {
  return height.kind === "geoid" || (height.kind === "ellipsoidal" && !height.ellipsoid && isShifted(proj4));
}

function hasThreeAxes(crs: ProjJson): boolean {
  return inside(crs).coordinate_system?.axis?.length === 3;
}

/** A CRS without its third axis, and so without the codes that it had with it. */
function inPlane({ id: _, ...crs }: ProjJson): ProjJson {
  const { coordinate_system: system, source_crs, target_crs, base_crs } = crs;
  return {
    ...crs,
    ...(system?.axis && { coordinate_system: { ...system, axis: system.axis.slice(0, 2) } }),
    ...(source_crs && { source_crs: inPlane(source_crs) }),
    ...(target_crs && { target_crs: inPlane(target_crs) }),
    ...(base_crs && { base_crs: inPlane(base_crs) }),
  };
}

/** The greatest code that EPSG gives out itself; ESRI's software writes its own, greater ones under EPSG's name. */
const EPSG_MAX = 32767;

function textsOf({ code, wkt, proj4, height }: Pick<Crs, "code" | "wkt" | "proj4" | "height">): string[] {
  const number = Number(/^EPSG:(\d+)$/.exec(code ?? "")?.[1]);
  const named = number > EPSG_MAX ? `ESRI:${number}` : code;
  // Of heights that have no code themselves, such as those of a grid or above a country's ellipsoid, that of the plane says
  // nothing, nor of a transformation that is bound to it. The TOWGS84 of WKT 1 gives way to a code, as GDAL has it: writers
  // add it to every code.
  const wordless = height.kind === "geoid" ? height.epsg === undefined : isAboveOwnEllipsoid({ height });
  const isBound = /\bBOUNDCRS\s*\[/i.test(wkt ?? "");
  return (wordless || isBound ? [wkt, named, proj4] : [named, wkt, proj4]).filter(
    (text) => text !== undefined,
  );
}

/** The first of the texts that PROJ understands. */
async function firstKnown(
  proj: Proj,
  name: string,
  [text, ...others]: readonly string[],
  signal?: AbortSignal,
): Promise<{ whole: CrsText; json: ProjJson }> {
  const whole = { name, text };
  try {
    return { whole, json: await projJson(proj, whole, signal) };
  } catch (error) {
    if (!(error instanceof CrsError) || others.length === 0 || others[0] === "") throw error;
    return firstKnown(proj, name, others, signal);
  }
}

/** Of a CRS in PROJJSON (schema v0.7) what is read here. */
export interface ProjJson {
  readonly type?: string;
  readonly name?: string;
  readonly components?: readonly [ProjJson, ProjJson];
  /** Of coordinate metadata: what the epoch belongs to, and the epoch, years. */
  readonly crs?: ProjJson;
  readonly coordinateEpoch?: number;
  /** Of a BoundCRS. */
  readonly source_crs?: ProjJson;
  readonly target_crs?: ProjJson;
  readonly transformation?: { readonly parameters?: readonly { readonly value?: unknown }[] };
  /** Of a projected or derived CRS. */
  readonly base_crs?: ProjJson;
  readonly datum?: ProjJson;
  readonly datum_ensemble?: ProjJson;
  readonly coordinate_system?: { readonly subtype?: string; readonly axis?: readonly ProjAxis[] };
  readonly id?: { readonly authority?: string; readonly code?: number };
}

/** An axis of PROJJSON. */
export interface ProjAxis {
  /** `up`, `down`, `north` … */
  readonly direction?: string;
  /** A unit of PROJJSON's own (`metre`, `degree`), or one with its size in metres or radians. */
  readonly unit?: string | { readonly name?: string; readonly conversion_factor?: number };
}

/** The CRS that a transformation is bound to. */
export function inside(crs: ProjJson): ProjJson {
  return crs.type === "BoundCRS" && crs.source_crs ? inside(crs.source_crs) : crs;
}

/** Geocentric coordinates need no engine: they are X, Y, Z already. */
function inSpace(name: string): CrsError {
  return new CrsError({
    code: "CRS_OPERATION_UNSUPPORTED",
    file: name,
    cause: "its coordinates are geocentric, with no projection to fit",
    fix: "convert with --engine proj4js, which takes geocentric coordinates as they are",
  });
}

/** EPSG code of a CRS. */
export function idOf({ id }: ProjJson): number | undefined {
  return id?.authority === "EPSG" && Number.isInteger(id.code) ? id.code : undefined;
}

/** @throws CrsError CRS_UNKNOWN */
export async function projJson(proj: Proj, source: CrsText, signal?: AbortSignal): Promise<ProjJson> {
  const text = await written(proj, source, "PROJJSON", signal);
  const json = parsed(text);
  if (!json) throw failed(proj.projinfo, "its description of a coordinate reference system cannot be read");
  return json;
}

/**
 * A CRS in a notation of PROJ's, on one line.
 *
 * @throws CrsError CRS_UNKNOWN when PROJ does not know it, or has no words for it in that notation
 */
export async function written(
  proj: Proj,
  source: CrsText,
  notation: "PROJJSON" | "WKT2:2019" | "PROJ",
  signal?: AbortSignal,
): Promise<string> {
  return withArgument(source, async (argument) => {
    const args = ["-k", "crs", "-q", "-o", notation, "--single-line", argument];
    const { status, stdout, stderr } = await run(proj.projinfo, args, {
      environment: proj.environment,
      signal,
    });
    const text = stdout.trim();
    if (status === 0 && text !== "" && !text.startsWith("Error when exporting")) return text;
    const said = (stderr.trim() || text).split("\n")[0].slice(0, 160);
    throw new CrsError({
      code: "CRS_UNKNOWN",
      file: source.name,
      cause: `PROJ does not understand this coordinate reference system (${said})`,
      fix: "name it with --crs, as an EPSG code or as WKT",
    });
  });
}

function parsed(text: string): ProjJson | undefined {
  try {
    const value: unknown = JSON.parse(text);
    return value !== null && typeof value === "object" ? value : undefined;
  } catch {
    return undefined;
  }
}
