import {
  type Crs,
  compileTransformation,
  type Domain,
  deriveTransformation,
  EGM96,
  EGM96_NOTE,
  isAboveGeoid,
  withWorthThere,
} from "@groma/georef";
import proj4 from "proj4";
import { egm96 } from "./egm96.js";
import { type EngineOptions, type EngineResult, UNKNOWN_HEIGHT_NOTE } from "./report.js";

/** Said of every place that was found without PROJ. */
const WITHOUT_PROJ_NOTE =
  "computed by proj4js without PROJ and its grids: where a country's datum has a shift grid, expect errors of 0.2 to 3 m in plane";

/**
 * The way from source coordinates to ECEF without PROJ: proj4js's projection, the seven parameters of `crs.proj4`, and
 * EGM96 for heights above a geoid.
 *
 * @param domain source units
 * @throws CrsError CRS_UNSUPPORTED
 * @throws PlacementError PLACE_DOMAIN, PLACE_POLE, PLACE_ANTIMERIDIAN, PLACE_PATCHWORK
 */
export async function proj4jsTransformation(
  crs: Crs,
  domain: Domain,
  { tolerance, file }: EngineOptions = {},
): Promise<EngineResult> {
  const geoid = isAboveGeoid(crs) ? await egm96() : undefined;
  const transformation = await deriveTransformation(crs, domain, { egm96: geoid, tolerance, file });
  const [projection] = transformation.steps;
  const { datum } = withWorthThere(crs, compileTransformation(transformation, file), domain);
  const notes = [WITHOUT_PROJ_NOTE];
  if (geoid) notes.push(EGM96_NOTE);
  if (crs.height.kind === "unknown") notes.push(UNKNOWN_HEIGHT_NOTE);
  return {
    transformation,
    report: {
      engine: { name: "proj4js", version: proj4.version },
      operation: datum?.operation ?? "datum shift of the PROJ string",
      accuracy: datum?.accuracy ?? null,
      ballpark: false,
      grids: geoid ? [EGM96] : [],
      lacking: [],
      passedOver: [],
      fitBound: projection.kind === "projection" ? projection.patchwork.bound : Number.NaN,
      checkedPoints: 0,
      worstDifference: 0,
      notes,
    },
  };
}
