import { SourceError } from "../../errors/index.js";

/** How bytes are asked for. */
export interface BytesRequest {
  readonly begin: number;
  readonly end: number;
  readonly signal: AbortSignal;
  /** To be called as bytes come, with all that there is room for, of which so many are there from the beginning on. */
  readonly arrived: (bytes: Uint8Array, length: number) => void;
}

/** A read that was asked for. */
interface Part {
  readonly begin: number;
  readonly end: number;
  readonly resolve: (bytes: Uint8Array) => void;
  readonly reject: (reason: unknown) => void;
  /** Stops listening to whoever asked. */
  readonly deaf: () => void;
  /** The request that it goes in, once that is known. */
  group: Group | undefined;
  /** Whether it was answered, refused or given up. */
  done: boolean;
}

/** Reads that go in one request. */
interface Group {
  readonly parts: Part[];
  readonly begin: number;
  end: number;
  readonly controller: AbortController;
}

/** Bytes between two reads that are fetched along rather than asked for around: what a request costs by itself. */
const GAP = 4096;

/** Bytes of the longest request that is made of several reads, so that one that fails does not cost too much. */
const LONGEST = 1024 * 1024;

/** Requests that are started in one task: to start one takes a browser up to a millisecond of the main thread. */
const STARTS = 2;

/**
 * Reads of one file. Those that are asked for in one task and lie next to each other go in one request. Each is answered
 * as soon as its own bytes are there, and can be given up by itself; a request ends once nobody waits for it.
 */
export class MergedReads {
  readonly #request: (request: BytesRequest) => Promise<Uint8Array>;
  #asked: Part[] = [];
  #groups: Group[] = [];
  #scheduled = false;

  constructor(request: (request: BytesRequest) => Promise<Uint8Array>) {
    this.#request = request;
  }

  /** @throws what the request throws; the signal's reason when aborted */
  read(begin: number, end: number, signal: AbortSignal | undefined): Promise<Uint8Array> {
    return new Promise((resolve, reject) => {
      const stop = () => giveUp(part, signal?.reason);
      const deaf = () => signal?.removeEventListener("abort", stop);
      const part: Part = { begin, end, resolve, reject, deaf, group: undefined, done: false };
      signal?.addEventListener("abort", stop, { once: true });
      this.#asked.push(part);
      this.#schedule();
    });
  }

  #schedule(): void {
    if (this.#scheduled) return;
    this.#scheduled = true;
    setTimeout(() => {
      this.#scheduled = false;
      this.#start();
    });
  }

  #start(): void {
    this.#groups.push(...grouped(this.#asked.filter(({ done }) => !done)));
    this.#asked = [];
    for (let started = 0; started < STARTS; ) {
      const group = this.#groups.shift();
      if (!group) return;
      if (group.controller.signal.aborted) continue;
      started++;
      void this.#carryOut(group);
    }
    if (this.#groups.length > 0) this.#schedule();
  }

  async #carryOut({ parts, begin, end, controller: { signal } }: Group): Promise<void> {
    const answer = (bytes: Uint8Array, length: number) => {
      for (const part of parts) {
        if (part.done || part.end - begin > length) continue;
        finish(part);
        // Copies, so that no part keeps the others alive.
        part.resolve(parts.length === 1 ? bytes : bytes.slice(part.begin - begin, part.end - begin));
      }
    };
    // A single part is answered by the whole, once that is known to be neither too short nor too long.
    const arrived = parts.length === 1 ? () => undefined : answer;
    try {
      answer(await this.#request({ begin, end, signal, arrived }), end - begin);
    } catch (thrown) {
      this.#fail(parts, thrown);
    }
  }

  /** Where a request fails for good, each of its reads is tried by itself: what one of them lacks is not the others' fault. */
  #fail(parts: readonly Part[], thrown: unknown): void {
    const open = parts.filter(({ done }) => !done);
    const passing = thrown instanceof SourceError && thrown.outage !== undefined;
    if (passing || parts.length === 1) {
      for (const part of open) refuse(part, thrown);
      return;
    }
    this.#groups.push(...open.map(alone));
    this.#schedule();
  }
}

/** Parts by the requests that they go in; the request whose part was asked for first comes first. */
function grouped(parts: readonly Part[]): Group[] {
  const groups: Group[] = [];
  for (const part of [...parts].sort((a, b) => a.begin - b.begin || a.end - b.end)) {
    const last = groups.at(-1);
    if (last && part.begin <= last.end + GAP && part.end - last.begin <= LONGEST) {
      last.parts.push(part);
      last.end = Math.max(last.end, part.end);
      part.group = last;
    } else groups.push(alone(part));
  }
  const ranks = new Map<Group | undefined, number>();
  parts.forEach(({ group }, rank) => {
    if (!ranks.has(group)) ranks.set(group, rank);
  });
  return groups.sort((a, b) => ranks.get(a)! - ranks.get(b)!);
}

function alone(part: Part): Group {
  part.group = { parts: [part], begin: part.begin, end: part.end, controller: new AbortController() };
  return part.group;
}

function giveUp(part: Part, reason: unknown): void {
  refuse(part, reason);
  if (part.group?.parts.every(({ done }) => done)) part.group.controller.abort(reason);
}

function refuse(part: Part, reason: unknown): void {
  if (part.done) return;
  finish(part);
  part.reject(reason);
}

function finish(part: Part): void {
  part.done = true;
  part.deaf();
}
