import { AVERAGED, CHOSEN, measureSampling, ROUNDS } from "./sampling.mjs";
import { samplePicture } from "./sampling-picture.mjs";
import { markdownTable } from "./table.mjs";

/** What a choice of samples costs and how even it is, on a real scan, where that is there. */
export async function samplingReport(root, core) {
  const results = measureSampling(root, core);
  if (!results) {
    console.log("sampling: autzen.laz is not in ../shared/data: left out");
    return undefined;
  }
  const measured = results.filter(({ samples }) => samples);
  const rows = measured.flatMap(levelRows);
  return {
    title: "Samples: evenness against time and bytes",
    text: describe(results, measured),
    svg: samplePicture(
      measured.map(({ strategy, samples }) => ({ name: strategy, ...samples.picture })),
      "Levels 0 to 2 of the scan from above, where four nodes meet, by strategy",
    ),
    table: `${markdownTable(results.map(costRow))}\n\n${markdownTable(rows.map(tableRow))}`,
    packages: "copclib, laspy and scipy of `tests/requirements.txt`",
    how: `Times are the least of ${ROUNDS} rounds in which all strategies take turns; where the load is above the number of cores, only the ratios of processor times count.`,
    rows: [...results.map(({ samples, ...cost }) => cost), ...rows],
  };
}

/** Levels with inner nodes: below them there are leaves only, which hold all that is left. */
function levelRows({ strategy, samples }) {
  return samples.levels.filter(({ innerNodes }) => innerNodes > 0).map((level) => ({ strategy, ...level }));
}

const named = (strategy) => (strategy === CHOSEN ? `**${strategy}**` : strategy);
const percent = (share) =>
  share === null || share === undefined
    ? "–"
    : `${(100 * share).toFixed(share > 0 && share < 0.01 ? 2 : 0)} %`;
const fixed = (value, error) =>
  value === null || value === undefined ? "–" : `${value.toFixed(2)} ± ${error.toFixed(2)}`;

function costRow({ strategy, wall, cpu, peak, bytes }, _index, [first]) {
  return {
    strategy: named(strategy),
    "wall time": `${wall.toFixed(1)} s`,
    "processor time": `${cpu.toFixed(1)} s`,
    "against poisson": `${(cpu / first.cpu).toFixed(2)} ×`,
    "peak memory": `${Math.round(peak / 2 ** 20)} MiB`,
    "file size": `${(bytes / 1e6).toFixed(1)} MB`,
  };
}

function tableRow({
  strategy,
  level,
  nodes,
  innerNodes,
  inner,
  leaves,
  shownBelowOne,
  density,
  hole,
  hole999,
}) {
  return {
    strategy: named(strategy),
    level: String(level),
    "nodes (inner)": `${nodes} (${innerNodes})`,
    "points of inner nodes": inner.points.toLocaleString("en"),
    "in the node < 0.5 / < 1": `${percent(inner.insideBelowHalf)} / ${percent(inner.insideBelowOne)}`,
    "across borders < 0.5 / < 1": `${percent(inner.acrossBelowHalf)} / ${percent(inner.acrossBelowOne)}`,
    "shown < 1": percent(shownBelowOne),
    "leaves < 0.5 / < 1": `${percent(leaves.belowHalf)} / ${percent(leaves.belowOne)}`,
    "density at borders": fixed(density.border, density.borderError),
    "own points only": fixed(density.own, density.ownError),
    "no border": fixed(density.middle, density.middleError),
    "largest hole (99.9 %)": hole === undefined ? "–" : `${hole.toFixed(2)} (${hole999.toFixed(2)})`,
  };
}

function describe(results, measured) {
  const chosen = measured.find(({ strategy }) => strategy === CHOSEN);
  const averaged = results.find(({ strategy }) => strategy === AVERAGED);
  const levels = chosen.samples.levels.filter(({ innerNodes }) => innerNodes > 0);
  const pairs = levels.reduce((sum, { inner }) => sum + inner.pairsBelowOne, 0);
  const { prefix } = chosen.samples;
  const grid = measured.find(({ strategy }) => strategy === "grid");
  const costOf = (name) => results.find(({ strategy }) => strategy === name);
  const shown = ({ samples }) =>
    samples.levels
      .slice(0, 3)
      .reduce((sum, { points }) => sum + points, 0)
      .toLocaleString("en");
  const more = (part, whole) => `${(100 * (part / whole - 1)).toFixed(0)} %`;
  return [
    "`autzen.laz` (10,653,336 points), converted by each strategy of `groma convert --sampling` and read back by copclib. A node " +
      "has the spacing of a 128th of its cube. `poisson` takes points in random order, none closer than the spacing to another of " +
      "its level; `grid` of each cell of a spacing the point nearest to its centre; `first` of each cell the first of the input; " +
      "`random` as many points as there are such cells, anywhere. Shares are of points that have a neighbour closer than a half or " +
      "than one spacing: in the same inner node; across borders, of points within one spacing of a face to another inner node; shown, " +
      "of all inner nodes of levels up to this one together; leaves hold all that is left, at whatever distance.",
    "Density at borders: points in the first quarter of a spacing at the x and y faces of two inner nodes, per width, over those from " +
      "two to six spacings inside, of the levels shown together and of the level's own points; “no border” is the same at planes " +
      "through the middle of nodes, and tells what chance and the scan do (`grid` keeps off the faces of its cells everywhere). " +
      "Errors are one standard deviation of the counts. Largest hole: the farthest that a point of the scan (every eighth) is from " +
      "what is shown, in spacings.",
    `With \`poisson\`, the default, ${pairs} pairs of points of inner nodes of one level are closer than the spacing, borders ` +
      `included; levels 0 to 2 take ${shown(chosen)} points where \`grid\` takes ${shown(grid)}, for ${(costOf(CHOSEN).cpu / costOf("grid").cpu).toFixed(2)} times ` +
      "its processor time. `--average-colors` takes the same points and costs " +
      `${more(averaged.cpu, costOf(CHOSEN).cpu)} more processor time. The picture: levels 0 to 2 from above where four nodes meet (lines), 44 spacings wide.`,
    "Order inside a node: so that every prefix of a node is a sample of it (Kanzok et al. 2015), points could stand in bit-reversed order of " +
      `their rank along the Morton curve. Compressed by lazrs, ${prefix.nodes} nodes of all levels then take ` +
      `${more(prefix.prefixOrder, prefix.asStored)} more bytes than as they are stored (${prefix.prefixOrder.toLocaleString("en")} against ` +
      `${prefix.asStored.toLocaleString("en")}): more than a tenth, so files keep the order that compresses well, and the page's worker ` +
      "may reorder.",
  ].join("\n\n");
}
