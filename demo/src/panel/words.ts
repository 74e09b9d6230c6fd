import { type Crs, EGM96, EGM96_ACCURACY, type OperationReport, type StatedAccuracy } from "@groma/georef";
import type { PointCloud } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { libraryWords } from "../language/library-words.js";
import { type Note, noteWords } from "../language/note-words.js";

/** A fact and, where there is one, a remark to it. */
export interface Words {
  readonly text: string;
  readonly note?: string;
  /** A remark of a library, which may not be in the reader's language. */
  readonly doubt?: Note;
}

/** A bound is never rounded down. */
const bound = new Intl.NumberFormat(i18n.locale, { maximumSignificantDigits: 2, roundingMode: "ceil" });

/** A count of points or nodes: `10,653,336`. */
export function countWords(count: number): string {
  return i18n.number(count, { maximumFractionDigits: 0 });
}

/** A bound in the unit that suits it, two digits, rounded up: `0.87 mm`, `4.2 cm`, `1.3 m`. */
export function lengthWords(metres: number | null): string {
  if (metres === null || !Number.isFinite(metres)) return i18n.t("not known");
  // Twelve digits take off what binary fractions add, which rounding up would carry into the last digit shown.
  const shown = (value: number) => bound.format(Number(value.toPrecision(12)));
  if (metres < 0.01) return `${shown(metres * 1000)} mm`;
  if (metres < 1) return `${shown(metres * 100)} cm`;
  return `${shown(metres)} m`;
}

/**
 * Name of a coordinate system, and its code.
 * @param given whether the reader gave it, in place of what the file says
 */
export function crsWords({ name, code }: Pick<Crs, "name" | "code">, { given }: { given: boolean }): Words {
  return {
    text: name,
    note: `${code ?? i18n.t("no code")}${given ? `; ${i18n.t("given by you, not by the file")}` : ""}`,
  };
}

/**
 * What heights are measured from, and how they are drawn.
 * @param geoids files of the geoids that take part in the placing
 * @param remark what the accuracy's part on heights says
 */
export function heightWords(
  { height, verticalUnit }: Pick<Crs, "height" | "verticalUnit">,
  { geoids, remark }: { geoids: readonly string[]; remark?: string | undefined },
): Words {
  const unit = verticalUnit.declared
    ? []
    : [i18n.t("unit not declared, taken as {unit}", { unit: libraryWords(verticalUnit.name) })];
  if (height.kind === "ellipsoidal") {
    const own = height.ellipsoid === "own" ? [i18n.t("that of the system's own datum")] : [];
    return { ...noted(i18n.t("above the ellipsoid"), [...own, ...unit]), ...doubted(height) };
  }
  if (height.kind === "unknown") {
    const said = remark?.replace(/^(reference )?unknown[:,] /, "");
    return noted(i18n.t("unknown"), [
      said === undefined ? i18n.t("drawn as ellipsoidal") : noteWords(said).text,
      ...unit,
    ]);
  }
  const code = height.epsg === undefined ? "" : ` (EPSG:${height.epsg})`;
  const model = `${height.model.replace(/ height$/i, "")}${code}`;
  const substitute = geoids.includes(EGM96) && !height.model.startsWith(EGM96);
  const worth = substitute
    ? ` ${i18n.t("instead of the national one, which may differ by up to {metres} m", { metres: EGM96_ACCURACY })}`
    : "";
  const geoid =
    geoids.length > 0
      ? i18n.t("geoid applied: {geoids}", { geoids: geoids.join(", ") }) + worth
      : i18n.t("geoid not applied: drawn as if above the ellipsoid");
  const words = noted(
    verticalUnit.size < 0
      ? i18n.t("counted downwards from {model}", { model })
      : i18n.t("above {model}", { model }),
    [geoid, ...unit],
  );
  return { ...words, ...doubted(height) };
}

function doubted({ doubt }: { readonly doubt?: string }): Pick<Words, "doubt"> {
  return doubt === undefined ? {} : { doubt: noteWords(doubt) };
}

/** What places come from. */
export function engineWords({ engine, operation }: Pick<PointCloud, "engine" | "operation">): Words {
  const { name, version } = engine;
  const text = name === "similarity" ? i18n.t("an anchor or control points") : `${name} ${version}`;
  if (!operation) return noted(text, name === "proj4js" ? [i18n.t("in this page, without grids")] : []);
  const grids =
    operation.grids.length > 0 ? [i18n.t("grids: {grids}", { grids: operation.grids.join(", ") })] : [];
  const accuracy =
    operation.accuracy === null
      ? []
      : [i18n.t("stated accuracy {length}", { length: lengthWords(operation.accuracy) })];
  return noted(text, [...accuracy, ...grids]);
}

/**
 * What a reader has to be warned of: a difference of datums that is passed over, and what the engine noted.
 * @param remark what is told with the heights already
 */
export function warningsOf(
  operation: OperationReport | undefined,
  { remark }: { remark?: string | undefined } = {},
): Note[] {
  if (!operation) return [];
  const ballpark = i18n.t("No datum shift is applied: positions may be off by hundreds of metres.");
  const notes = operation.notes.filter((note) => !(remark && note.includes(remark)));
  return [...(operation.ballpark ? [{ text: ballpark, translated: true }] : []), ...notes.map(noteWords)];
}

/** Better operations whose grids the conversion did not have. */
export function lackingWords(operation: OperationReport | undefined): Words[] {
  return (operation?.lacking ?? []).map(({ name, accuracy, grids }) =>
    noted(name, [
      ...(accuracy === null ? [] : [i18n.t("stated accuracy {length}", { length: lengthWords(accuracy) })]),
      i18n.t("lacks {grids}", { grids: grids.join(", ") || i18n.t("a grid") }),
    ]),
  );
}

/** How far from their places points are drawn; nothing where they are in them. */
export function liftWords(heightOffset: number): string {
  if (heightOffset === 0) return "";
  const metres = `${Math.abs(heightOffset).toLocaleString(i18n.locale, { maximumFractionDigits: 3 })} m`;
  return heightOffset > 0
    ? i18n.t("Drawn {metres} above its position, display only.", { metres })
    : i18n.t("Drawn {metres} below its position, display only.", { metres });
}

function noted(text: string, notes: readonly string[]): Words {
  return notes.length > 0 ? { text, note: notes.join("; ") } : { text };
}

/** The sum of an accuracy's parts, or what of it is known. */
export function accuracyWords({ total, parts }: StatedAccuracy): Words {
  if (total !== null) return { text: lengthWords(total), note: i18n.t("sum of the parts") };
  const known = parts.reduce((sum, { metres }) => sum + (metres ?? 0), 0);
  const missing = parts.filter(({ metres }) => metres === null).map(({ name }) => name);
  return {
    text: i18n.t("not known"),
    note: i18n.t("{length} without {parts}", {
      length: lengthWords(known),
      parts: new Intl.ListFormat(i18n.locale, { type: "conjunction" }).format(missing.map(libraryWords)),
    }),
  };
}
