import { type Outage, SourceError } from "../../errors/index.js";
import { type ByteSource, checkRange, type ReadOptions } from "./byte-source.js";
import { type AddressFunction, Credentials, type HeadersFunction, type HeaderValues } from "./credentials.js";
import { type AskedRange, FileState } from "./file-state.js";
import { HostSchedule, type ServerWait, type Turn } from "./host-schedule.js";
import { discardBody, readExactly, ShortBody } from "./http-answer.js";
import { type Refusal, refusalOf } from "./http-refusal.js";
import { MergedReads } from "./merged-reads.js";
import { nameNetworkFault, networkError, redirectError } from "./network-fault.js";
import { OpeningBytes } from "./opening-bytes.js";
import { SilenceWatch } from "./silence-watch.js";

/** How often and how patiently one read is repeated while the server cannot serve it. */
export interface RetryPolicy {
  /** Attempts in all, the first included. Default: 6. */
  readonly attempts?: number | undefined;
  /** Pause before the second attempt, milliseconds; doubled before each further one, up to a minute. Default: 250. */
  readonly backoff?: number | undefined;
  /** Milliseconds after its begin at which a read makes no further attempt. Default: 30,000. */
  readonly patience?: number | undefined;
}

/** How an {@link HttpSource} asks. */
export interface HttpOptions {
  /**
   * Request headers, e.g. `{ Authorization: "Bearer …" }`, or a function that gives them. It is called again once they
   * have expired, or the server refuses them (401, 403). Default: none.
   */
  readonly headers?: HeaderValues | HeadersFunction | undefined;
  /** As in `fetch`. Default: `"same-origin"`. */
  readonly credentials?: RequestCredentials | undefined;
  /** Longest silence of the server in an attempt, milliseconds; the whole may take twelve times that. Default: 10,000. */
  readonly timeout?: number | undefined;
  /** Repeats while the server is busy, fails, is silent or out of reach. */
  readonly retry?: RetryPolicy | undefined;
  /** Bytes that the opening request fetches at once. Default: 131,072. */
  readonly headLength?: number | undefined;
  /** Called when the server begins to be waited for, for another reason or time, and with undefined once it answers. */
  readonly onWait?: ((wait: ServerWait | undefined) => void) | undefined;
}

/**
 * Opening bytes of a COPC file. In those of Groma: header, VLRs and first page, 65,536 at most (docs/record.md), and behind them
 * the root's points, most of which are no longer than that. In those of others: header, VLRs with the WKT, and points.
 */
const HEAD_LENGTH = 131_072;

/** Milliseconds for which redirects that led nowhere are not followed again. */
const REDIRECTS_KEPT = 10_000;

/** One read. */
interface Asked extends AskedRange {
  readonly signal: AbortSignal | undefined;
  /** Called as bytes come: all that there is room for, of which so many are there. */
  readonly arrived?: (bytes: Uint8Array, length: number) => void;
}

/** What a read is made with. */
interface Target {
  readonly address: string;
  readonly url: URL;
  readonly headers: HeaderValues;
}

/**
 * A file on a web server, read by Range requests (RFC 9110, section 14). Strict: an answer must be 206 and
 * cover exactly the bytes asked for; anything else is an error with a code, never a guess.
 */
export class HttpSource implements ByteSource {
  readonly name: string;
  readonly #options: HttpOptions;
  readonly #credentials: Credentials;
  #schedule: HostSchedule | undefined;
  readonly #state: FileState;
  /** What the opening request brings. */
  readonly #opening: OpeningBytes;
  readonly #merged = new MergedReads((request) => this.#request({ ...request, opening: false }));
  /** Whether redirects are followed at once: in the opening, and where one has led to the file. */
  #follows = true;
  /** The last look at where redirects lead, and until when it holds. */
  #redirects: { readonly until: number; readonly followed: Promise<void> } | undefined;
  /** What the application was told last. */
  #told: ServerWait | undefined;

