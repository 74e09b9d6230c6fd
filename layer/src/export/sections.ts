import { Pace } from "../query/index.js";
import { stationText } from "../tools/sections/station.js";
import { type ArchiveEntry, writeArchive } from "./archive.js";
import { BlobStore, type BlockStore } from "./block-store.js";
import { BlockSink, type ByteSink } from "./byte-sink.js";
import { collectParts } from "./collect.js";
import { exportCsv } from "./csv.js";
import { type DatedOptions, spanOf, USUAL_GROUND } from "./documents.js";
import { exportDxf } from "./dxf.js";
import { exportGeoJson } from "./geojson.js";
import { drawSheet, groundInWords, groundOf } from "./ground.js";
import { type LandXmlContent, type LandXmlSection, landXmlOf } from "./landxml.js";
import { writeLas } from "./las.js";
import { PlainBody } from "./las-body.js";
import { LasFrames } from "./las-file.js";
import { pdfOf } from "./picture/pdf.js";
import type { Sheet } from "./picture/sheet.js";
import { svgOf } from "./picture/svg.js";
import type { AlongLine, PartedSelection, PartedVolume, PointSelection } from "./selection.js";
import { areInOneSystem } from "./systems.js";
import { TextSink } from "./text-sink.js";

/** A cross-section, as `CrossSections` of `@groma/layer/tools` has it. */
export interface SectionPlace {
  readonly station: number;
  /** x and y on the line, source units. */
  readonly centre: readonly [number, number];
  /** From its left end to its right one; chainages are distances from the line, right positive. */
  readonly strip: AlongLine;
}

/** Cross-sections of one line. */
export interface SectionSet extends PartedVolume {
  readonly sections: readonly SectionPlace[];
}

/** Files that are made of each section. */
export type SectionFormat = "las" | "laz" | "csv" | "geojson" | "dxf" | "svg" | "pdf";

/** How cross-sections are written. */
export interface SectionOptions extends DatedOptions {
  /** The line that they cross. */
  readonly line: AlongLine;
  /** Stations as they are written, by chainage: those of station equations. Default: the chainage itself. */
  readonly stationOf?: ((chainage: number) => number) | undefined;
  /** The station equations behind them, for LandXML. */
  readonly equations?: LandXmlContent["equations"];
  /** Keeps points between reading and writing. Default: in `Blob`s. */
  readonly store?: BlockStore | undefined;
}

/** How an archive of them is written. */
export interface SectionArchiveOptions extends SectionOptions {
  /** Files of each section. Default: LAS and SVG. */
  readonly files?: readonly SectionFormat[] | undefined;
  /** Compresses a LAS file to LAZ; needed for `laz`. */
  readonly compress?: ((las: Uint8Array) => Promise<Uint8Array>) | undefined;
}

/** Points of data sets, all with the same sections. */
export type SectionSelection = Omit<PartedSelection, "volume"> & { readonly volume: SectionSet };

/** A section whose points were read. */
interface ReadSection {
  readonly name: string;
  readonly place: SectionPlace;
  readonly selections: readonly PointSelection[];
  /** Whether points of several systems are cut, be it in other sections. */
  readonly mixed: boolean;
}

/**
 * Writes cross-sections as one ZIP archive: the files asked for of each, `sections.csv` with their places, and
 * `sections.xml`, LandXML 1.2 of all of them. Points are read in one pass over the data sets, whatever the number of sections
 * is; those of LAS are in the order in which an export of the section alone writes them.
 *
 * DXF is straightened: x is the distance from the line, right positive, y the height, z the distance ahead of the station.
 *
 * @returns number of points in all sections, each as often as sections have it
 * @throws FormatError EXPORT_NO_LAS, EXPORT_PICTURE; RangeError where a scale or the ground's options are none
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what the sink throws
 */
export async function exportSections(
  selections: readonly SectionSelection[],
  sink: ByteSink,
  options: SectionArchiveOptions,
): Promise<number> {
  const { files = ["las", "svg"], date = new Date() } = options;
  const sections = await readSections(selections, options);
  const counts: number[] = [];
  const grounds: LandXmlSection[] = [];
  const made = new SectionFiles(options);
  async function* entries(): AsyncGenerator<ArchiveEntry> {
    for await (const section of inTurn(sections, options)) {
      const { name, selections: own, place } = section;
      counts.push(await countOf(own));
      grounds.push(await groundOfSection(section, options));
      if (own.length === 0) continue;
      for (const format of files) {
        yield {
          name: `section-${name}_${stationOf(place, options)}.${format}`,
          content: await made.make(section, format),
        };
      }
    }
    yield { name: "sections.csv", content: listOf(sections, counts, options) };
    yield { name: "sections.xml", content: [...landXml(grounds, { ...options, date })].join("") };
  }
  await writeArchive(entries(), sink, date);
  return counts.reduce((sum, count) => sum + count, 0);
}

/**
 * Writes cross-sections as one PDF, a page each, to scale. Sections without points have none.
 * @returns number of points in all sections
 * @throws as {@link exportSections}
 */
export async function exportSectionSheets(
  selections: readonly SectionSelection[],
  sink: ByteSink,
  options: SectionOptions,
): Promise<number> {
  const sections = await readSections(selections, options);
  let count = 0;
  async function* sheets(): AsyncGenerator<Sheet> {
    for await (const section of inTurn(sections, options)) {
      if (section.selections.length === 0) continue;
      count += await countOf(section.selections);
      yield await sheetOf(section, options);
    }
  }
  const bytes = await pdfOf(sheets(), options.facts.title);
  if (count > 0) await sink.write(bytes);
  return count;
}

