import type { VerticalModel } from "./model.js";
import { unsupported } from "./refusal.js";
import { child, children, epsgCode, number, text, type WktNode } from "./tree.js";
import { directed, METRE, unitOf } from "./units.js";

export const VERTICAL = ["VERT_CS", "VERTCS", "VERTCRS", "VERTICALCRS"];

/** Datum type of WKT1 for heights above the ellipsoid (OGC 01-009). */
const ELLIPSOIDAL = 2002;

/**
 * Reads a vertical CRS.
 * @param grid name of the geoid grid that a BOUNDCRS ties to it, if any
 * @throws Refusal CRS_UNSUPPORTED for shifted heights
 */
export function readVertical(node: WktNode, grid?: string): VerticalModel {
  const name = text(node, 1);
  const downAxis = children(node, "AXIS").some((axis) => text(axis, 2).toLowerCase() === "down");
  const parameters = new Map(children(node, "PARAMETER").map((item) => [text(item, 1), number(item, 2)]));
  if ((parameters.get("Vertical_Shift") ?? 0) !== 0) throw unsupported(`"${name}" shifts its heights`);

  const measure =
    child(node, "UNIT", "LENGTHUNIT") ?? child(child(node, "AXIS") ?? node, "UNIT", "LENGTHUNIT");
  const unit = measure && unitOf(text(measure, 1), "linear", number(measure, 2));
  const datum = child(node, "VERT_DATUM", "VDATUM", "VERTICALDATUM", "VRF");
  const extension = datum && children(datum, "EXTENSION").find((item) => text(item, 1) === "PROJ4_GRIDS");
  // ESRI marks ellipsoidal heights with the geodetic datum in place of a vertical one.
  const ellipsoidal = datum ? number(datum, 2) === ELLIPSOIDAL : child(node, "DATUM") !== undefined;
  return {
    name: grid ?? (extension ? text(extension, 2) : name),
    code: epsgCode(node),
    unit: downAxis || parameters.get("Direction") === -1 ? directed(unit ?? METRE, true) : unit,
    reference: ellipsoidal ? "ellipsoidal" : isUnknown(datum) ? "unknown" : "geoid",
  };
}

/** A datum that says that nobody knows it: GDAL's way to write a unit of heights alone. */
function isUnknown(datum: WktNode | undefined): boolean {
  return datum !== undefined && /^(unknown|not specified)\b/i.test(text(datum, 1));
}
