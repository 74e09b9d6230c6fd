/**
 * One method in one panel, over all places that it was measured at.
 *
 * @typedef {object} Summary
 * @property {string} panel
 * @property {string} method
 * @property {number} ns median over the places
 * @property {number} fastest
 * @property {number} slowest
 * @property {number} error greatest of all places
 * @property {boolean} chosen whether it is the default at one of the places at least
 */

/**
 * @param {{ panel: string, method: string, ns: number, error: number, chosen?: boolean }[]} rows one per panel, method
 *   and place
 * @returns {Summary[]} in the order in which panels and methods come first
 */
export function summarise(rows) {
  const groups = new Map();
  for (const row of rows) {
    const key = `${row.panel}: ${row.method}`;
    groups.set(key, [...(groups.get(key) ?? []), row]);
  }
  return [...groups.values()].map((group) => {
    const times = group.map(({ ns }) => ns).sort((a, b) => a - b);
    return {
      panel: group[0].panel,
      method: group[0].method,
      ns: times[Math.floor(times.length / 2)],
      fastest: times[0],
      slowest: times[times.length - 1],
      error: Math.max(...group.map(({ error }) => error)),
      chosen: group.some(({ chosen }) => chosen),
    };
  });
}

/** Those that no other beats in both time and error, fastest first. */
export function paretoFront(summaries) {
  const front = [];
  for (const one of [...summaries].sort((a, b) => a.ns - b.ns || a.error - b.error)) {
    if (front.length === 0 || one.error < front[front.length - 1].error) front.push(one);
  }
  return front;
}
