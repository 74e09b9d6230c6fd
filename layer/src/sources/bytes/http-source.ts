import { SourceError } from "../../errors/index.js";
import type { ByteSource, ReadOptions } from "./byte-source.js";
import {
  BrokenBody,
  discardBody,
  looksLikeHtml,
  parseContentRange,
  peekBody,
  readExactly,
} from "./http-answer.js";
import { type RetryPolicy, Transient, withRetries } from "./retry.js";

/** How an {@link HttpSource} asks. */
export interface HttpOptions {
  /** Request headers, e.g. `{ Authorization: "Bearer …" }`. Default: none. */
  readonly headers?: Readonly<Record<string, string>> | undefined;
  /** As in `fetch`. Default: `"same-origin"`. */
  readonly credentials?: RequestCredentials | undefined;
  /** Time limit of one attempt, body included, in milliseconds. Default: 30,000. */
  readonly timeout?: number | undefined;
  /** Repeats after 5xx, timeouts and network failures. Default: 3 attempts, 250 ms. */
  readonly retry?: RetryPolicy | undefined;
  /** Bytes that the opening request fetches at once. Default: 65,536. */
  readonly headLength?: number | undefined;
}

/** Opening bytes of a COPC file: header, VLRs with the WKT and, in small files, the whole hierarchy. */
const HEAD_LENGTH = 65_536;

/** Bytes of an answer that are looked at to tell a web page from data. */
const PEEK_LENGTH = 256;

/** What identifies one state of a file on a server: a change between two requests means another file. */
interface Version {
  readonly etag: string | null;
  readonly modified: string | null;
  readonly size: number | undefined;
}

/**
 * A file on a web server, read by Range requests (RFC 9110, section 14). Strict: an answer must be 206 and
 * cover exactly the bytes asked for; anything else is an error with a code, never a guess.
 */
export class HttpSource implements ByteSource {
  readonly name: string;
  readonly #options: HttpOptions;
  #version: Version | undefined;
  #head: Uint8Array = new Uint8Array(0);

  private constructor(url: string, options: HttpOptions) {
    this.name = url;
    this.#options = options;
  }

  /** Length of the file in bytes, as the opening answer's `Content-Range` said. */
  get size(): number | undefined {
    return this.#version?.size;
  }

  /**
   * Makes the opening request: one read that serves the header, the VLRs and often the hierarchy.
   * @throws SourceError with a code for each way in which a server can fail
   */
  static async open(url: string, options: HttpOptions = {}, read: ReadOptions = {}): Promise<HttpSource> {
    const source = new HttpSource(url, options);
    source.#head = await source.#request(0, options.headLength ?? HEAD_LENGTH, true, read.signal);
    return source;
  }

