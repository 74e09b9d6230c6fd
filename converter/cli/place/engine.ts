import { type Crs, CrsError, type Domain, GromaError } from "@groma/georef";
import { OptionError } from "../given/option-error.js";
import { proj4jsTransformation } from "../proj/fallback.js";
import { ProjError } from "../proj/program/errors.js";
import { findProj, type Proj } from "../proj/program/find.js";
import type { EngineResult } from "../proj/report.js";
import { projTransformation } from "../proj/transformation.js";

export type { Proj } from "../proj/program/find.js";

/** Names of the engines as `--engine` takes them. */
export const ENGINES = ["proj", "proj4js"] as const;

/** What the user says of the engine. */
export interface EngineChoice {
  /** Default: PROJ where it is found, else proj4js. PROJ that was asked for by name is not replaced. */
  readonly engine?: (typeof ENGINES)[number] | undefined;
  /** Folder of PROJ's programs. */
  readonly proj?: string | undefined;
  /** Folder of grids that goes before PROJ's own. */
  readonly grids?: string | undefined;
}

/** What an engine has to know besides the data set. */
export interface EngineSurroundings {
  /** The CRS in the user's own words. */
  readonly text?: string | undefined;
  /** For error messages. */
  readonly file: string;
  /** What {@link chosenProj} has found already. */
  readonly proj?: Proj | undefined;
  readonly signal?: AbortSignal | undefined;
}

/**
 * PROJ as the choice wants it.
 *
 * @returns nothing where proj4js is to be taken
 * @throws ProjError PROJ_MISSING, PROJ_VERSION, PROJ_GRID
 * @throws OptionError OPTION_ENGINE when grids or programs of PROJ are given, and PROJ is not wanted
 */
export async function chosenProj({ engine, proj, grids }: EngineChoice): Promise<Proj | undefined> {
  if (engine === "proj4js") {
    if (proj === undefined && grids === undefined) return undefined;
    throw new OptionError({
      ...{
        code: "OPTION_ENGINE",
        file: "--engine",
        cause: "--grids and --proj are for PROJ, not for proj4js",
      },
      fix: "leave them out, or convert with --engine proj",
    });
  }
  const found = await findProj({ folder: proj, grids });
  if (found || (engine === undefined && grids === undefined)) return found;
  throw new ProjError({
    ...{ code: "PROJ_MISSING", file: "cct", cause: "PROJ was not found, and it was asked for" },
    fix: "install PROJ (converter/scripts/install-proj, or the package proj), name the folder of its programs with --proj, or leave --engine and --grids out",
  });
}

/** Refusals of PROJ's way that say nothing against the other one. */
const GIVES_WAY = new Set(["CRS_UNKNOWN", "CRS_UNSUPPORTED", "CRS_OPERATION_UNSUPPORTED", "PLACE_CHECK"]);

/**
 * The way from source coordinates to ECEF for a domain, by the engine of choice. Where PROJ was found and not asked for,
 * and its way cannot be followed, proj4js goes its own, and the notes say why.
 *
 * @param domain source units
 * @throws CrsError, PlacementError, ProjError; PROJ's refusal where proj4js has no way either
 */
export async function engineTransformation(
  crs: Crs,
  domain: Domain,
  choice: EngineChoice,
  { text, file, proj: found, signal }: EngineSurroundings,
): Promise<EngineResult> {
  const proj = found ?? (await chosenProj(choice));
  if (!proj) return proj4jsTransformation(crs, domain, { file, signal });
  try {
    return await projTransformation(proj, crs, domain, { text, file, signal });
  } catch (error) {
    if (choice.engine === "proj" || !(error instanceof GromaError) || !GIVES_WAY.has(error.code)) throw error;
    const other = await withoutProj(crs, domain, file, error);
    const why = `PROJ ${proj.version} was found, but its way cannot be followed: ${error.cause}`;
    return { ...other, report: { ...other.report, notes: [why, ...other.report.notes] } };
  }
}

async function withoutProj(
  crs: Crs,
  domain: Domain,
  file: string,
  refusal: GromaError,
): Promise<EngineResult> {
  try {
    return await proj4jsTransformation(crs, domain, { file });
  } catch (error) {
    throw error instanceof CrsError ? refusal : error;
  }
}

/** A PROJ string says more to PROJ than what was read from it: its grids above all. */
export function projString(crs: string | undefined): string | undefined {
  return crs?.trim().startsWith("+") ? crs : undefined;
}
