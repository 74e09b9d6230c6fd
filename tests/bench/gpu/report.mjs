import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import * as Plot from "@observablehq/plot";
import { parseHTML } from "linkedom";

const FOLDER = "docs/bench";
const figure = (value, digits = 1) => value.toFixed(digits);

/** Writes frames.json, frames.svg and frames.md. */
export function writeReport(root, about, rows) {
  writeFigures(root, "frames.json", { ...about, rows });
  writeFileSync(join(root, FOLDER, "frames.svg"), `${chart(rows)}\n`);
  writePage(root);
}

/** Writes nodes.json, and frames.md with it. */
export function writeNodes(root, figures) {
  writeFigures(root, "nodes.json", figures);
  writePage(root);
}

function writeFigures(root, file, figures) {
  mkdirSync(join(root, FOLDER), { recursive: true });
  const cpu = `${cpus()[0]?.model ?? "unknown"}, ${cpus().length} cores`;
  const dated = { date: new Date().toISOString().slice(0, 10), cpu, ...figures };
  writeFileSync(join(root, FOLDER, file), `${JSON.stringify(dated, null, 2)}\n`);
}

/** The page of what was measured so far, each part with its own day and machine. */
function writePage(root) {
  const parts = [
    ["frames.json", page],
    ["nodes.json", nodesPart],
  ];
  const texts = parts.flatMap(([file, textOf]) => {
    const path = join(root, FOLDER, file);
    return existsSync(path) ? [textOf(JSON.parse(readFileSync(path, "utf8")))] : [];
  });
  writeFileSync(join(root, FOLDER, "frames.md"), texts.join("\n"));
}

function nodesPart({ date, cpu, load, setting, clouds, nodes, points, ...figures }) {
  const head = ["view", "ms a frame", "µs a node"];
  const rows = [
    ["moving", figures["moving, ms"].toFixed(2), figures["moving, µs a node"].toFixed(2)],
    ["still", figures["still, ms"].toFixed(2), figures["still, µs a node"].toFixed(2)],
    ["layers hidden", figures["empty, ms"].toFixed(2), ""],
  ];
  const table = [head, head.map(() => "---"), ...rows].map((row) => `| ${row.join(" | ")} |`).join("\n");
  return `## Script of many nodes

Autzen opened ${clouds} times in one scene of Cesium, ${nodes.toLocaleString("en")} nodes with ${points.toLocaleString("en")} points in the mean of 12 poses, fixed 2 px,
all of them loaded before. Processor time of the page's thread by Chromium's trace, medians of 60 frames, Cesium's own part included; a
node's share is without what the same frame takes where the layers are hidden. Points are not rasterised.

${table}

${date}; ${cpu}, load ${figure(load)}; ${setting}. Written by \`npm run bench -- frames\`.
`;
}

const nameOf = ({ style, logDepth }) => (logDepth ? style : `${style}, linear depth`);

function chart(rows) {
  const { document } = parseHTML("<html><body></body></html>");
  const shown = [
    ...rows.map((row) => ({ points: row.points, series: nameOf(row), ms: row.frame })),
    ...rows.map((row) => ({ points: row.points, series: "plain gl.POINTS", ms: row.plain })),
  ];
  const svg = Plot.plot({
    document,
    width: 720,
    height: 360,
    marginLeft: 60,
    marginBottom: 45,
    style: { fontFamily: "sans-serif", fontSize: "12px", background: "white", color: "#1f2933" },
    x: { type: "log", label: "points", tickFormat: "~s", grid: true, ticks: 5 },
    y: { label: "ms a frame", grid: true, zero: true },
    color: { legend: false, scheme: "tableau10" },
    marks: [
      Plot.line(
        shown,
        Plot.groupX({ y: "median" }, { x: "points", y: "ms", stroke: "series", z: "series", sort: "points" }),
      ),
      Plot.dot(shown, { x: "points", y: "ms", fill: "series", z: "series" }),
      Plot.text(
        shown,
        Plot.selectLast({ x: "points", y: "ms", text: "series", z: "series", textAnchor: "end", dy: -8 }),
      ),
    ],
  });
  svg.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  return svg.outerHTML;
}

function page({ date, cpu, setting, renderer, card, size, frames, load, rows }) {
  const head = [
    "drawn",
    "points",
    "nodes",
    "ms a frame",
    "of it script",
    "still",
    "empty scene",
    "plain `gl.POINTS`",
    "× plain",
  ];
  const cells = rows.map((row) => [
    nameOf(row),
    row.points.toLocaleString("en"),
    String(row.nodes),
    figure(row.frame),
    figure(row.script, 2),
    row.still === undefined ? "–" : figure(row.still),
    figure(row.empty),
    figure(row.plain),
    figure(row.frame / row.plain, 2),
  ]);
  const table = [head, head.map(() => "---"), ...cells].map((row) => `| ${row.join(" | ")} |`).join("\n");
  const times = card
    ? `The least of ${frames} frames, since other work on the machine only adds`
    : `The mean of ${frames} frames in milliseconds of the processor, of all threads of the browser`;
  return `# What a frame takes

Autzen in Cesium, seen whole, 2 px points, ${size.width} × ${size.height} px, beside the same points from one buffer by plain
\`gl.POINTS\` in the same browser, in turns. ${times}, from the
call to the picture, of a view that moves by a millimetre; "still" is a view that does not move, "empty scene" Cesium with
the layer hidden, "script" what the page's thread takes by the clock, the least. Only ratios within a run count.

${table}

![ms a frame by points](frames.svg)

${date}; ${cpu}, load ${figure(load)}; ${setting}; ${renderer}. Written by \`npm run bench -- gpu\`; with \`--card\` it draws by a
graphics card, with \`--points 1000000,10000000\` as many points as are asked for.
`;
}
