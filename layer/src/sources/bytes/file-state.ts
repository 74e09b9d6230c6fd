import { SourceError } from "../../errors/index.js";
import { discardBody, parseContentRange } from "./http-answer.js";
import { changedError } from "./http-refusal.js";
import { encodingFault, networkError } from "./network-fault.js";

/** Bytes of a file that are asked for, from `begin` on and up to `end`, which is not one of them. */
export interface AskedRange {
  readonly begin: number;
  readonly end: number;
  /** Whether it is the opening request, which may get less than it asks for. */
  readonly opening: boolean;
}

/** What identifies one state of a file on a server: a change between two requests means another file. */
interface Version {
  readonly etag: string | null;
  readonly modified: string | null;
  readonly size: number | undefined;
}

/** A file on a server as its answers describe it: all of them have to be parts of one and the same. */
export class FileState {
  readonly #name: string;
  #version: Version | undefined;

  /** @param name what errors call the file */
  constructor(name: string) {
    this.#name = name;
  }

  /** Length of the file in bytes, as the first answer's `Content-Range` said. */
  get size(): number | undefined {
    return this.#version?.size;
  }

  /** Whether an answer has described it. */
  get known(): boolean {
    return this.#version !== undefined;
  }

  /**
   * Length in bytes of a 206 answer's body, after its range and the file's version were held against what was asked for and
   * what is known.
   * @throws SourceError SOURCE_ENCODED, SOURCE_RANGE, SOURCE_CHANGED; the body is discarded then
   */
  async lengthOf(response: Response, { begin, end, opening }: AskedRange): Promise<number> {
    const encoding = encodingFault(response);
    if (encoding) {
      await discardBody(response);
      throw networkError(encoding, this.#name);
    }
    const header = response.headers.get("Content-Range");
    if (header === null && response.type === "cors")
      return this.#hiddenLength(response, { begin, end, opening });
    const range = header === null ? undefined : parseContentRange(header);
    const wrongEnd = range && (opening ? range.last >= end : range.last !== end - 1);
    if (!range || range.first !== begin || wrongEnd) {
      await discardBody(response);
      throw new SourceError({
        code: "SOURCE_RANGE",
        file: this.#name,
        cause: `bytes ${begin}-${end - 1} were asked for, the answer says "${header ?? "nothing"}"`,
        fix: "Check the server or proxy for rewriting of Range answers",
      });
    }
    await this.#checkVersion(response, range.size);
    return range.last - range.first + 1;
  }

  /** Another origin that does not expose `Content-Range`: the length alone can be checked. */
  async #hiddenLength(response: Response, { begin, end, opening }: AskedRange): Promise<number> {
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
      throw changedError(this.#name);
    }
  }
}