  async read(begin: number, end: number, options: ReadOptions = {}): Promise<Uint8Array> {
    checkRange(begin, end, this.size, this.name);
    options.signal?.throwIfAborted();
    if (end <= this.#head.length) return this.#head.slice(begin, end);
    return this.#request(begin, end, false, options.signal);
  }

  #request(begin: number, end: number, opening: boolean, signal?: AbortSignal): Promise<Uint8Array> {
    const retry = this.#options.retry ?? { attempts: 3, backoff: 250 };
    return withRetries(retry, signal, () => this.#attempt(begin, end, opening, signal));
  }

  async #attempt(begin: number, end: number, opening: boolean, signal?: AbortSignal): Promise<Uint8Array> {
    const limit = this.#options.timeout ?? 30_000;
    const timeout = AbortSignal.timeout(limit);
    try {
      const response = await fetch(this.name, {
        headers: { ...this.#options.headers, Range: `bytes=${begin}-${end - 1}` },
        credentials: this.#options.credentials ?? "same-origin",
        signal: signal ? AbortSignal.any([signal, timeout]) : timeout,
        // Browsers lock a cache entry while one request for its address runs: parallel ranges would queue up.
        cache: "no-store",
      });
      if (response.status !== 206) throw await this.#refusal(response, begin);
      const length = await this.#checkedLength(response, begin, end, opening);
      return await readExactly(response, length, this.name);
    } catch (thrown) {
      signal?.throwIfAborted();
      if (thrown instanceof SourceError || thrown instanceof Transient) throw thrown;
      throw this.#interrupted(thrown, timeout.aborted, limit);
    }
  }

  /** Length of a 206 answer's body, after its range and the file's version were held against what is known. */
  async #checkedLength(response: Response, begin: number, end: number, opening: boolean): Promise<number> {
    const header = response.headers.get("Content-Range");
    if (header === null && response.type === "cors") return this.#hiddenLength(response, begin, end, opening);
    const range = header === null ? undefined : parseContentRange(header);
    const wrongEnd = range && (opening ? range.last >= end : range.last !== end - 1);
    if (!range || range.first !== begin || wrongEnd) {
      await discardBody(response);
      throw this.#error(
        "SOURCE_RANGE",
        `bytes ${begin}-${end - 1} were asked for, the answer says "${header ?? "nothing"}"`,
        "Check the server or proxy for rewriting of Range answers",
      );
    }
    await this.#checkVersion(response, range.size);
    return range.last - range.first + 1;
  }

  /** Another origin that does not expose `Content-Range`: the length alone can be checked. */
  async #hiddenLength(response: Response, begin: number, end: number, opening: boolean): Promise<number> {
    await this.#checkVersion(response, undefined);
    const declared = response.headers.get("Content-Length");
    const length = declared === null ? end - begin : Number(declared);
    return opening ? Math.min(length, end - begin) : end - begin;
  }

  async #checkVersion(response: Response, size: number | undefined): Promise<void> {
    const now: Version = {
      etag: response.headers.get("ETag"),
      modified: response.headers.get("Last-Modified"),
      size,
    };
    const then = this.#version;
    this.#version ??= now;
    if (!then) return;
    const differ = (a: string | number | null | undefined, b: string | number | null | undefined) =>
      a !== null && a !== undefined && b !== null && b !== undefined && a !== b;
    if (differ(then.etag, now.etag) || differ(then.modified, now.modified) || differ(then.size, now.size)) {
      await discardBody(response);
      throw this.#changed();
    }
  }

  /** The error, or the {@link Transient}, for an answer that is not 206. */
  async #refusal(response: Response, begin: number): Promise<Error> {
    const { status } = response;
    if (status === 200) {
      const html = looksLikeHtml(await peekBody(response, PEEK_LENGTH));
      return html ? this.#html() : this.#noRange();
    }
    await discardBody(response);
    if (status === 404 || status === 410) {
      const cause = this.#version ? "the file vanished while it was being read" : "there is no such file";
      return this.#error("SOURCE_NOT_FOUND", `${cause} (HTTP ${status})`, "Check the address");
    }
    if (status === 401 || status === 403) {
      return this.#error(
        "SOURCE_DENIED",
        `the server refuses access (HTTP ${status})`,
        "Pass headers or credentials, or renew the signed address",
      );
    }
    if (status === 416) {
      if (this.#version) return this.#changed();
      return this.#error(
        "SOURCE_EMPTY",
        `byte ${begin} lies outside the file (HTTP 416)`,
        "Check that the file on the server is complete",
      );
    }
    const error = this.#error(
      "SOURCE_HTTP",
      `the server answered HTTP ${status}`,
      "Look into the server's log",
    );
    return status >= 500 || status === 429 ? new Transient(error) : error;
  }

  /** The failure for a request that ended without an answer, or in the middle of one. */
  #interrupted(thrown: unknown, timedOut: boolean, limit: number): Transient {
    if (timedOut) {
      return new Transient(
        this.#error(
          "SOURCE_TIMEOUT",
          `the server did not answer in full within ${limit} ms`,
          "Try again later, or raise the timeout",
        ),
      );
    }
    if (thrown instanceof BrokenBody) {
      return new Transient(
        this.#error(
          "SOURCE_SHORT",
          `the connection broke off after ${thrown.received} bytes of the answer`,
          "Check the connection and that the file on the server is complete",
        ),
      );
    }
    return new Transient(
      this.#error(
        "SOURCE_NETWORK",
        "the server cannot be reached, or it does not allow this page to ask (CORS)",
        "Check the address and the connection; another origin must send Access-Control-Allow-Origin",
      ),
    );
  }

  #html(): SourceError {
    return this.#error(
      "SOURCE_HTML",
      "the server returned HTML, not a point cloud",
      "Check the address; a login or error page may stand in for the file",
    );
  }

  #noRange(): SourceError {
    return this.#error(
      "SOURCE_NO_RANGE",
      "the server answers a Range request with the whole file (HTTP 200)",
      "Serve the file from a server with Range requests, for example: groma serve DIR",
    );
  }

  #changed(): SourceError {
    return this.#error("SOURCE_CHANGED", "the file changed while it was being read", "Open it again");
  }

  #error(code: string, cause: string, fix: string): SourceError {
    return new SourceError({ code, file: this.name, cause, fix });
  }
}

/**
 * Holds a wanted range against the file before anything is asked for: an empty or negative range would make
 * `bytes=0--1`, which servers answer with the whole file.
 * @throws SourceError SOURCE_RANGE
 */
export function checkRange(begin: number, end: number, size: number | undefined, name: string): void {
  const valid = Number.isSafeInteger(begin) && Number.isSafeInteger(end) && begin >= 0 && begin < end;
  if (valid && (size === undefined || end <= size)) return;
  throw new SourceError({
    code: "SOURCE_RANGE",
    file: name,
    cause: `bytes ${begin} to ${end} do not lie in the file${size === undefined ? "" : ` of ${size} bytes`}`,
    fix: "Check that the file is complete",
  });
}
