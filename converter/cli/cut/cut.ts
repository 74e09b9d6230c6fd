import { GromaError } from "@groma/georef";
import type { ExportProgress, PointSelection } from "@groma/layer/export";
import { type OpenedPoints, openPoints } from "../files/points.js";
import { requirePlace } from "../given/output-place.js";
import { writeWhole } from "./output-file.js";
import { geodeticOf } from "./place.js";
import { type CutOptions, writerOf } from "./writers.js";

/** No point is where points are asked for. Code: SELECTION_EMPTY. */
class SelectionError extends GromaError {
  static override readonly kind = "SelectionError";
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
  options: CutOptions,
  onProgress: (progress: ExportProgress) => void,
  signal: AbortSignal,
): Promise<Cut> {
  const { out, overwrite = false, chainage, straightened } = options;
  const began = performance.now();
  const writer = writerOf(options.out);
  requirePlace(out, overwrite);
  const opened: OpenedPoints[] = [];
  try {
    const selections: PointSelection[] = [];
    for (const input of inputs) {
      const one = await openPoints(input, signal);
      opened.push(one);
      const selection = await select(one.points);
      selections.push(writer.placed ? { ...selection, geodetic: await geodeticOf(one.points) } : selection);
    }
    let [points, read] = [0, 0];
    await writeWhole(out, overwrite, async (unfinished) => {
      const told = (progress: ExportProgress) => {
        read = progress.read;
        onProgress(progress);
      };
      points = await writer.write(selections, unfinished, {
        out,
        chainage,
        straightened,
        signal,
        onProgress: told,
      });
      if (points === 0) throw empty(out);
    });
    return { output: out, points, read, inputs: inputs.length, seconds: (performance.now() - began) / 1000 };
  } finally {
    await Promise.all(opened.map((one) => one.close()));
  }
}

function empty(out: string): SelectionError {
  return new SelectionError({
    code: "SELECTION_EMPTY",
    file: out,
    cause: "no point of the inputs is where points are asked for; nothing was written",
    fix: "check the line or the area, and in which coordinates it is given",
  });
}
