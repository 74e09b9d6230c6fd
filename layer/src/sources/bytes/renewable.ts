/** Why an application is asked for an address or for headers. */
export interface RenewalContext {
  /** `open`: for the first time; `expired`: the former ones have had their time; `denied`: the server refuses them. */
  readonly reason: "open" | "expired" | "denied";
  /** HTTP status of the refusal, 401 or 403, where that is the reason. */
  readonly status?: number | undefined;
}

/** Something with the time until which it holds: a `Date`, or milliseconds since 1970. */
export interface Expiring<T> {
  readonly value: T;
  readonly expires?: number | undefined;
}

/** Milliseconds before its end at which something counts as expired, since a request takes its time. */
const MARGIN = 5_000;

/**
 * What a source asks with: given once, or by a function that is called again when it has expired or the server refuses
 * it. All who ask meanwhile wait for one call.
 */
export class Renewable<T> {
  readonly #renew: ((context: RenewalContext) => Promise<Expiring<T>>) | undefined;
  #current: Expiring<T> | undefined;
  #asking: Promise<T> | undefined;

  constructor(
    given: { readonly value: T } | { readonly renew: (context: RenewalContext) => Promise<Expiring<T>> },
  ) {
    if ("renew" in given) this.#renew = given.renew;
    else this.#current = given;
  }

  /** What holds now; renewed before where it has expired. */
  async get(): Promise<T> {
    const current = this.#current;
    if (this.#asking) return this.#asking;
    if (!current) return this.#ask({ reason: "open" });
    const left = (current.expires ?? Number.POSITIVE_INFINITY) - Date.now();
    return left > MARGIN || !this.#renew ? current.value : this.#ask({ reason: "expired" });
  }

  /**
   * Has what a server refuses replaced, unless it was already.
   * @returns whether there is something else to try
   */
  async replace(refused: T, status: number): Promise<boolean> {
    if (!this.#renew) return false;
    if (this.#asking) await this.#asking;
    else if (this.#current?.value === refused) await this.#ask({ reason: "denied", status });
    return true;
  }

  #ask(context: RenewalContext): Promise<T> {
    const ask = async () => {
      try {
        this.#current = await this.#renew!(context);
        return this.#current.value;
      } finally {
        this.#asking = undefined;
      }
    };
    this.#asking = ask();
    return this.#asking;
  }
}
