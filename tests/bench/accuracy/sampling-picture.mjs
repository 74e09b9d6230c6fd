/** Pixels of a panel's edge. */
const PANEL = 440;
const GAP = 24;
const TITLE = 22;
const INK = "#1f2933";
const BORDER = "#d55e00";

/**
 * Samples from above, a panel per strategy: points as dots, the borders of the four nodes that meet in the middle as
 * lines.
 *
 * @param {{ name: string, side: number, points: [number, number][] }[]} panels side in spacings, points in tenths of one
 * @param {string} title for those who do not see it
 * @returns {string} SVG
 */
export function samplePicture(panels, title) {
  const width = 2 * PANEL + 3 * GAP;
  const height = Math.ceil(panels.length / 2) * (PANEL + TITLE + GAP) + GAP;
  const drawn = panels.map((one, i) => panel(one, (i % 2) * (PANEL + GAP) + GAP, Math.floor(i / 2)));
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" ` +
    `role="img" aria-label="${title}" font-family="sans-serif" font-size="13" fill="${INK}">\n` +
    `<rect width="${width}" height="${height}" fill="white"/>\n${drawn.join("\n")}\n</svg>\n`
  );
}

function panel({ name, side, points }, left, row) {
  const top = row * (PANEL + TITLE + GAP) + GAP;
  const scale = PANEL / (10 * side);
  const middle = 5 * side;
  // One path of lines without length: their round ends are the dots. Places count from the dot before.
  let [atX, atY] = [0, 0];
  const dots = points.map(([x, y]) => {
    const step = `m${x - atX} ${10 * side - y - atY}h0`;
    [atX, atY] = [x, 10 * side - y];
    return step;
  });
  return (
    `<text x="${left}" y="${top + 14}" font-weight="bold">${name}</text>\n` +
    `<g transform="translate(${left} ${top + TITLE}) scale(${scale.toFixed(4)})" fill="none">` +
    `<rect width="${10 * side}" height="${10 * side}" stroke="#d5dae0" stroke-width="1"/>` +
    `<path d="M${middle} 0v${10 * side}M0 ${middle}h${10 * side}" stroke="${BORDER}" stroke-width="1"/>` +
    `<path d="${dots.join("")}" stroke="${INK}" stroke-width="4" stroke-linecap="round"/></g>`
  );
}
