import type { HorizontalShiftStep, Step } from "./step.js";

/** First four bytes of an encoded transformation: `GTRF`. */
export const MAGIC = Uint8Array.of(0x47, 0x54, 0x52, 0x46);

/** Of the bytes; a reader refuses any other. */
export const VERSION = 1;

/** Steps by their number in the file. Append only; {@link TURNED_PROJECTION} is and {@link CHOICE} are taken. */
export const KINDS: ReadonlyArray<Exclude<Step["kind"], "choice">> = [
  "projection",
  "height",
  "horizontalShift",
  "verticalShift",
  "datumShift",
  "geocentric",
];

/** Number of a projection whose patchwork counts from a centre of its own. */
export const TURNED_PROJECTION = 6;

/** Number of a choice between ways. */
export const CHOICE = 7;

/** Directions of a horizontal shift by their number in the file. */
export const DIRECTIONS: ReadonlyArray<HorizontalShiftStep["direction"]> = ["forward", "inverse"];
