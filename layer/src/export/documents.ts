import { FormatError } from "../errors/index.js";
import type { ByteSink } from "./byte-sink.js";
import {
  type DocumentOptions,
  drawSheet,
  type GroundOptions,
  groundInWords,
  groundOf,
  thinnedInWords,
} from "./ground.js";
import { type LandXmlContent, type LandXmlSection, landXmlOf } from "./landxml.js";
import { pdfOf } from "./picture/pdf.js";
import { svgOf } from "./picture/svg.js";
import { type AlongLine, type PointSelection, spacingOf } from "./selection.js";
import { TextSink } from "./text-sink.js";

/** The ground of documents that have to have one, in units of the chainage. */
export const USUAL_GROUND: GroundOptions = { interval: 1 };

/** How the picture of a profile is written. */
export interface PictureFileOptions extends DocumentOptions {
  /** Both true to scale. */
  readonly format: "pdf" | "svg";
  /** Stations as they stand at the axis, by chainage: those of station equations. Default: the axis has chainages. */
  readonly stationOf?: ((chainage: number) => number) | undefined;
}

/**
 * Writes the picture of a profile, to scale: chainage and height in the units of the data set, every point a dot in its own
 * colour, or as a layer of the style given has it, the ground as a line where it is asked for.
 *
 * @param selections with the same line
 * @returns number of points that lie along the line, 0 where nothing was written
 * @throws FormatError EXPORT_NO_LINE, EXPORT_PICTURE; RangeError where a scale or the ground's options are none
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what the sink throws
 */
export async function exportPicture(
  selections: readonly PointSelection[],
  sink: ByteSink,
  options: PictureFileOptions,
): Promise<number> {
  const line = lineOf(selections);
  const { told, count } = counting(options);
  const { stationOf } = options;
  const axis = { word: stationOf ? "station" : "chainage", stationOf };
  const { sheet } = await drawSheet(selections, spanOf(line), options.facts.title, axis, told);
  const bytes =
    options.format === "svg"
      ? new TextEncoder().encode(svgOf(sheet))
      : await pdfOf([sheet], options.facts.title);
  if (count() > 0) await sink.write(bytes);
  return count();
}

/** When documents were made, for those that say it. */
export interface DatedOptions extends DocumentOptions {
  /** Of the line, for LandXML. */
  readonly equations?: LandXmlContent["equations"];
  /** Default: now. */
  readonly date?: Date | undefined;
}

/**
 * Writes a profile as LandXML 1.2: its line and the ground along it.
 *
 * @param sections cross-sections that go with it
 * @returns number of points that were read for it
 * @throws as {@link exportPicture}
 */
export async function exportLandXml(
  selections: readonly PointSelection[],
  sink: ByteSink,
  options: DatedOptions,
  sections: readonly LandXmlSection[] = [],
): Promise<number> {
  const line = lineOf(selections);
  const { told, count } = counting(options);
  const { facts, ground: wanted = USUAL_GROUND, date = new Date() } = options;
  const ground = await groundOf(selections, spanOf(line), wanted, told);
  const text = new TextSink(sink);
  const spacing = spacingOf(selections);
  const thinned = spacing > 0 ? `; ${thinnedInWords(spacing, facts.unit)}` : "";
  const method = `${groundInWords(wanted, facts.unit)}${thinned}`;
  for (const part of landXmlOf({
    facts,
    line,
    ground,
    sections,
    equations: options.equations,
    method,
    date,
  })) {
    text.add(part);
    await text.rest();
  }
  await text.end();
  return count();
}

/** The line of the selections. @throws FormatError EXPORT_NO_LINE where they have none */
function lineOf(selections: readonly PointSelection[]): AlongLine {
  const line = selections.find(({ along }) => along)?.along;
  if (line) return line;
  throw new FormatError({
    code: "EXPORT_NO_LINE",
    file: selections[0]?.origin.name ?? "",
    cause: "a picture needs a line, and its points lie along none",
    fix: "Export a profile, or cross-sections",
  });
}

/** Both ends of a line, by chainage. */
export function spanOf({ chainages }: AlongLine): { readonly from: number; readonly to: number } {
  return { from: chainages[0], to: chainages[chainages.length - 1] };
}

/** Counts the points while they are told of. */
function counting<T extends DocumentOptions>(options: T): { readonly told: T; readonly count: () => number } {
  let count = 0;
  const onProgress: DocumentOptions["onProgress"] = (progress) => {
    count = progress.written;
    options.onProgress?.(progress);
  };
  return { told: { ...options, onProgress }, count: () => count };
}
