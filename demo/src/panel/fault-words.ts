import { GromaError } from "@groma/georef";
import { i18n } from "../language/i18n.js";
import { PageError } from "./page-error.js";

/** What went wrong, by the stable code of the error. */
const BY_CODE: ReadonlyMap<string, string> = new Map([
  ["CRS_CONTRADICTION", i18n.t("The file contradicts itself about its coordinate system.")],
  ["CRS_MISSING", i18n.t("The file does not name its coordinate system.")],
  ["CRS_PROJECTION", i18n.t("The map projection of the coordinate system is not supported.")],
  ["CRS_UNKNOWN", i18n.t("The coordinate system is not known.")],
  ["CRS_UNSUPPORTED", i18n.t("The coordinate system is not supported.")],
  ["CRS_HEIGHT_UNIT", i18n.t("The unit of the heights is in question.")],
  ["DECODE_PROJECTIONS", i18n.t("A part of the page cannot be loaded.")],
  ["DECODE_TOO_LARGE", i18n.t("A part of the cloud is too large to be decoded.")],
  ["DECODE_WASM", i18n.t("The decoder cannot be loaded.")],
  ["DECODE_WORKER", i18n.t("The browser does not let the decoder run in the background.")],
  ["DRAW_WEBGL2", i18n.t("This browser cannot draw: it has no WebGL 2.")],
  ["EXPORT_MIXED", i18n.t("The points are of several kinds, which one file cannot hold.")],
  ["EXPORT_NO_LAS", i18n.t("These points cannot be written as LAS.")],
  ["EXPORT_NO_LAZ", i18n.t("These points cannot be written as LAZ.")],
  ["EXPORT_NO_LINE", i18n.t("There is no line to be written.")],
  ["EXPORT_NO_PLACE", i18n.t("A point has no place in this format.")],
  ["EXPORT_PICTURE", i18n.t("The picture cannot be made.")],
  ["FORMAT_ALIGNMENT", i18n.t("The file has no line that can be read.")],
  ["FORMAT_EMPTY", i18n.t("The file has no points.")],
  ["FORMAT_MAGIC", i18n.t("The file is no LAS or LAZ file.")],
  ["FORMAT_NOT_COPC", i18n.t("The file is no COPC file: it has to be converted first.")],
  ["FORMAT_TRUNCATED", i18n.t("The file ends too early.")],
  ["INDEX_CORE", i18n.t("What indexes scans cannot be loaded.")],
  ["INDEX_POINTS", i18n.t("The scan is too large to be indexed in the page.")],
  ["INPUT_CORRUPT", i18n.t("The file is damaged.")],
  ["INPUT_EMPTY", i18n.t("The file has no points.")],
  ["INPUT_MAGIC", i18n.t("The file is no LAS or LAZ file.")],
  ["INPUT_TRUNCATED", i18n.t("The file ends too early.")],
  ["LINK_LONG", i18n.t("The link would be too long.")],
  [
    "LINK_VERSION",
    i18n.t("The link was made by a newer version: open it with that version, or copy the link again."),
  ],
  ["MEASURE_COINCIDENT", i18n.t("Vertices lie in the same place.")],
  ["MEASURE_COLLINEAR", i18n.t("The vertices lie on a line.")],
  ["MEASURE_CROSSING", i18n.t("The outline crosses itself.")],
  ["MEASURE_DATASET", i18n.t("The scan that is needed is not open.")],
  ["MEASURE_FILE", i18n.t("The file has no measurements that can be read.")],
  ["MEASURE_GROUND", i18n.t("There are no points of the ground near enough.")],
  ["MEASURE_RECORD", i18n.t("A record that was measured is not in the scan.")],
  ["MEASURE_SURFACE", i18n.t("There are too few points for a surface.")],
  ["MEASURE_TERRAIN", i18n.t("There is no terrain at this place.")],
  [
    "MEASURE_VERSION",
    i18n.t("The measurements were saved by a newer version: open them with that version or a later one."),
  ],
  ["MEASURE_VERTICES", i18n.t("The figure has too few or too many vertices.")],
  ["MEASURE_WORKER", i18n.t("The volume cannot be worked out in the background.")],
  ["PLACE_ANGLES", i18n.t("The line cannot be placed: the coordinates of the cloud are angles.")],
  [
    "RECORD_VERSION",
    i18n.t("The file was made by a newer version: open it with that version or a later one."),
  ],
  ["SOURCE_ADDRESS", i18n.t("The address cannot be opened.")],
  ["SOURCE_CHANGED", i18n.t("The file was changed while it was being read.")],
  ["SOURCE_CORS", i18n.t("The server does not let this page read the file.")],
  ["SOURCE_DENIED", i18n.t("The server denies access to the file.")],
  ["SOURCE_EMPTY", i18n.t("The file is empty.")],
  ["SOURCE_ENCODED", i18n.t("The server sends the file compressed, and so it cannot be read in parts.")],
  ["SOURCE_EPSG", i18n.t("The tables of coordinate systems cannot be loaded.")],
  ["SOURCE_HEIGHTS", i18n.t("The data for heights cannot be loaded.")],
  ["SOURCE_HTML", i18n.t("The server sends a web page in place of the file.")],
  ["SOURCE_MODULE", i18n.t("A part of the page cannot be loaded.")],
  ["SOURCE_NETWORK", i18n.t("The server cannot be reached.")],
  ["SOURCE_NOT_FOUND", i18n.t("There is no such file on the server.")],
  ["SOURCE_NO_RANGE", i18n.t("The server does not send parts of files.")],
  ["SOURCE_TIMEOUT", i18n.t("The server did not answer in time.")],
  ["STYLE_NO_RGB", i18n.t("The scan has no colours of its own.")],
]);

