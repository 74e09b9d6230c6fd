import { randomBytes } from "node:crypto";
import { createReadStream, type Stats } from "node:fs";
import { stat } from "node:fs/promises";
import type { IncomingMessage, ServerResponse } from "node:http";
import { basename, dirname } from "node:path";
import { pipeline } from "node:stream/promises";
import send from "send";
import { type ByteRange, bytesAsked } from "./byte-ranges.js";

/** Headers that make an answer depend on what the client has already. */
const CONDITIONS = [
  "if-match",
  "if-none-match",
  "if-modified-since",
  "if-unmodified-since",
  "if-range",
] as const;

/**
 * Answers GET and HEAD with a file or the parts of it that are asked for (RFC 9110, sections 13 and 14).
 * @param path of a regular file, links followed
 * @returns the status where there is nothing to send but that
 */
export async function answerWithFile(
  path: string,
  request: IncomingMessage,
  response: ServerResponse,
): Promise<number | undefined> {
  const found = await stat(path);
  if (!found.isFile()) return 404;
  response.setHeader("ETag", etagOf(found));
  // Data sets are converted again under the same name; a page must not mix two of them.
  response.setHeader("Cache-Control", "no-cache");
  const asked = request.method === "GET" ? bytesAsked(request.headers.range, found.size) : "whole";
  if (asked === "whole") delete request.headers.range;
  else if (asked === "unsatisfiable") request.headers.range = `bytes=${found.size}-`;
  else if (asked.length === 1) request.headers.range = `bytes=${asked[0].first}-${asked[0].last}`;
  else if (CONDITIONS.some((name) => name in request.headers)) delete request.headers.range;
  else return sendParts(path, asked, found, response);
  return sendFile(path, request, response);
}

function sendFile(
  path: string,
  request: IncomingMessage,
  response: ServerResponse,
): Promise<number | undefined> {
  return new Promise((resolve) => {
    const stream = send(request, encodeURIComponent(basename(path)), {
      root: dirname(path),
      // What may be seen is decided by the path as it was asked for; this one is where links have led.
      dotfiles: "allow",
      cacheControl: false,
    });
    stream.on("error", (error: { status?: number }) => resolve(error.status ?? 500));
    response.on("close", () => resolve(undefined));
    stream.pipe(response);
  });
}

/** Several ranges as `multipart/byteranges` (RFC 9110, section 14.6). */
async function sendParts(
  path: string,
  parts: readonly ByteRange[],
  { size, mtime }: Stats,
  response: ServerResponse,
): Promise<undefined> {
  const boundary = randomBytes(16).toString("hex");
  const heads = parts.map(
    ({ first, last }) =>
      `\r\n--${boundary}\r\nContent-Type: application/octet-stream\r\n` +
      `Content-Range: bytes ${first}-${last}/${size}\r\n\r\n`,
  );
  const end = `\r\n--${boundary}--\r\n`;
  const bytes = parts.reduce((sum, { first, last }) => sum + last - first + 1, 0);
  response.writeHead(206, {
    "Accept-Ranges": "bytes",
    "Content-Length": bytes + heads.join("").length + end.length,
    "Content-Type": `multipart/byteranges; boundary=${boundary}`,
    "Last-Modified": mtime.toUTCString(),
  });
  for (const [index, { first, last }] of parts.entries()) {
    response.write(heads[index]);
    await pipeline(createReadStream(path, { start: first, end: last }), response, { end: false });
  }
  response.end(end);
}

/** Weak, since two states of a file within the clock's step look alike. */
function etagOf({ size, mtimeMs }: Stats): string {
  return `W/"${size.toString(16)}-${Math.floor(mtimeMs).toString(16)}"`;
}
