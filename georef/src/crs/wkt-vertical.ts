import { requireKind } from "../errors/arguments.js";
import type { VerticalModel } from "./model.js";
import { Refusal } from "./refusal.js";
import { child, children, epsgCode, number, parseWkt, text, type WktNode } from "./tree.js";
import { directed, METRE, unitOf } from "./units.js";

/** Keywords of a vertical CRS: WKT1, ESRI, WKT2 in short and in full. */
export const VERTICAL = ["VERT_CS", "VERTCS", "VERTCRS", "VERTICALCRS"];

/** Datum type of WKT1 for heights above the ellipsoid (OGC 01-009). */
const ELLIPSOIDAL = 2002;

/**
 * Reads a vertical CRS.
 * @param grid name of the geoid grid that a BOUNDCRS ties to it, if any
 */
export function readVertical(node: WktNode, grid?: string): VerticalModel {
  const name = text(node, 1);
  const downAxis = children(node, "AXIS").some((axis) => text(axis, 2).toLowerCase() === "down");
  const parameters = new Map(children(node, "PARAMETER").map((item) => [text(item, 1), number(item, 2)]));
  const down = downAxis || parameters.get("Direction") === -1;
  const measure =
    child(node, "UNIT", "LENGTHUNIT") ?? child(child(node, "AXIS") ?? node, "UNIT", "LENGTHUNIT");
  const unit = measure && unitOf(text(measure, 1), "linear", number(measure, 2));
  const datum = child(node, "VERT_DATUM", "VDATUM", "VERTICALDATUM", "VRF");
  const extension = datum && children(datum, "EXTENSION").find((item) => text(item, 1) === "PROJ4_GRIDS");
  const bound = grid ?? (extension && text(extension, 2));
  // ESRI marks ellipsoidal heights with the geodetic datum in place of a vertical one.
  const geodetic = datum ? undefined : child(node, "DATUM");
  const ellipsoidal = datum ? number(datum, 2) === ELLIPSOIDAL : geodetic !== undefined;
  return {
    name: bound ?? name,
    code: epsgCode(node),
    unit: down ? directed(unit ?? METRE, true) : unit,
    reference: ellipsoidal ? "ellipsoidal" : bound === undefined && isUnknown(datum) ? "unknown" : "geoid",
    ...(ellipsoidal && { ellipsoid: "own" as const, datum: geodetic && text(geodetic, 1) }),
    doubt: doubtOf(parameters.get("Vertical_Shift") ?? 0, ellipsoidal && down),
  };
}

/**
 * The `doubt` of the heights in a WKT text whose plane may not be understood; none of a text that is no WKT.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function doubtOfHeights(text: string): string | undefined {
  requireKind(text, "text", "doubtOfHeights: text");
  try {
    const nodes = parseWkt(text).flatMap((node) => [node, ...children(node)]);
    const vertical = nodes.find(([keyword]) => VERTICAL.includes(keyword));
    return vertical && readVertical(vertical).doubt;
  } catch (error) {
    if (error instanceof Refusal) return undefined;
    throw error;
  }
}

/** What ESRI's texts say of heights and nobody follows, PROJ among them. */
function doubtOf(shift: number, depth: boolean): string | undefined {
  if (shift !== 0) return `declared as shifted by ${shift} (Vertical_Shift), which is not applied`;
  return depth ? "declared as depths below an ellipsoid, which other software takes for heights" : undefined;
}

/** A datum that says that nobody knows it: GDAL's way, and ESRI's, to write a unit of heights alone. */
function isUnknown(datum: WktNode | undefined): boolean {
  return datum !== undefined && /^(unknown|not[ _]specified)(?![a-z])/i.test(text(datum, 1));
}
