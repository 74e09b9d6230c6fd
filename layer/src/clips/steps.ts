/** Work in steps of a fraction of a millisecond each, so that it can be spread over frames; the last gives the result. */
export type Steps<Result> = Generator<undefined, Result>;

/** Vertices of a ring that one step takes. */
export const STRIDE = 64;

/** Does all steps at once. */
export function finish<Result>(steps: Steps<Result>): Result {
  for (;;) {
    const { done, value } = steps.next();
    if (done) return value;
  }
}