  private constructor(name: string, credentials: Credentials, options: HttpOptions, signal?: AbortSignal) {
    this.name = name;
    this.#state = new FileState(name);
    this.#credentials = credentials;
    this.#options = options;
    const end = options.headLength ?? HEAD_LENGTH;
    this.#opening = new OpeningBytes(end, (arrived) =>
      this.#request({ begin: 0, end, opening: true, signal, arrived }),
    );
  }

  /** Length of the file in bytes, as the opening answer's `Content-Range` said. */
  get size(): number | undefined {
    return this.#state.size;
  }

  /** Why the server is waited for; undefined while it answers. */
  get wait(): ServerWait | undefined {
    return this.#schedule?.wait;
  }

  /**
   * Makes the opening request: one read that serves the header, the VLRs, often the hierarchy, and points. It is open once the
   * first bytes are here; reads wait for theirs.
   * @param from the file's address, or a function that gives it; errors name such a file without its query
   * @throws SourceError with a code for each way in which a server can fail
   */
  static async open(
    from: string | AddressFunction,
    options: HttpOptions = {},
    { signal }: ReadOptions = {},
  ): Promise<HttpSource> {
    const credentials = new Credentials(
      from,
      options.headers,
      typeof from === "string" ? from : "the address",
    );
    // A signature is a secret: it does not go into messages.
    const name = typeof from === "string" ? from : (await credentials.get()).address.replace(/[?#].*$/, "");
    const source = new HttpSource(name, credentials, options, signal);
    await source.#opening.begun;
    return source;
  }

  async read(begin: number, end: number, { signal }: ReadOptions = {}): Promise<Uint8Array> {
    checkRange(begin, end, this.size, this.name);
    signal?.throwIfAborted();
    const border = Math.min(end, this.#opening.end);
    if (border <= begin) return this.#merged.read(begin, end, signal);
    const behind = border < end ? this.#merged.read(border, end, signal) : undefined;
    const [known, rest] = await Promise.all([this.#opening.read(begin, border), behind]);
    signal?.throwIfAborted();
    if (known.length < border - begin) return this.#merged.read(begin, end, signal);
    if (!rest) return known.slice();
    const bytes = new Uint8Array(end - begin);
    bytes.set(known);
    bytes.set(rest, known.length);
    return bytes;
  }

  async #request(asked: Asked): Promise<Uint8Array> {
    const { attempts = 6, backoff = 250, patience = 30_000 } = this.#options.retry ?? {};
    const deadline = Date.now() + patience;
    let last: SourceError | undefined;
    let renewed = false;
    for (let tried = 1; ; tried++) {
      const target = await this.#target();
      const schedule = HostSchedule.of(target.url);
      this.#schedule = schedule;
      const unsubscribe = schedule.subscribe(() => this.#tell());
      if (asked.opening && tried === 1) schedule.hasten();
      try {
        const turn = await schedule.enter(deadline, asked.signal);
        if (!turn) throw last ?? this.#overdue(schedule.wait);
        const outcome = await this.#attempt(target, turn, asked).catch((thrown) => {
          turn.left();
          throw thrown;
        });
        if (outcome instanceof Uint8Array) {
          turn.answered();
          return outcome;
        }
        const { error, pause, denied } = outcome;
        if (error.outage) turn.failed(error, { backoff, asked: pause });
        else turn.answered();
        last = error;
        if (denied !== undefined && !renewed) {
          renewed = true;
          if (await this.#credentials.replace(target, denied)) continue;
        }
        if (!error.outage || tried >= attempts) throw error;
      } finally {
        unsubscribe();
        this.#tell();
      }
    }
  }

  /** @throws SourceError SOURCE_RENEWAL, SOURCE_ADDRESS, SOURCE_REQUEST */
  async #target(): Promise<Target> {
    const { address, headers } = await this.#credentials.get();
    let url: URL;
    try {
      url = new URL(address, globalThis.location?.href);
    } catch {
      throw this.#error(
        "SOURCE_ADDRESS",
        "this is not an address",
        "Give an address such as https://…/scan.copc.laz",
      );
    }
    try {
      new Headers(headers);
    } catch (thrown) {
      const cause = `these request headers cannot be sent (${thrown instanceof Error ? thrown.message : thrown})`;
      throw this.#error("SOURCE_REQUEST", cause, "Check the names and values in the option headers");
    }
    return { address, url, headers };
  }

  /** One request. @throws the signal's reason when aborted, and nothing else */
  async #attempt(target: Target, turn: Turn, asked: Asked): Promise<Uint8Array | Refusal> {
    const { signal } = asked;
    const limit = this.#options.timeout ?? 10_000;
    const watch = new SilenceWatch(limit, () => turn.silent(this.#silent(limit / 3)));
    const heard = () => {
      watch.heard();
      turn.heard();
    };
    try {
      const response = await this.#fetch(
        target,
        asked,
        signal ? AbortSignal.any([signal, watch.signal]) : watch.signal,
      );
      heard();
      if (response.status !== 206) {
        return await refusalOf(response, {
          name: this.name,
          known: this.#state.known,
          first: asked.begin,
        });
      }
      const length = await this.#state.lengthOf(response, asked);
      return await readExactly(response, length, { name: this.name, heard, arrived: asked.arrived });
    } catch (thrown) {
      signal?.throwIfAborted();
      if (thrown instanceof SourceError) return { error: thrown };
      if (watch.signal.aborted)
        return { error: watch.signal.reason === "slow" ? this.#slow() : this.#silent(limit) };
      if (thrown instanceof ShortBody) return { error: await this.#short(thrown) };
      const options = { headers: target.headers, credentials: this.#options.credentials ?? "same-origin" };
      const probed = asked.opening
        ? { ...options, address: target.address, signal: AbortSignal.timeout(limit) }
        : undefined;
      return { error: networkError(await nameNetworkFault(thrown, probed), this.name) };
    } finally {
      watch.stop();
    }
  }

  /** Asks, and follows redirects as far as they lead to the file. */
  async #fetch(
    { address, headers }: Target,
    { begin, end, opening }: Asked,
    signal: AbortSignal,
  ): Promise<Response> {
    const ask = (redirect: RequestRedirect) =>
      fetch(address, {
        headers: { ...headers, Range: `bytes=${begin}-${end - 1}` },
        credentials: this.#options.credentials ?? "same-origin",
        signal,
        // Browsers lock a cache entry while one request for its address runs: parallel ranges would queue up.
        cache: "no-store",
        redirect,
      });
    if (this.#follows) {
      const response = await ask("follow");
      if (opening) this.#follows = response.redirected;
      return response;
    }
    const response = await ask("manual");
    if (!isRedirect(response)) return response;
    await discardBody(response);
    await this.#followOnce(address, headers);
    return ask("follow");
  }

  /**
   * Follows the redirects of a file that had none before, once for all reads that meet them: where they go in a circle,
   * a browser follows twenty of them each time.
   * @throws SourceError SOURCE_REDIRECT
   */
  #followOnce(address: string, headers: HeaderValues): Promise<void> {
    const follow = async () => {
      const limit = this.#options.timeout ?? 10_000;
      const signal = AbortSignal.timeout(limit);
      const credentials = this.#options.credentials ?? "same-origin";
      try {
        const range = { ...headers, Range: "bytes=0-0" };
        await discardBody(await fetch(address, { headers: range, credentials, signal, cache: "no-store" }));
        this.#follows = true;
      } catch (thrown) {
        if (signal.aborted) throw this.#silent(limit);
        throw redirectError(thrown, this.name);
      }
    };
    if (!this.#redirects || this.#redirects.until < Date.now()) {
      this.#redirects = { until: Date.now() + REDIRECTS_KEPT, followed: follow() };
    }
    return this.#redirects.followed;
  }

  /** Tells the application of waiting, whenever there is something new. */
  #tell(): void {
    const { wait } = this;
    if (wait === this.#told) return;
    this.#told = wait;
    this.#options.onWait?.(wait);
  }

  #silent(milliseconds: number): SourceError {
    const cause = `the server has sent nothing for ${Math.round(milliseconds / 100) / 10} s`;
    return this.#error("SOURCE_TIMEOUT", cause, "Try again later, or raise the option timeout", "silent");
  }

  #slow(): SourceError {
    const cause = "the server sends so slowly that the answer was given up";
    return this.#error("SOURCE_TIMEOUT", cause, "Try again later, or raise the option timeout", "failing");
  }

  async #short({ received, broke }: ShortBody): Promise<SourceError> {
    if (broke) {
      const fault = await nameNetworkFault(broke.reason, undefined);
      if (!fault.outage) return networkError(fault, this.name);
    }
    return this.#error(
      "SOURCE_SHORT",
      `the answer ${broke ? "broke off" : "ended"} after ${received} bytes, before its end`,
      "Check the connection and that the file on the server is complete",
      "failing",
    );
  }

  /** The error for a read that would come too late. */
  #overdue(wait: ServerWait | undefined): SourceError {
    const { code = "SOURCE_TIMEOUT", cause = "the server does not answer", outage = "failing" } = wait ?? {};
    return this.#error(code, cause, "Try again later", outage);
  }

  #error(code: string, cause: string, fix: string, outage?: Outage): SourceError {
    return new SourceError({ code, file: this.name, cause, fix, outage });
  }
}

function isRedirect({ type, status }: Response): boolean {
  return type === "opaqueredirect" || [301, 302, 303, 307, 308].includes(status);
}
