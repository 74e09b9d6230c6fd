import type { HorizontalShiftStep, Step } from "./step.js";

/** First four bytes of an encoded transformation: `GTRF`. */
export const MAGIC = Uint8Array.of(0x47, 0x54, 0x52, 0x46);

export const VERSION = 1;

/** Steps by their number in the file. Append only; {@link TURNED_PROJECTION} is taken. */
export const KINDS: ReadonlyArray<Step["kind"]> = [
  "projection",
  "height",
  "horizontalShift",
  "verticalShift",
  "datumShift",
  "geocentric",
];

/** Number of a projection whose patchwork counts from a centre of its own. */
export const TURNED_PROJECTION = 6;

/** Directions of a horizontal shift by their number in the file. */
export const DIRECTIONS: ReadonlyArray<HorizontalShiftStep["direction"]> = ["forward", "inverse"];
