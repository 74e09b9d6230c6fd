import * as Plot from "@observablehq/plot";
import { parseHTML } from "linkedom";
import { paretoFront } from "./summary.mjs";

/** Okabe and Ito's colours, which most colour-blind people can tell apart, and four more. */
export const COLOURS = [
  ...["#0072b2", "#56b4e9", "#009e73", "#e69f00", "#d55e00", "#cc79a7", "#000000"],
  ...["#777777", "#aaaaaa", "#8c510a", "#5e3c99", "#1b9e77", "#b2182b", "#4d4d4d"],
];
export const SYMBOLS = [
  ...["circle", "square", "triangle", "diamond", "star", "cross", "wye"],
  ...["times", "asterisk", "diamond2", "square2", "triangle2", "hexagon", "plus"],
];
export const INK = "#1f2933";
export const FRONT = "#9aa5b1";
const HEIGHT = 250;
const MARGIN = 70;

/**
 * Error against time, both logarithmic, a panel per size or place: each method a point, a thin line from its fastest to
 * its slowest place, the Pareto front joined, the default ringed.
 *
 * @param {object} spec
 * @param {import("./summary.mjs").Summary[]} spec.summaries
 * @param {string[]} spec.methods in the order of the legend
 * @param {number} spec.columns panels beside each other; the legend takes the cell after the last
 * @param {[number, number]} spec.errors lowest and highest error shown; what is below is drawn on the edge
 * @param {number} [spec.tolerance] line to draw
 * @returns {string} SVG
 */
export function paretoChart({ summaries, methods, columns, errors, tolerance, title, time, error, unit }) {
  const panels = [...new Set(summaries.map(({ panel }) => panel))];
  const cell = (i) => ({ column: i % columns, row: Math.floor(i / columns) });
  const place = new Map(panels.map((panel, i) => [panel, cell(i)]));
  const shown = summaries.map((one) => ({
    ...one,
    ...place.get(one.panel),
    error: Math.max(one.error, errors[0]),
  }));
  const fronts = panels.flatMap((panel) => paretoFront(shown.filter((one) => one.panel === panel)));
  const times = shown.flatMap(({ fastest, slowest }) => [fastest, slowest]);
  const x = [Math.min(...times) / 1.5, Math.max(...times) * 1.5];
  const rows = Math.ceil((panels.length + 1) / columns);
  const { document } = parseHTML("<html><body></body></html>");
  const at = { fx: "column", fy: "row" };
  const point = { x: "ns", y: "error", stroke: "method", symbol: "method", ...at };

  const svg = Plot.plot({
    document,
    width: 300 * columns + MARGIN,
    height: HEIGHT * rows + MARGIN,
    marginLeft: MARGIN,
    marginBottom: 50,
    marginTop: 40,
    marginRight: 10,
    style: { fontFamily: "sans-serif", fontSize: "12px", background: "white", color: INK },
    x: { type: "log", domain: x, label: time, grid: true, tickFormat: "~s", ticks: 4 },
    y: {
      type: "log",
      domain: errors,
      label: error,
      grid: true,
      tickFormat: (value) => length(value, unit),
      ticks: 6,
    },
    fx: { axis: null, padding: 0.06 },
    fy: { axis: null, padding: 0.14 },
    color: { domain: methods, range: COLOURS },
    symbol: { domain: methods, range: SYMBOLS },
    marks: [
      Plot.frame({ stroke: "#d5dae0" }),
      tolerance === undefined
        ? null
        : Plot.ruleY([tolerance], { stroke: "#c0392b", strokeDasharray: "4 3", strokeWidth: 1 }),
      Plot.line(fronts, {
        x: "ns",
        y: "error",
        z: "panel",
        stroke: FRONT,
        strokeWidth: 5,
        strokeOpacity: 0.5,
        ...at,
      }),
      Plot.link(shown, {
        ...{ x1: "fastest", x2: "slowest", y1: "error", y2: "error" },
        ...{ stroke: "method", strokeWidth: 1, ...at },
      }),
      Plot.dot(shown, { ...point, fill: "method", r: 4 }),
      Plot.dot(
        shown.filter(({ chosen }) => chosen),
        { x: "ns", y: "error", stroke: INK, strokeWidth: 1.5, r: 9, ...at },
      ),
      Plot.text(panels, {
        text: (panel) => panel,
        fx: (panel) => place.get(panel).column,
        fy: (panel) => place.get(panel).row,
        ...{ frameAnchor: "top", dy: -14, fontWeight: "bold" },
      }),
      ...legend(methods, cell(panels.length), errors, x, tolerance, unit),
    ],
  });
  svg.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", title);
  return `${svg.outerHTML}\n`;
}

/** Marks that explain the others, in a cell of their own. */
function legend(methods, { column, row }, [low, high], [left, right], tolerance, unit) {
  const entries = [
    ...methods.map((method) => ({ text: method, method })),
    { text: "default", ring: true },
    { text: "Pareto front", line: FRONT },
    ...(tolerance === undefined ? [] : [{ text: `tolerance ${length(tolerance, unit)}`, line: "#c0392b" }]),
  ].map((entry, i, all) => ({
    ...entry,
    column,
    row,
    x: left * (right / left) ** 0.12,
    x0: left * (right / left) ** 0.08,
    x1: left * (right / left) ** 0.16,
    y: high * (low / high) ** ((i + 0.7) / Math.max(all.length, 8)),
  }));
  const at = { fx: "column", fy: "row" };
  return [
    Plot.frame({
      fx: () => column,
      fy: () => row,
      fill: "white",
      stroke: "white",
      strokeWidth: 3,
      anchor: null,
    }),
    Plot.dot(
      entries.filter(({ method }) => method),
      { x: "x", y: "y", fill: "method", stroke: "method", symbol: "method", r: 4, ...at },
    ),
    Plot.dot(
      entries.filter(({ ring }) => ring),
      { x: "x", y: "y", stroke: INK, strokeWidth: 1.5, r: 9, ...at },
    ),
    Plot.link(
      entries.filter(({ line }) => line),
      { x1: "x0", x2: "x1", y1: "y", y2: "y", stroke: (entry) => entry.line, strokeWidth: 3, ...at },
    ),
    Plot.text(entries, { x: "x", y: "y", text: "text", textAnchor: "start", dx: 20, ...at }),
  ];
}

const PREFIXES = [
  [1e3, "k"],
  [1, ""],
  [1e-3, "m"],
  [1e-6, "µ"],
  [1e-9, "n"],
  [1e-12, "p"],
];

/** A number with its unit, short: 1 mm, 20 µm, 5 km; square metres by powers of ten. */
export function length(value, unit = "m") {
  if (value === 0) return "0";
  if (unit !== "m") return `${value.toExponential(0).replace("e+0", "").replace("e+", "e")} ${unit}`;
  const [size, prefix] = PREFIXES.find(([limit]) => value >= limit * 0.9995) ?? PREFIXES[PREFIXES.length - 1];
  return `${Number((value / size).toPrecision(2))} ${prefix}m`;
}
