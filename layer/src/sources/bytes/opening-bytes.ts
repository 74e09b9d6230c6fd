/** Asks for the bytes, and tells of them as they come: all that there is room for, of which so many are there. */
type OpeningRequest = (arrived: (bytes: Uint8Array, length: number) => void) => Promise<Uint8Array>;

/**
 * The bytes that a file begins with, which one request brings. They are read as they come: what stands in front is used while
 * the others are still on their way.
 */
export class OpeningBytes {
  /** Settles once the first bytes are here, or none are to be had: what the request throws then. */
  readonly begun: Promise<void>;
  #end: number;
  #here: Uint8Array = new Uint8Array(0);
  /** Settles as more comes; undefined once nothing more will. */
  #more: Promise<void> | undefined;
  #told: () => void = () => undefined;
  /** What ended the request before all bytes were here, for those who wait for them. */
  #failure: { readonly thrown: unknown } | undefined;

  /** @param end byte up to which is asked for; the answer may end before it, with the file */
  constructor(end: number, request: OpeningRequest) {
    this.#end = end;
    this.#await();
    const whole = request((bytes, length) => this.#take(bytes.subarray(0, length))).then((bytes) =>
      this.#take(bytes),
    );
    this.begun = Promise.race([whole, this.#more]);
    whole.then(
      () => this.#stop(),
      (thrown: unknown) => {
        this.#failure = { thrown };
        this.#stop();
      },
    );
  }

  /** Byte up to which they reach, or will. */
  get end(): number {
    return this.#end;
  }

  /**
   * A view of some of them, once they are here; of fewer where the answer ended before. Those who wait when the request fails
   * hear of it; after that, what did not come is no longer among them.
   * @throws what the request throws
   */
  async read(begin: number, end: number): Promise<Uint8Array> {
    while (this.#here.length < end) {
      if (this.#failure) throw this.#failure.thrown;
      if (!this.#more) break;
      await this.#more;
    }
    return this.#here.subarray(begin, end);
  }

  /** A repeated attempt begins from the start: what is here stays. */
  #take(bytes: Uint8Array): void {
    if (bytes.length > this.#here.length) this.#here = bytes;
    const told = this.#told;
    this.#await();
    told();
  }

  #await(): void {
    this.#more = new Promise((resolve) => {
      this.#told = resolve;
    });
  }

  #stop(): void {
    const told = this.#told;
    this.#end = this.#here.length;
    this.#more = undefined;
    told();
  }
}
