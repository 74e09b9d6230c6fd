import { SourceError } from "../../errors/index.js";

/** What a `Content-Range` header says: `bytes first-last/size` (RFC 9110, section 14.4). */
export interface ContentRange {
  /** First byte sent. */
  readonly first: number;
  /** Last byte sent, inclusive. */
  readonly last: number;
  /** Length of the whole file; undefined for `*`. */
  readonly size: number | undefined;
}

/** Parses a `Content-Range` header; undefined where it is not of the form that RFC 9110 gives. */
export function parseContentRange(header: string): ContentRange | undefined {
  const match = /^bytes\s+(\d+)-(\d+)\/(\d+|\*)$/i.exec(header.trim());
  if (!match) return undefined;
  const first = Number(match[1]);
  const last = Number(match[2]);
  const size = match[3] === "*" ? undefined : Number(match[3]);
  if (last < first || (size !== undefined && last >= size)) return undefined;
  return { first, last, size };
}

/** True where bytes begin like an HTML page: `<!do…` or `<htm…`, in any case, after blanks or a byte order mark. */
export function looksLikeHtml(bytes: Uint8Array): boolean {
  const head = new TextDecoder().decode(bytes.subarray(0, 64)).replace(/^\uFEFF/, "");
  return /^\s*<(!doc|html)/i.test(head);
}

/** Gives up on an answer's body so that the connection does not go on carrying it. */
export async function discardBody(response: Response): Promise<void> {
  // A body that already failed rejects its cancel with the same failure, which is reported elsewhere.
  await response.body?.cancel().catch(() => undefined);
}

/**
 * First bytes of a body, at most about `length`; the rest is not fetched.
 * Used to tell a web page from data when a server does not do as asked.
 */
export async function peekBody(response: Response, length: number): Promise<Uint8Array> {
  const reader = response.body?.getReader();
  if (!reader) return new Uint8Array(0);
  try {
    const { value } = await reader.read();
    return (value ?? new Uint8Array(0)).subarray(0, length);
  } catch {
    return new Uint8Array(0);
  } finally {
    await reader.cancel().catch(() => undefined);
  }
}

/** Milliseconds that a `Retry-After` header asks to wait: seconds, or until a date (RFC 9110, section 10.2.3). */
export function parseRetryAfter(header: string | null, now: number = Date.now()): number | undefined {
  if (header === null) return undefined;
  const text = header.trim();
  if (/^\d+$/.test(text)) return 1000 * Number(text);
  // All three forms of an HTTP date begin with the name of a day; `Date.parse` takes much else for a date.
  const time = /^[A-Z][a-z]{2,8},? /.test(text) ? Date.parse(text) : Number.NaN;
  return Number.isNaN(time) ? undefined : Math.max(0, time - now);
}

/** A body ended before its time. */
export class ShortBody extends Error {
  /** @param broke whether the connection broke off, with the reason where it is known */
  constructor(
    readonly received: number,
    readonly broke: { readonly reason: unknown } | undefined,
  ) {
    super(`the body ended after ${received} bytes`);
  }
}

/** Who is told of a body. */
interface Reader {
  readonly name: string;
  /** Called as bytes come. */
  readonly heard: () => void;
  /** The same, with the whole and how many of its bytes are there. */
  readonly arrived?: ((bytes: Uint8Array, length: number) => void) | undefined;
}

/**
 * The body of an answer, which must be exactly `expected` bytes; never more than that is allocated.
 * @throws ShortBody when it ended early
 * @throws SourceError SOURCE_LONG when it goes on
 */
export async function readExactly(
  response: Response,
  expected: number,
  { name, heard, arrived }: Reader,
): Promise<Uint8Array> {
  const bytes = new Uint8Array(expected);
  const reader = response.body?.getReader();
  let received = 0;
  while (reader) {
    const step = await reader.read().catch((reason: unknown) => {
      throw new ShortBody(received, { reason });
    });
    if (step.done) break;
    heard();
    if (received + step.value.length > expected) {
      await reader.cancel().catch(() => undefined);
      throw new SourceError({
        code: "SOURCE_LONG",
        file: name,
        cause: `the server sent more than the ${expected} bytes asked for`,
        fix: "Check the server or proxy for rewriting of Range answers",
      });
    }
    bytes.set(step.value, received);
    received += step.value.length;
    arrived?.(bytes, received);
  }
  if (received < expected) throw new ShortBody(received, undefined);
  return bytes;
}
