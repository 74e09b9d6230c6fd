/**
 * A Markdown table.
 *
 * @param {Record<string, string>[]} rows all with the same members; numbers are set to the right
 */
export function markdownTable(rows) {
  const names = Object.keys(rows[0]);
  const numeric = names.map((name) => rows.every((row) => /^[-–×≤<]*\s*[\d–]/.test(row[name])));
  const line = (cells) => `| ${cells.join(" | ")} |`;
  return [
    line(names),
    line(numeric.map((right) => (right ? "--:" : ":--"))),
    ...rows.map((row) => line(names.map((name) => row[name]))),
  ].join("\n");
}

/** Nanoseconds in two or three digits. */
export function digits(value) {
  return value >= 100 ? String(Math.round(value)) : value.toFixed(1);
}

/** The median, and the span over the places if there are several. */
export function span({ ns, fastest, slowest }) {
  const [low, high] = [digits(fastest), digits(slowest)];
  return low === high ? digits(ns) : `${digits(ns)} (${low} – ${high})`;
}