/**
 * Writes cross-sections as LandXML 1.2: the line, and the ground of each section.
 * @returns number of points in all sections
 * @throws as {@link exportSections}
 */
export async function exportSectionLandXml(
  selections: readonly SectionSelection[],
  sink: ByteSink,
  options: SectionOptions,
): Promise<number> {
  const sections = await readSections(selections, options);
  const grounds: LandXmlSection[] = [];
  let count = 0;
  for await (const section of inTurn(sections, options)) {
    count += await countOf(section.selections);
    grounds.push(await groundOfSection(section, options));
  }
  const text = new TextSink(sink);
  for (const part of landXml(grounds, options)) {
    text.add(part);
    await text.rest();
  }
  await text.end();
  return count;
}

async function readSections(
  selections: readonly SectionSelection[],
  { store = new BlobStore(), signal, onProgress, onLeftOut }: SectionOptions,
): Promise<ReadSection[]> {
  // Data sets of several systems have each section in their own coordinates.
  const parts = await collectParts(
    selections,
    store,
    { signal, onProgress, onLeftOut },
    ({ volume }, part) => volume.sections[part].strip,
  );
  const { sections } = selections[0].volume;
  const mixed = !areInOneSystem(selections);
  return sections.map((place, index) => {
    const number = String(index + 1).padStart(String(sections.length).length, "0");
    return { name: number, place, selections: parts[index], mixed };
  });
}

/** Sections one after the other, between which others have the thread. @throws the signal's reason when aborted */
async function* inTurn(
  sections: readonly ReadSection[],
  { signal }: SectionOptions,
): AsyncGenerator<ReadSection> {
  const pace = new Pace(signal);
  for (const section of sections) {
    signal?.throwIfAborted();
    yield section;
    await pace.rest();
  }
}

async function countOf(selections: readonly PointSelection[]): Promise<number> {
  let count = 0;
  for (const { origin } of selections) count += (await origin.query().bracket()).least;
  return count;
}

/** What a reader calls a section: its number and its station. */
function titleOf({ name, place }: ReadSection, options: SectionOptions): string {
  return `${options.facts.title}, section ${name}, station ${stationOf(place, options)}`;
}

/** The station of a section as it is written. */
function stationOf(
  { station }: SectionPlace,
  { stationOf: of = (chainage) => chainage }: SectionOptions,
): string {
  return stationText(of(station), 3);
}

async function groundOfSection(section: ReadSection, options: SectionOptions): Promise<LandXmlSection> {
  const { place, selections, name } = section;
  const { ground = USUAL_GROUND, signal, onGround } = options;
  const runs = await groundOf(selections, spanOf(place.strip), ground, { signal, onGround });
  return { station: place.station, name: `section ${name}`, ground: runs };
}

function landXml(sections: readonly LandXmlSection[], options: SectionOptions): Generator<string> {
  const { facts, line, ground = USUAL_GROUND, date = new Date(), equations } = options;
  return landXmlOf({ facts, line, sections, equations, method: groundInWords(ground, facts.unit), date });
}

async function sheetOf(section: ReadSection, options: SectionOptions): Promise<Sheet> {
  const axis = { word: "distance from the line, right positive" };
  const quiet = { ...options, onProgress: undefined };
  const span = spanOf(section.place.strip);
  return (await drawSheet(section.selections, span, titleOf(section, options), axis, quiet)).sheet;
}

/** Makes the files of sections one after the other, in a block that is used again for the next one. */
class SectionFiles {
  readonly #options: SectionArchiveOptions;
  readonly #block = new BlockSink();
  readonly #frames = new LasFrames();

  constructor(options: SectionArchiveOptions) {
    this.#options = options;
  }

  /** @returns what is the caller's until the next file is made */
  async make(section: ReadSection, format: SectionFormat): Promise<ArchiveEntry["content"]> {
    const { selections } = section;
    const options = this.#options;
    const { signal, compress } = options;
    switch (format) {
      case "svg":
        return svgOf(await sheetOf(section, options));
      case "pdf":
        return pdfOf([await sheetOf(section, options)], titleOf(section, options));
      case "las":
        return this.#las(selections);
      case "laz": {
        if (!compress) throw new RangeError("this program does not compress LAS");
        return compress(await this.#las(selections));
      }
      case "csv":
        return this.#inBlock((sink) => exportCsv(selections, sink, { signal, systems: section.mixed }));
      case "geojson":
        return this.#inBlock((sink) => exportGeoJson(selections, sink, { signal }));
      case "dxf":
        return this.#inBlock((sink) => exportDxf(selections, sink, { signal, layout: "straightened" }));
    }
  }

  #las(selections: readonly PointSelection[]): Promise<Uint8Array> {
    const { signal } = this.#options;
    return this.#inBlock((sink) =>
      writeLas(selections, sink, { signal }, async () => new PlainBody(sink), this.#frames),
    );
  }

  async #inBlock(fill: (sink: ByteSink) => Promise<unknown>): Promise<Uint8Array> {
    this.#block.clear();
    await fill(this.#block);
    return this.#block.bytes();
  }
}

/** Places of all sections as CSV, with every digit, so that anyone can cut them again. */
function listOf(
  sections: readonly ReadSection[],
  counts: readonly number[],
  options: SectionOptions,
): string {
  const rows = sections.map(({ name, place }, index) => {
    const { vertices } = place.strip;
    const numbers = [place.station, ...place.centre, ...vertices[0], ...vertices[1], counts[index]];
    return `${name},${stationOf(place, options)},${numbers.join(",")}`;
  });
  const names = "section,station,chainage,x,y,left_x,left_y,right_x,right_y,points";
  return `${[names, ...rows].join("\r\n")}\r\n`;
}
