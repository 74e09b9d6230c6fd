import type { PointSource } from "@groma/layer/sources";

/** What an opened file says of its coordinates, as the core would tell it. */
export function declarationOf({
  name,
  boundingBox,
  scale,
  crs,
}: Pick<PointSource, "name" | "boundingBox" | "scale" | "crs">) {
  const { wkt, geoTiff, las, georeference, transformation } = crs;
  const base64 = (bytes: Uint8Array | undefined) => bytes && Buffer.from(bytes).toString("base64");
  const records = [
    ["1", base64(georeference)],
    ["3", base64(transformation)],
  ].filter(([, content]) => content !== undefined);
  return {
    ...{ file: name, ...boundingBox, scale, groma: Object.fromEntries(records) },
    ...(wkt !== undefined && { wkt }),
    ...(geoTiff && {
      geoTiff: { directory: [...geoTiff.directory], doubles: [...geoTiff.doubles], ascii: geoTiff.ascii },
    }),
    ...(las && las),
  };
}
