import { extname } from "node:path";
import type { ByteSink, ExportOptions, PointSelection } from "@groma/layer/export";
import { compressFile } from "../core/core.js";
import { OptionError } from "../given/option-error.js";
import { writeFile } from "./output-file.js";

/** How a cut is written. */
export interface CutOptions {
  readonly out: string;
  readonly overwrite?: boolean | undefined;
  /** Adds chainage and offset to the records of LAS and LAZ. */
  readonly chainage?: boolean | undefined;
  /** Lays the points of DXF along the straightened line. */
  readonly straightened?: boolean | undefined;
}

/** Writes the points of selections into an unfinished file. @returns number of points */
type Write = (
  selections: readonly PointSelection[],
  unfinished: string,
  options: ExportOptions & CutOptions,
) => Promise<number>;

interface Writer {
  readonly write: Write;
  /** Whether it writes longitudes and latitudes. */
  readonly placed?: true;
}

type Library = typeof import("@groma/layer/export");

/** A writer through a sink. */
function through(
  fill: (
    library: Library,
    selections: readonly PointSelection[],
    sink: ByteSink,
    options: ExportOptions & CutOptions,
  ) => Promise<number>,
): Write {
  return async (selections, unfinished, options) => {
    const library = await import("@groma/layer/export");
    return writeFile(unfinished, (sink) => fill(library, selections, sink, options));
  };
}

const writeLas = through(({ exportLas }, selections, sink, options) => exportLas(selections, sink, options));

/** LAS beside the output, which the core then compresses. */
const writeLaz: Write = async (selections, unfinished, options) => {
  const uncompressed = `${unfinished}.las`;
  const points = await writeLas(selections, uncompressed, options);
  if (points > 0) await compressFile(uncompressed, unfinished, options.signal);
  return points;
};

/** Formats by the ending of the output's name. */
const WRITERS: ReadonlyMap<string, Writer> = new Map<string, Writer>([
  [".las", { write: writeLas }],
  [".laz", { write: writeLaz }],
  [".csv", { write: through(({ exportCsv }, ...parts) => exportCsv(...parts)) }],
  [".geojson", { write: through(({ exportGeoJson }, ...parts) => exportGeoJson(...parts)), placed: true }],
  [
    ".dxf",
    {
      write: through(({ exportDxf }, selections, sink, { straightened, ...options }) =>
        exportDxf(selections, sink, { ...options, layout: straightened ? "straightened" : "space" }),
      ),
    },
  ],
]);

/** The writer of the format that an output's name ends in. @throws OptionError OPTION_FORMAT */
export function writerOf(out: string): Writer {
  const writer = WRITERS.get(extname(out).toLowerCase());
  if (writer) return writer;
  throw new OptionError({
    code: "OPTION_FORMAT",
    file: out,
    cause: "the ending of its name says no format that is written",
    fix: `let it end in ${[...WRITERS.keys()].join(", ")}`,
  });
}
