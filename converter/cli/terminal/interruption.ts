import { GromaError } from "@groma/georef";

/** The user, or the machine, stopped the command. Code: INTERRUPTED. */
class InterruptionError extends GromaError {
  static override readonly kind = "InterruptionError";
}

const SIGNALS = ["SIGINT", "SIGTERM", "SIGHUP"] as const;

/**
 * Does work that can be stopped: from now to its end a signal to this process does not end it but aborts, so that
 * whoever holds temporary files or started programs tidies up on the way out.
 *
 * @param work is given the signal; its reason is an InterruptionError
 */
export async function interruptible<T>(work: (signal: AbortSignal) => Promise<T>): Promise<T> {
  const controller = new AbortController();
  const stop = () =>
    controller.abort(
      new InterruptionError({
        ...{ code: "INTERRUPTED", file: "groma", cause: "the command was stopped" },
        fix: "run it again",
      }),
    );
  for (const signal of SIGNALS) process.on(signal, stop);
  try {
    return await work(controller.signal);
  } finally {
    for (const signal of SIGNALS) process.off(signal, stop);
  }
}
