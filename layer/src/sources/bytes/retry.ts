/** How often and how patiently a request is repeated. */
export interface RetryPolicy {
  /** Attempts in all, the first included. */
  readonly attempts: number;
  /** Wait before the second attempt in milliseconds; doubled before each further one. */
  readonly backoff: number;
}

/** Marks a failure that another attempt may mend (5xx, timeout, network); `final` is thrown when none is left. */
export class Transient extends Error {
  constructor(readonly final: Error) {
    super(final.message);
  }
}

/** Resolves after `milliseconds`, rejects with the signal's reason as soon as it is aborted. */
function wait(milliseconds: number, signal?: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const stop = () => {
      clearTimeout(timer);
      reject(signal?.reason);
    };
    const timer = setTimeout(() => {
      signal?.removeEventListener("abort", stop);
      resolve();
    }, milliseconds);
    signal?.addEventListener("abort", stop, { once: true });
  });
}

/**
 * Runs `attempt` until it succeeds, fails with anything but {@link Transient}, or the policy is used up.
 * Waits grow by powers of two with ±25 % of jitter, so that many nodes do not come back in one burst.
 */
export async function withRetries<T>(
  policy: RetryPolicy,
  signal: AbortSignal | undefined,
  attempt: () => Promise<T>,
): Promise<T> {
  for (let tried = 1; ; tried++) {
    signal?.throwIfAborted();
    try {
      return await attempt();
    } catch (thrown) {
      if (!(thrown instanceof Transient)) throw thrown;
      if (tried >= policy.attempts) throw thrown.final;
    }
    await wait(policy.backoff * 2 ** (tried - 1) * (0.75 + 0.5 * Math.random()), signal);
  }
}