/** The same by the family of the code, where the code has no sentence of its own. */
const BY_FAMILY: ReadonlyMap<string, string> = new Map([
  ["ARGUMENT", i18n.t("The page made a mistake.")],
  ["BOUNDS", i18n.t("Points lie outside of the bounds that the file states.")],
  ["CONTROL", i18n.t("The control points cannot be used.")],
  ["CRS", i18n.t("There is doubt about the coordinate system.")],
  ["DECODE", i18n.t("A part of the cloud cannot be decoded.")],
  ["DRAW", i18n.t("The points cannot be drawn.")],
  ["EXPORT", i18n.t("The file cannot be written.")],
  ["FORMAT", i18n.t("The file is damaged.")],
  ["INDEX", i18n.t("The scan cannot be indexed in the page.")],
  ["INPUT", i18n.t("The file cannot be read.")],
  ["LINK", i18n.t("The link to this view is damaged.")],
  ["MEASURE", i18n.t("This cannot be measured.")],
  ["PAGE", i18n.t("The page cannot go on.")],
  ["PLACE", i18n.t("Points cannot be placed on the globe.")],
  ["RECORD", i18n.t("What the file says of its georeference cannot be used.")],
  ["SOURCE", i18n.t("The file cannot be read.")],
  ["STYLE", i18n.t("A setting of the drawing is not valid.")],
]);

/** What an error with a code is about, in the reader's language; undefined for a code that there is not. */
export function sentenceOf(code: string): string | undefined {
  return BY_CODE.get(code) ?? BY_FAMILY.get(code.slice(0, code.indexOf("_")));
}

/**
 * The library's sentence for an error, where its own words are not in the reader's language.
 * @returns undefined where they are: in English, and for errors of the page
 */
export function sentenceFor(thrown: unknown): string | undefined {
  if (i18n.locale === "en" || thrown instanceof PageError || !(thrown instanceof GromaError))
    return undefined;
  return sentenceOf(thrown.code) ?? i18n.t("The page cannot go on.");
}

/** What went wrong, where there is room for a sentence only. */
export function shortlyOf(thrown: unknown): string {
  if (thrown instanceof GromaError) return sentenceFor(thrown) ?? thrown.cause;
  return thrown instanceof Error ? thrown.message : String(thrown);
}
