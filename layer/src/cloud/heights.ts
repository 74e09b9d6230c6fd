import { type Crs, CrsError, type EpsgLookup, type GeoreferenceRecord, resolveCrs } from "@groma/georef";

/**
 * The coordinate system of a record with another height reference. The horizontal part stays as the conversion settled
 * it; the unit of z too, unless the new reference brings its own.
 *
 * @param vertical `EPSG:5728` or `ellipsoidal`
 * @throws CrsError CRS_UNKNOWN; CRS_UNSUPPORTED for a data set without a coordinate system
 */
export function withHeights(
  { crs, similarity }: Pick<GeoreferenceRecord, "crs" | "similarity">,
  vertical: string,
  file: string,
  epsg: EpsgLookup | undefined,
): Crs {
  if (similarity) throw placedAsBody(file);
  const resolved = resolveCrs({ file, given: crs.proj4, givenVertical: vertical }, epsg);
  const { height } = resolved;
  const { code, ...rest } = crs;
  // Names and codes of compound systems are those of their parts, joined by a plus.
  const [horizontalCode] = code?.split("+") ?? [];
  const [horizontalName] = crs.name.split(" + ");
  const heights = height.kind === "geoid" ? height.model : `${height.kind} height`;
  return {
    ...rest,
    ...(horizontalCode !== undefined && { code: horizontalCode }),
    name: `${horizontalName} + ${heights}`,
    height,
    verticalUnit: height.kind === "geoid" ? resolved.verticalUnit : crs.verticalUnit,
  };
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
