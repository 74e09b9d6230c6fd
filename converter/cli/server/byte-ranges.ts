/** Bytes of a file, both ends inclusive. */
export interface ByteRange {
  readonly first: number;
  readonly last: number;
}

/** What a request asks of a file: all of it, parts of it, or parts that it cannot have. */
export type BytesAsked = "whole" | "unsatisfiable" | readonly ByteRange[];

/** Parts that one answer carries at most; RFC 9110, section 14.2, lets a server refuse more. */
const MAX_PARTS = 16;

/**
 * Reads a `Range` header (RFC 9110, section 14.1.2). A suffix longer than the file asks for all of it. Another unit than
 * bytes is ignored, as the RFC demands. A malformed list of byte ranges is refused and not ignored, which the RFC
 * allows: a client that miscounts by one must not be sent a file of gigabytes for it. So are overlapping and very many
 * ranges, which cost a server more than the file.
 * @param header the header's value; undefined: there is none
 * @param size length of the file in bytes
 */
export function bytesAsked(header: string | undefined, size: number): BytesAsked {
  const list = /^\s*bytes\s*=(.*)$/i.exec(header ?? "")?.[1];
  if (list === undefined) return "whole";
  const parts: ByteRange[] = [];
  let bytes = 0;
  for (const piece of list.split(",")) {
    const text = piece.trim();
    // RFC 9110, section 5.6.1: empty elements of a list are passed over.
    if (text === "") continue;
    const range = rangeOf(text, size);
    if (range === "malformed") return "unsatisfiable";
    if (range === "outside") continue;
    parts.push(range);
    bytes += range.last - range.first + 1;
    if (parts.length > MAX_PARTS || bytes > size) return "unsatisfiable";
  }
  return parts.length > 0 ? parts : "unsatisfiable";
}

function rangeOf(text: string, size: number): ByteRange | "malformed" | "outside" {
  const match = /^(\d*)-(\d*)$/.exec(text);
  if (!match || text === "-") return "malformed";
  const [, from, to] = match;
  if (from === "") {
    const length = Math.min(Number(to), size);
    return length === 0 ? "outside" : { first: size - length, last: size - 1 };
  }
  const first = Number(from);
  const last = to === "" ? size - 1 : Number(to);
  if (to !== "" && last < first) return "malformed";
  return first >= size ? "outside" : { first, last: Math.min(last, size - 1) };
}
