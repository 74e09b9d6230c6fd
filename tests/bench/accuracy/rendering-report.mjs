import { length } from "./chart.mjs";
import { FINE, measureEffects, pointsInSight } from "./rendering.mjs";
import { renderingChart } from "./rendering-chart.mjs";
import { percent, points } from "./rendering-figures.mjs";
import { DRAWN, measureStorage, STORAGES } from "./rendering-storage.mjs";
import { comparison, onScan } from "./scan-report.mjs";
import { digits, markdownTable } from "./table.mjs";

const TITLE = "Drawing: error against time and bytes";

/** Metres: the tolerance of a data set that names none. */
const TOLERANCE = 0.001;

/** What drawing costs, by effect and storage of vertices. */
export function renderingReport(root) {
  return onScan(root, "rendering", async (file, openPage) => {
    const storage = await measureStorage(file);
    const { page, setting } = await openPage();
    const inSight = await pointsInSight(page);
    return reportOf(await measureEffects(page), storage, inSight, setting);
  });
}

/**
 * @param {object[]} measured effects
 * @param {{ rows: object[], step: number }} stored vertices
 * @param {number} inSight points of the scan that are in sight
 * @param {string} packages what it was measured with
 */
export function reportOf(measured, { rows: storage, step }, inSight, packages) {
  const effects = measured.map(({ picture, ...row }) => row);
  const pictures = measured.flatMap(({ effect, picture }) => (picture ? [{ effect, ...picture }] : []));
  const built = storage.filter(({ storage }) => storage !== DRAWN);
  return {
    title: TITLE,
    text: describe(effects, inSight, step),
    svg: renderingChart({ effects, storage: built }, TOLERANCE, TITLE),
    table: tables({ effects, storage }, pictures),
    packages,
    rows: [...effects, ...storage],
    files: pictures.map(({ name, data }) => [`rendering-${name}.jpg`, Buffer.from(data, "base64")]),
  };
}

function describe(effects, inSight, step) {
  const times = (row) => `${row.ratio.toFixed(2)} ×`;
  const find = (name) => effects.find(({ effect }) => effect.startsWith(name));
  return (
    `${comparison(inSight)} How densely points are drawn is [another report](detail.md).\n\n` +
    "**Effects** are drawn on and off with the layer's defaults otherwise (budget of 1,000,000 points, screen-space error " +
    "of 2 px, points of 2 px). Those that fill what lies between points are held against one picture of full density; " +
    "the others show something else, and are held against one that shows it too. Shapes are compared at adaptive sizes, " +
    `splats with discs. The same picture twice is the noise: ${times(effects[0])}. Blended splats take ` +
    `${times(find("blended"))} the frame time, Eye-Dome Lighting ${times(find("Eye-Dome Lighting, 4"))} with four ` +
    `neighbours and ${times(find("Eye-Dome Lighting, 8"))} with eight. ` +
    "Splats and Eye-Dome Lighting share one pass over the points for their depth: with both, a frame takes " +
    `${times(find("Eye-Dome Lighting, 4, on"))} that of splats. ` +
    `Logarithmic depth takes ${times(find("logarithmic"))} the frame time of a linear one, positions as float32 ` +
    `(a tolerance of ${length(FINE)}, 16 bytes a point with colours) ${times(find("positions"))} that of whole steps (12 bytes); ` +
    "the cloud with that tolerance has read no more than its view wants, and so leaves out nodes of which less than an eighth would show. " +
    "A filter draws what it leaves out outside the picture: its points are counted all the same. The scan records no " +
    "classes: the colours are those of one.\n\n" +
    "**Storage** is the distance of stored coordinates, as the vertex shader brings them back in float32, from the " +
    "float64 places of the records, at up to six nodes of each level; `drawn` is what the page really draws: whole steps from a fit " +
    `that keeps the tolerance of ${length(TOLERANCE)} with them, float32 where there is none. One step of the scan's own integers ` +
    `is ${length(step)}.`
  );
}

function tables({ effects, storage }, pictures) {
  return [
    "## Effects",
    markdownTable(effects.map(effectRow)),
    ...pictures.map(
      ({ effect, name }) => `![${effect}](rendering-${name}.jpg)\n\n*${effect}: off, on, full density.*`,
    ),
    "## Vertex storage",
    markdownTable(storageRows(storage)),
  ].join("\n\n");
}

function effectRow(row) {
  const difference = (rms, pixels) => `${rms.toFixed(1)}, ${percent(pixels)}`;
  return {
    effect: row.effect,
    "points off → on": `${points(row.offPoints)} → ${points(row.onPoints)}`,
    "bytes a point": row.offBytes === row.onBytes ? String(row.onBytes) : `${row.offBytes} → ${row.onBytes}`,
    "ms off → on": `${digits(row.offMs)} → ${digits(row.onMs)}`,
    "on : off": row.ratio.toFixed(2),
    quartiles: row.ratioQuartiles.map((ratio) => ratio.toFixed(2)).join(" – "),
    "change (RMS, pixels)": difference(row.changeRms, row.changedPixels),
    "to full density, off": difference(row.offRms, row.offWrongPixels),
    "to full density, on": difference(row.onRms, row.onWrongPixels),
  };
}

/** One per storage and level. */
function storageRows(rows) {
  const kinds = [...STORAGES.map(({ storage }) => storage), DRAWN];
  const levels = [...new Set(rows.map(({ level }) => level))];
  return kinds.flatMap((kind) =>
    levels.map((level) => {
      const nodes = rows.filter((row) => row.storage === kind && row.level === level);
      const [{ storage, chosen }] = nodes;
      return {
        storage: chosen ? `**${storage}**` : storage,
        "bytes/vertex": [...new Set(nodes.map(({ bytes }) => bytes))].sort((a, b) => a - b).join(", "),
        level: String(level),
        "node edge": length(Math.max(...nodes.map(({ edge }) => edge))),
        nodes: String(nodes.length),
        "greatest error": length(Math.max(...nodes.map(({ worst }) => worst))),
        mean: length(nodes.reduce((sum, { mean }) => sum + mean, 0) / nodes.length),
      };
    }),
  );
}
