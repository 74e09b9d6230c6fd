import { GromaError } from "@groma/georef";
import { DrawError } from "../errors/index.js";

/** What failed while frames were drawn: a view must go on, and is told of each failure once, not in every frame. */
export class FrameFailures {
  readonly #known = new Set<string>();

  /**
   * Takes what was thrown, undefined for nothing.
   * @param file the data set's name
   * @returns what is to be told; undefined where it is known
   */
  note(thrown: unknown, file: string): Error | undefined {
    if (thrown === undefined) return undefined;
    const error = thrown instanceof GromaError ? thrown : asDrawError(thrown, file);
    if (this.#known.has(error.message)) return undefined;
    // Messages may hold numbers that differ from frame to frame: past a few, one more is no news.
    if (this.#known.size >= MOST) return undefined;
    this.#known.add(error.message);
    return error;
  }

  /** A frame was whole: what fails from now on is told again. */
  clear(): void {
    this.#known.clear();
  }
}

/** Failures that are told before a frame is whole again. */
const MOST = 8;

function asDrawError(thrown: unknown, file: string): DrawError {
  const error = new DrawError({
    code: "DRAW_FRAME",
    file,
    cause: thrown instanceof Error ? thrown.message : String(thrown),
    fix: "Undo the last change of the layer; if that does not help, report it with this message",
  });
  // Where it happened.
  if (thrown instanceof Error && thrown.stack) error.stack = thrown.stack;
  return error;
}
