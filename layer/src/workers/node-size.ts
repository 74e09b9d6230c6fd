import { DecodeError } from "../errors/index.js";

/** Points of one node that are decoded at most. Converters make nodes of 10,000 to 200,000. */
const MOST_POINTS = 2 ** 21;

/** Bytes that the decoded points of one node may take; what is made of them takes about twice as much again. */
const MOST_BYTES = 2 ** 26;

/** What a node is announced to hold. */
export interface AnnouncedNode {
  readonly file: string;
  /** Node name. */
  readonly node: string;
  readonly pointCount: number;
  /** Bytes that one decoded point takes. */
  readonly bytesPerPoint: number;
}

/**
 * Refuses a node that would take more memory than a page can spare, before anything is read or allocated for it: a
 * chunk of some kilobytes can unpack to gigabytes.
 * @throws DecodeError DECODE_TOO_LARGE
 */
export function checkNodeSize({ file, node, pointCount, bytesPerPoint }: AnnouncedNode): void {
  const bytes = pointCount * bytesPerPoint;
  if (pointCount <= MOST_POINTS && bytes <= MOST_BYTES) return;
  const most = Math.min(MOST_POINTS, Math.floor(MOST_BYTES / bytesPerPoint));
  throw new DecodeError({
    code: "DECODE_TOO_LARGE",
    file,
    cause: `node ${node} is said to hold ${pointCount} points, ${bytes} bytes; at most ${most} points are decoded`,
    fix: "Convert the scan again: groma convert makes nodes of fewer points",
  });
}
