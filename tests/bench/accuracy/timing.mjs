/** Rounds in which all tasks take turns, so that a busy moment of the machine hits none of them alone. */
const ROUNDS = 45;
/** Nanoseconds that a task is run for in a round, at least: enough for the compiler and the clock. */
const LEAST = 1.3e6;

/**
 * Nanoseconds per item of several tasks: the least of several rounds, the tasks taking turns.
 *
 * @param {{ task: () => void, items: number }[]} tasks what is timed, and how many items one call of it works through
 * @returns {number[]}
 */
export function nanoseconds(tasks) {
  const timed = tasks.map(({ task, items }) => {
    run(task, 3);
    return { task, items, times: Math.ceil(LEAST / run(task, 1)), best: Number.POSITIVE_INFINITY };
  });
  for (let round = 0; round < ROUNDS; round++) {
    for (const one of timed) {
      one.best = Math.min(one.best, run(one.task, one.times) / (one.times * one.items));
    }
  }
  return timed.map(({ best }) => best);
}

/** Nanoseconds that a task takes several times. */
function run(task, times) {
  const began = process.hrtime.bigint();
  for (let i = 0; i < times; i++) task();
  return Number(process.hrtime.bigint() - began);
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
