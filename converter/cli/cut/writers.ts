import { readFile, rm, writeFile as writeBytes } from "node:fs/promises";
import { extname } from "node:path";
import type {
  AlongLine,
  ByteSink,
  CutFacts,
  DatedOptions,
  ExportOptions,
  GroundOptions,
  PictureScale,
  PointSelection,
  SectionFormat,
  SectionSelection,
} from "@groma/layer/export";
import { compressFile } from "../core/core.js";
import { OptionError } from "../given/option-error.js";
import { BlockFile } from "./block-file.js";
import { writeFile } from "./output-file.js";

/** What documents show of the points and their line. */
export interface ShownOptions extends Pick<DatedOptions, "paint"> {
  /** Where stations are counted anew, and the stations that follow. */
  readonly equations?: DatedOptions["equations"];
  readonly stationOf?: ((chainage: number) => number) | undefined;
}

/** How a cut is written. */
export interface CutOptions extends PictureScale {
  readonly out: string;
  readonly overwrite?: boolean | undefined;
  /** Adds chainage and offset to the records of LAS and LAZ. */
  readonly chainage?: boolean | undefined;
  /** Lays the points of DXF along the straightened line. */
  readonly straightened?: boolean | undefined;
  /** The ground that documents show. */
  readonly ground?: GroundOptions | undefined;
  /** Files of each cross-section in an archive. */
  readonly files?: readonly SectionFormat[] | undefined;
}

/** What is written: points as they are selected, or as they lie in cross-sections of a line. */
export type CutSelection = PointSelection | (SectionSelection & { readonly line: AlongLine });

/** What a cut is written with, whatever the format. */
export interface WriteOptions
  extends ExportOptions,
    CutOptions,
    ShownOptions,
    Pick<DatedOptions, "onGround"> {
  readonly facts: CutFacts;
}

/** Writes the points of selections into an unfinished file. @returns number of points */
type Write<Selection> = (
  selections: readonly Selection[],
  unfinished: string,
  options: WriteOptions,
) => Promise<number>;

interface Writer {
  readonly write: Write<CutSelection>;
  /** Whether it writes longitudes and latitudes. */
  readonly placed?: ((options: CutOptions) => boolean) | undefined;
  /** Whether it says things of the coordinates. */
  readonly documents?: true;
  /** Whether it names stations of the line. */
  readonly stations?: true;
}

type Library = typeof import("@groma/layer/export");

/** A writer through a sink. */
function through<Selection>(
  fill: (
    library: Library,
    selections: readonly Selection[],
    sink: ByteSink,
    options: WriteOptions,
  ) => Promise<number>,
): Write<CutSelection> {
  return async (selections, unfinished, options) => {
    const library = await import("@groma/layer/export");
    return writeFile(unfinished, (sink) => fill(library, selections as readonly Selection[], sink, options));
  };
}

const writeLas = through<PointSelection>(({ exportLas }, selections, sink, options) =>
  exportLas(selections, sink, options),
);

/** LAS beside the output, which the core then compresses. */
const writeLaz: Write<CutSelection> = async (selections, unfinished, options) => {
  const uncompressed = `${unfinished}.las`;
  const points = await writeLas(selections, uncompressed, options);
  if (points > 0) await compressFile(uncompressed, unfinished, options.signal);
  return points;
};

const picture = (format: "pdf" | "svg"): Writer => ({
  write: through<PointSelection>(({ exportPicture }, selections, sink, options) =>
    exportPicture(selections, sink, { ...options, format }),
  ),
  documents: true,
});

/** Formats by the ending of the output's name. */
const POINTS: ReadonlyMap<string, Writer> = new Map<string, Writer>([
  [".las", { write: writeLas }],
  [".laz", { write: writeLaz }],
  [".csv", { write: through<PointSelection>(({ exportCsv }, ...parts) => exportCsv(...parts)) }],
  [
    ".geojson",
    {
      write: through<PointSelection>(({ exportGeoJson }, ...parts) => exportGeoJson(...parts)),
      placed: () => true,
    },
  ],
  [
    ".dxf",
    {
      write: through<PointSelection>(({ exportDxf }, selections, sink, { straightened, ...options }) =>
        exportDxf(selections, sink, { ...options, layout: straightened ? "straightened" : "space" }),
      ),
      stations: true,
    },
  ],
  [".svg", picture("svg")],
  [".pdf", picture("pdf")],
  [
    ".xml",
    {
      write: through<PointSelection>(({ exportLandXml }, ...parts) => exportLandXml(...parts)),
      documents: true,
    },
  ],
]);

/** A writer of cross-sections, whose points wait in a file beside the output. */
function ofSections(
  fill: (
    library: Library,
    selections: readonly SectionSelection[],
    sink: ByteSink,
    options: WriteOptions & {
      readonly line: AlongLine;
      readonly store: BlockFile;
      readonly unfinished: string;
    },
  ) => Promise<number>,
): Write<CutSelection> {
  return async (selections, unfinished, options) => {
    const library = await import("@groma/layer/export");
    const store = await BlockFile.create(`${unfinished}.blocks`);
    const sections = selections as readonly (SectionSelection & { readonly line: AlongLine })[];
    try {
      const { line } = sections[0]!;
      return await writeFile(unfinished, (sink) =>
        fill(library, sections, sink, { ...options, line, store, unfinished }),
      );
    } finally {
      await store.close();
    }
  };
}

/** Has the core compress a LAS file that is held in memory. */
const compressor = (unfinished: string, signal: AbortSignal | undefined) => async (las: Uint8Array) => {
  const [from, to] = [`${unfinished}.las`, `${unfinished}.laz`];
  await writeBytes(from, las);
  await compressFile(from, to, signal);
  const bytes = await readFile(to);
  await rm(to);
  await rm(from, { force: true });
  return new Uint8Array(bytes);
};

const SECTIONS: ReadonlyMap<string, Writer> = new Map<string, Writer>([
  [
    ".zip",
    {
      write: ofSections(({ exportSections }, selections, sink, { unfinished, ...options }) =>
        exportSections(selections, sink, { ...options, compress: compressor(unfinished, options.signal) }),
      ),
      placed: ({ files }) => files?.includes("geojson") ?? false,
      documents: true,
    },
  ],
  [
    ".pdf",
    {
      write: ofSections(({ exportSectionSheets }, ...parts) => exportSectionSheets(...parts)),
      documents: true,
    },
  ],
  [
    ".xml",
    {
      write: ofSections(({ exportSectionLandXml }, ...parts) => exportSectionLandXml(...parts)),
      documents: true,
    },
  ],
]);

/**
 * The writer of the format that an output's name ends in.
 * @param sections whether cross-sections are written
 * @throws OptionError OPTION_FORMAT
 */
export function writerOf(out: string, sections: boolean): Writer {
  const writers = sections ? SECTIONS : POINTS;
  const writer = writers.get(extname(out).toLowerCase());
  if (writer) return writer;
  throw new OptionError({
    code: "OPTION_FORMAT",
    file: out,
    cause: `the ending of its name says no format that ${sections ? "cross-sections are" : "is"} written in`,
    fix: `let it end in ${[...writers.keys()].join(", ")}`,
  });
}
