import { realpath } from "node:fs/promises";
import { basename } from "node:path";
import { GromaError } from "@groma/georef";
import type { CutFacts, ExportProgress } from "@groma/layer/export";
import { classesOf } from "@groma/layer/query";
import { type OpenedPoints, openPoints } from "../files/points.js";
import { requirePlace } from "../given/output-place.js";
import { classesInWords } from "../terminal/class-names.js";
import { writeWhole } from "./output-file.js";
import { factsOf, geodeticOf, systemOf } from "./place.js";
import {
  type CutOptions,
  type CutSelection,
  type ShownOptions,
  type WriteOptions,
  writerOf,
} from "./writers.js";

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

/** What is wanted of files. */
export interface CutRequest {
  /** What the result is called in documents. Default: as the first input. */
  readonly title?: string | undefined;
  /** Files with the line, the area, the clips, which must not be the output. */
  readonly given: readonly (string | undefined)[];
  /** Whether cross-sections are selected. */
  readonly sections?: true | undefined;
  /** Says what is wanted of an opened file, given all of them. */
  readonly select: (
    opened: OpenedPoints["points"],
    all: readonly OpenedPoints["points"][],
  ) => Promise<CutSelection>;
  /** What documents say of the coordinates, where that is not what the first file says. */
  readonly facts?: ((known: CutFacts) => CutFacts) | undefined;
  /** What documents say and show of what is selected. Default: chainages, the scan's own colours. */
  readonly shown?: (() => Promise<ShownOptions>) | undefined;
}

/** Who is told how far a cut is, and what may not be as it is wanted. */
export interface CutListener {
  readonly onProgress: (progress: ExportProgress) => void;
  readonly onWarning: (text: string) => void;
}

/**
 * Writes what is selected of files into one file, which stands whole or not at all.
 *
 * @throws OptionError OPTION_FORMAT; OutputError; InputFileError, SourceError, FormatError, DecodeError
 * @throws SelectionError SELECTION_EMPTY; what the request's `select` throws; the signal's reason when aborted
 */
export async function cut(
  inputs: readonly string[],
  request: CutRequest,
  options: CutOptions,
  { onProgress, onWarning }: CutListener,
  signal: AbortSignal,
): Promise<Cut> {
  const { out, overwrite = false, ground } = options;
  const { select, sections, title, given } = request;
  const began = performance.now();
  const writer = writerOf(out, sections ?? false);
  requirePlace(out, overwrite, [...inputs, ...given]);
  const opened: OpenedPoints[] = [];
  try {
    const selections: CutSelection[] = [];
    for (const input of await different(inputs)) opened.push(await openPoints(input, signal));
    const all = opened.map(({ points }) => points);
    for (const one of all) {
      const selection = await select(one, all);
      const geodetic = writer.placed?.(options) ? { geodetic: await geodeticOf(one) } : {};
      const crs = all.length > 1 ? await systemOf(one) : undefined;
      selections.push({ ...selection, ...geodetic, crs });
    }
    const named = title ?? basename(inputs[0]!);
    const unknown = { text: "units", size: 1 };
    const facts: CutFacts = writer.documents
      ? (request.facts ?? asKnown)(await factsOf(opened[0]!.points, named))
      : { title: named, unit: unknown, heightUnit: unknown };
    let [points, read] = [0, 0];
    const classes = new ClassesFound();
    const told = (progress: ExportProgress) => {
      read = progress.read;
      onProgress(progress);
    };
    await writeWhole(out, overwrite, async (unfinished) => {
      const shown = (writer.documents || writer.stations) && (await request.shown?.());
      const { onGround, onLeftOut } = classes;
      const how = { ...options, ...shown, facts, signal, onProgress: told, onGround, onLeftOut };
      points = await writer.write(selections, unfinished, how);
      if (points === 0) throw empty(out, classes.leftOut);
    });
    const others = classes.instead;
    if (ground?.classes && others) {
      const asked = classesInWords(ground.classes);
      onWarning(`${out} has no ground: no point is of class ${asked}; there are ${classesInWords(others)}`);
    }
    return { output: out, points, read, inputs: opened.length, seconds: (performance.now() - began) / 1000 };
  } finally {
    await Promise.all(opened.map((one) => one.close()));
  }
}

/** What is found of the classes of points, for those who asked for classes that are not there. */
class ClassesFound {
  /** Of the points that lie where they are asked for, where classes and filter leave none. */
  readonly leftOut = new Set<number>();
  readonly #others = new Set<number>();
  #ground = 0;

  readonly onLeftOut: NonNullable<WriteOptions["onLeftOut"]> = (batch) => {
    for (const one of classesOf(batch)) this.leftOut.add(one);
  };

  readonly onGround: NonNullable<WriteOptions["onGround"]> = ({ points, others }) => {
    this.#ground += points;
    for (const one of others) this.#others.add(one);
  };

  /** Classes of the points that are there, where none is of the ground; undefined where some are. */
  get instead(): ReadonlySet<number> | undefined {
    return this.#ground === 0 && this.#others.size > 0 ? this.#others : undefined;
  }
}

/** Inputs without those that are another's file once more, which would give its points twice. */
async function different(inputs: readonly string[]): Promise<string[]> {
  const paths = await Promise.all(inputs.map((input) => realpath(input).catch(() => input)));
  return inputs.filter((_, index) => paths.indexOf(paths[index]!) === index);
}

const asKnown = (facts: CutFacts): CutFacts => facts;

/** @param leftOut classes of the points that lie where they are asked for */
function empty(out: string, leftOut: ReadonlySet<number>): SelectionError {
  if (leftOut.size > 0) {
    return new SelectionError({
      code: "SELECTION_EMPTY",
      file: out,
      cause: `classes, returns and ranges leave none of the points there, whose classes are ${classesInWords(leftOut)}; nothing was written`,
      fix: "ask for classes, returns and values that are there",
    });
  }
  return new SelectionError({
    code: "SELECTION_EMPTY",
    file: out,
    cause: "no point of the inputs is where points are asked for; nothing was written",
    fix: "check the line or the area, and in which coordinates it is given",
  });
}
