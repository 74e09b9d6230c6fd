import { readFile } from "node:fs/promises";
import { extname } from "node:path";
import { GromaError } from "@groma/georef";
import type { Alignment } from "@groma/layer/tools";
import { readLine } from "./geojson.js";

/** A file with an alignment cannot be read. Code: LINE_NOT_FOUND. */
class LineFileError extends GromaError {
  static override readonly kind = "LineFileError";
}

/** A line that was given, and in which coordinates lines of its format usually are. */
export interface GivenLine extends Pick<Alignment, "vertices" | "start" | "equations" | "unit"> {
  /** True lengths of the stretches; undefined where they are straight. */
  readonly lengths: Alignment["lengths"] | undefined;
  /** Directions of the curves that stretches are chords of; undefined where all are straight. */
  readonly headings: Alignment["headings"] | undefined;
  readonly usualCrs: "source" | "EPSG:4326";
}

/**
 * Reads the line of a file: GeoJSON by its LineString; DXF (`.dxf`) by its polyline, LandXML (`.xml`, `.landxml`) by its alignment.
 * @param name layer of the polyline, or name of the alignment, where the file has several
 * @throws LineFileError, GeoJsonError; FormatError FORMAT_ALIGNMENT
 */
export async function readGivenLine(file: string, name: string | undefined): Promise<GivenLine> {
  const ending = extname(file).toLowerCase();
  if (ending !== ".dxf" && ending !== ".xml" && ending !== ".landxml") {
    const vertices = await readLine(file);
    const straight = { lengths: undefined, headings: undefined, unit: undefined };
    return { ...straight, vertices, start: 0, equations: [], usualCrs: "EPSG:4326" };
  }
  const text = await readFile(file, "utf8").catch((error: NodeJS.ErrnoException) => {
    throw new LineFileError({
      ...{ code: "LINE_NOT_FOUND", file, cause: `it cannot be read (${error.code})` },
      fix: "name a file with a line: GeoJSON, DXF or LandXML",
    });
  });
  const { readDxfLine, readLandXml } = await import("@groma/layer/tools");
  const read = ending === ".dxf" ? readDxfLine : readLandXml;
  return { ...read(text.replace(/^\uFEFF/, ""), name, file), usualCrs: "source" };
}
