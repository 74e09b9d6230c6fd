type Method = (this: unknown, ...args: unknown[]) => unknown;

/**
 * Marks where parts of a frame begin and end in the browser's trace, which knows the CPU time of the thread: what other
 * programs take of the machine meanwhile does not count.
 */
export function within<Result>(part: string, work: () => Result): Result {
  performance.mark(`> ${part}`);
  try {
    return work();
  } finally {
    performance.mark("<");
  }
}

/** Marks each call of methods of a prototype or an object. */
export function wrap(target: object, names: readonly string[], part: string): void {
  const methods = target as Record<string, Method>;
  for (const name of names) {
    const method = methods[name]!;
    methods[name] = function (...args) {
      return within(part, () => method.apply(this, args));
    };
  }
}

/** What comes now belongs to a phase of this name. */
export function phase(name: string): void {
  performance.mark(`phase ${name}`);
}

/** A frame, and what the application calls before it, begins. */
export function frame(): void {
  performance.clearMarks();
  performance.mark("frame");
}
