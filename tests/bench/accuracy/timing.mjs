/** Rounds in which all tasks take turns, so that a busy moment of the machine hits none of them alone. */
const ROUNDS = 9;

/**
 * Nanoseconds per item of several tasks: the least of several rounds, the tasks taking turns.
 *
 * @param {{ task: () => void, items: number }[]} tasks what is timed, and how many items one call of it works through
 * @returns {number[]}
 */
export function nanoseconds(tasks) {
  const best = tasks.map(() => Number.POSITIVE_INFINITY);
  for (let round = 0; round < ROUNDS; round++) {
    for (const [i, { task, items }] of tasks.entries()) {
      const began = process.hrtime.bigint();
      task();
      best[i] = Math.min(best[i], Number(process.hrtime.bigint() - began) / items);
    }
  }
  return best;
}

/** A reproducible generator of numbers from 0 to 1 (mulberry32). */
export function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
