import { createServer, type IncomingMessage, type Server, type ServerResponse } from "node:http";
import type { AddressInfo } from "node:net";

/** One request as a misbehaviour sees it. */
export interface Asked {
  readonly request: IncomingMessage;
  readonly response: ServerResponse;
  /** Number of the request, 1 first. */
  readonly count: number;
  /** First and last byte asked for, inclusive; the last one cut to the file. */
  readonly first: number;
  readonly last: number;
  /** Answers as a good server would, with headers changed or added. */
  answer(headers?: Record<string, string>, body?: Uint8Array): void;
}

/** One request as the server remembers it. */
export interface Remembered {
  /** `performance.now()` at which it came, and first byte that it asked for. */
  readonly at: number;
  readonly first: number;
}

/** What a server does with a request instead of answering it. */
export type Misbehaviour = (asked: Asked) => void;

/** Serves one file by Range requests, badly. */
export class BadServer {
  readonly #server: Server;
  readonly #file: Uint8Array;
  misbehave: Misbehaviour | undefined;
  /** All requests so far. */
  readonly log: Remembered[] = [];

  private constructor(file: Uint8Array, misbehave: Misbehaviour | undefined) {
    this.#file = file;
    this.misbehave = misbehave;
    this.#server = createServer((request, response) => this.#handle(request, response));
  }

  static async start(file: Uint8Array, misbehave?: Misbehaviour): Promise<BadServer> {
    const server = new BadServer(file, misbehave);
    await new Promise<void>((done) => server.#server.listen(0, "127.0.0.1", done));
    return server;
  }

  /** How many requests came so far. */
  get requests(): number {
    return this.log.length;
  }

  get url(): string {
    return `http://127.0.0.1:${(this.#server.address() as AddressInfo).port}/scan.copc.laz`;
  }

  async stop(): Promise<void> {
    this.#server.closeAllConnections();
    await new Promise((done) => this.#server.close(done));
  }

  #handle(request: IncomingMessage, response: ServerResponse): void {
    const [, from, to] = /^bytes=(\d+)-(\d+)$/.exec(request.headers.range ?? "") ?? [];
    this.log.push({ at: performance.now(), first: Number(from) });
    // Pages of another origin may read every answer, the bad ones too.
    response.setHeader("Access-Control-Allow-Origin", "*");
    response.setHeader("Access-Control-Expose-Headers", "Content-Range, Content-Length, ETag, Accept-Ranges");
    if (from === undefined) {
      response.writeHead(400).end("a client that asks without a Range, or for bytes=0--1, is at fault");
      return;
    }
    const first = Number(from);
    const last = Math.min(Number(to), this.#file.length - 1);
    const answer: Asked["answer"] = (headers = {}, body = this.#file.subarray(first, last + 1)) => {
      response.writeHead(206, {
        "Content-Length": String(body.length),
        "Content-Range": `bytes ${first}-${last}/${this.#file.length}`,
        ETag: '"1"',
        ...headers,
      });
      response.end(body);
    };
    if (this.misbehave) this.misbehave({ request, response, count: this.requests, first, last, answer });
    else answer();
  }
}
