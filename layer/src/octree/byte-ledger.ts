/** Share of the limit down to which bytes are given up once it is passed; as in the cache. */
const LOW = 0.8;

/** Adds up what several owners hold of one limited thing. */
export class ByteLedger {
  /** Bytes that they may hold together. */
  limit: number;
  readonly #held = new Map<object, number>();
  #used = 0;

  constructor(limit: number) {
    this.limit = limit;
  }

  /** Bytes held by all. */
  get used(): number {
    return this.#used;
  }

  /** Bytes that are to be given up: none up to the limit, beyond it so many that room is left. */
  get excess(): number {
    return this.#used > this.limit ? this.#used - LOW * this.limit : 0;
  }

  /** Tells what an owner holds now; 0 takes it off the list. */
  report(owner: object, bytes: number): void {
    this.#used += bytes - (this.#held.get(owner) ?? 0);
    if (bytes === 0) this.#held.delete(owner);
    else this.#held.set(owner, bytes);
  }
}
