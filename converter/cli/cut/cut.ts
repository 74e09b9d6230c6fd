import { extname } from "node:path";
import { GromaError } from "@groma/georef";
import type { ExportOptions, ExportProgress, PointSelection } from "@groma/layer/export";
import { type OpenedPoints, openPoints } from "../files/points.js";
import { OptionError } from "../given/option-error.js";
import { requirePlace } from "../given/output-place.js";
import { writeFile, writeWhole } from "./output-file.js";

/** No point is where points are asked for. Code: SELECTION_EMPTY. */
class SelectionError extends GromaError {
  static override readonly kind = "SelectionError";
}

/** How a cut is written. */
export interface CutOptions {
  readonly out: string;
  readonly overwrite?: boolean | undefined;
  /** Adds chainage and offset to the records of LAS. */
  readonly chainage?: boolean | undefined;
}

/** What was written. */
export interface Cut {
  readonly output: string;
  /** Points that were written. */
  readonly points: number;
  /** Points of the nodes that were read. */
  readonly read: number;
  readonly inputs: number;
  readonly seconds: number;
}

/** Writes the points of selections into an unfinished file. @returns number of points */
type Writer = (
  selections: readonly PointSelection[],
  unfinished: string,
  options: ExportOptions & Pick<CutOptions, "chainage">,
) => Promise<number>;

/** Formats by the ending of the output's name. */
const WRITERS: ReadonlyMap<string, Writer> = new Map([[".las", writeLas]]);

async function writeLas(...[selections, unfinished, options]: Parameters<Writer>): Promise<number> {
  const { exportLas } = await import("@groma/layer/export");
  return writeFile(unfinished, (sink) => exportLas(selections, sink, options));
}

/**
 * Writes what is selected of files into one file, which stands whole or not at all.
 *
 * @param select says what is wanted of an opened file
 * @throws OptionError OPTION_FORMAT; OutputError; InputFileError, SourceError, FormatError, DecodeError
 * @throws SelectionError SELECTION_EMPTY; what `select` throws; the signal's reason when aborted
 */
export async function cut(
  inputs: readonly string[],
  select: (opened: OpenedPoints["points"]) => Promise<PointSelection>,
  { out, overwrite = false, chainage }: CutOptions,
  onProgress: (progress: ExportProgress) => void,
  signal: AbortSignal,
): Promise<Cut> {
  const began = performance.now();
  const writer = WRITERS.get(extname(out).toLowerCase());
  if (!writer) throw unknownFormat(out);
  requirePlace(out, overwrite);
  const opened: OpenedPoints[] = [];
  try {
    const selections: PointSelection[] = [];
    for (const input of inputs) {
      const one = await openPoints(input, signal);
      opened.push(one);
      selections.push(await select(one.points));
    }
    let [points, read] = [0, 0];
    await writeWhole(out, overwrite, async (unfinished) => {
      const told = (progress: ExportProgress) => {
        read = progress.read;
        onProgress(progress);
      };
      points = await writer(selections, unfinished, { signal, onProgress: told, chainage });
      if (points === 0) throw empty(out);
    });
    return { output: out, points, read, inputs: inputs.length, seconds: (performance.now() - began) / 1000 };
  } finally {
    await Promise.all(opened.map((one) => one.close()));
  }
}

function unknownFormat(out: string): OptionError {
  return new OptionError({
    code: "OPTION_FORMAT",
    file: out,
    cause: "the ending of its name says no format that is written",
    fix: `let it end in ${[...WRITERS.keys()].join(", ")}`,
  });
}

function empty(out: string): SelectionError {
  return new SelectionError({
    code: "SELECTION_EMPTY",
    file: out,
    cause: "no point of the inputs is where points are asked for; nothing was written",
    fix: "check the line or the area, and in which coordinates it is given",
  });
}
