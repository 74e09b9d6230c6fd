import * as Plot from "@observablehq/plot";
import { parseHTML } from "linkedom";
import { COLOURS, FRONT, INK, length, SYMBOLS } from "./chart.mjs";
import { points } from "./rendering-figures.mjs";
import { paretoFront } from "./summary.mjs";

const WIDTH = 400;
const HEIGHT = 320;
const COLUMNS = 2;
const RMS = "↑ RMS difference to full density, steps of 255";

/**
 * Error against cost of effects and of the storage of vertices, panels with axes of their own.
 *
 * @param {object} rows by part, as in the report's raw numbers
 * @param {number} tolerance metres
 * @returns {string} SVG
 */
export function renderingChart({ effects, storage }, tolerance, title) {
  const fills = effects.filter((row) => row.fills);
  const looks = effects.filter((row) => !row.fills && row.offPoints > 0);
  const names = [...fills, ...looks].map(({ effect }) => effect);
  const panels = [
    fillPanel(fills, names),
    lookPanel(looks, names),
    legend(names),
    storagePanel(storage, tolerance),
  ];
  return sheet(panels, title);
}

/**
 * Error against time of point budgets and screen-space errors.
 *
 * @param {object} rows by part, as in the report's raw numbers
 * @returns {string} SVG
 */
export function detailChart({ budget, spacing }, title) {
  const panels = [
    sweepPanel("Point budget", budget, ({ budget }) => (budget === "none" ? "none" : points(budget))),
    sweepPanel("Screen-space error", spacing, ({ pixels }) => `${pixels} px`),
  ];
  return sheet(panels, title);
}

/** Panels beside and below each other. */
function sheet(panels, title) {
  const columns = Math.min(COLUMNS, panels.length);
  const rows = Math.ceil(panels.length / columns);
  const placed = panels.map((panel, i) => {
    panel.setAttribute("x", String(WIDTH * (i % columns)));
    panel.setAttribute("y", String(HEIGHT * Math.floor(i / columns)));
    return panel.outerHTML;
  });
  const size = `width="${WIDTH * columns}" height="${HEIGHT * rows}"`;
  const box = `viewBox="0 0 ${WIDTH * columns} ${HEIGHT * rows}"`;
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" ${size} ${box} role="img" aria-label="${title}">` +
    `<rect width="100%" height="100%" fill="white"/>${placed.join("")}</svg>\n`
  );
}

/** What fills the gaps between points: an arrow from the picture without to the one with it. */
function fillPanel(rows, names) {
  const times = [1, ...rows.map(({ ratio }) => ratio)];
  return plot("Filling effects: off → on", {
    x: ratioAxis("frame time, on : off →", times),
    y: { label: RMS, grid: true, zero: true },
    marks: [
      Plot.ruleX([1], { stroke: FRONT }),
      Plot.arrow(rows, { x1: 1, x2: "ratio", y1: "offRms", y2: "onRms", stroke: FRONT, insetEnd: 5 }),
      dots(rows, "ratio", "onRms", names),
    ],
  });
}

/** What shows something else: how much of the picture it changes. */
function lookPanel(rows, names) {
  return plot("Other effects: what they change", {
    x: ratioAxis("frame time, on : off →", [1, ...rows.map(({ ratio }) => ratio)]),
    y: { label: "↑ pixels that change", grid: true, domain: [0, 1], tickFormat: "%" },
    marks: [Plot.ruleX([1], { stroke: FRONT }), dots(rows, "ratio", "changedPixels", names)],
  });
}

/** Budgets or screen-space errors, a series per look; the front is that of both looks. */
function sweepPanel(heading, rows, name) {
  const front = paretoFront(rows.map((row) => ({ ...row, ns: row.time, error: row.onRms })));
  const looks = [...new Set(rows.map(({ look }) => look))];
  return plot(heading, {
    x: ratioAxis(
      "frame time, default = 1 →",
      rows.map(({ time }) => time),
    ),
    y: { label: RMS, grid: true, zero: true },
    marks: [
      Plot.line(front, { x: "ns", y: "error", stroke: FRONT, strokeWidth: 5, strokeOpacity: 0.5 }),
      Plot.line(rows, { x: "time", y: "onRms", z: "look", stroke: ({ look }) => colour(look, looks) }),
      Plot.dot(rows, { x: "time", y: "onRms", fill: ({ look }) => colour(look, looks), r: 4 }),
      ring(rows, "time", "onRms"),
      Plot.text(
        rows.filter(({ look }) => look === looks[0]),
        { x: "time", y: "onRms", text: name, dy: -12, fontSize: 10 },
      ),
      ...looks.map((look, i) =>
        Plot.text([look], {
          ...{ text: [look], fill: colour(look, looks), frameAnchor: "top-right" },
          ...{ dx: -6, dy: 8 + 14 * i },
        }),
      ),
    ],
  });
}

function storagePanel(rows, tolerance) {
  const levels = [...new Set(rows.map(({ level }) => level))];
  const worst = new Map();
  for (const row of rows) worst.set(row.bytes, Math.max(worst.get(row.bytes) ?? 0, row.worst));
  const named = [...new Map(rows.map((row) => [row.storage, row])).values()];
  const front = [...worst].map(([bytes, error]) => ({ bytes, error })).sort((a, b) => a.bytes - b.bytes);
  const errors = [Math.min(...rows.map((row) => row.worst)) / 2, 5 * Math.max(...worst.values())];
  return plot("Vertex storage, nodes by level", {
    x: { label: "bytes per vertex →", domain: [4, 14], ticks: [6, 8, 12], grid: true, tickFormat: String },
    y: {
      type: "log",
      domain: errors,
      label: "↑ greatest error",
      grid: true,
      tickFormat: (value) => length(value),
      ticks: 6,
    },
    color: { type: "linear", domain: [0, Math.max(...levels)], range: ["#0b3954", "#8ec5ee"] },
    marks: [
      Plot.ruleY([tolerance], { stroke: "#c0392b", strokeDasharray: "4 3" }),
      Plot.text([tolerance], {
        ...{ y: (value) => value, x: () => 13.9, text: (value) => `tolerance ${length(value)}` },
        ...{ fill: "#c0392b", textAnchor: "end", dy: -7 },
      }),
      Plot.line(front, { x: "bytes", y: "error", stroke: FRONT, strokeWidth: 5, strokeOpacity: 0.5 }),
      Plot.dot(rows, { x: "bytes", y: "worst", fill: "level", r: 3 }),
      Plot.dot(
        front.filter(({ bytes }) => named.some((one) => one.chosen && one.bytes === bytes)),
        { x: "bytes", y: "error", stroke: INK, strokeWidth: 1.5, r: 9 },
      ),
      Plot.text(named, {
        ...{ x: "bytes", y: ({ bytes }) => worst.get(bytes), text: "storage", dy: -16 },
      }),
    ],
  });
}

function legend(names) {
  const entries = [...names.map((method) => ({ text: method, method })), { text: "default", ring: true }];
  const at = (_, i) => i;
  return plot("", {
    x: { axis: null, domain: [0, 1] },
    y: { axis: null, domain: [entries.length, -1] },
    marks: [
      Plot.dot(entries.slice(0, -1), {
        ...{ x: () => 0.05, y: at, r: 4 },
        ...{ fill: ({ method }) => colour(method, names), stroke: ({ method }) => colour(method, names) },
        symbol: ({ method }) => symbol(method, names),
      }),
      Plot.dot(entries.slice(-1), {
        x: () => 0.05,
        y: () => names.length,
        stroke: INK,
        strokeWidth: 1.5,
        r: 9,
      }),
      Plot.text(entries, { x: () => 0.12, y: at, text: "text", textAnchor: "start" }),
    ],
  });
}

function dots(rows, x, y, names) {
  return Plot.dot(rows, {
    ...{
      x,
      y,
      r: 5,
      fill: ({ effect }) => colour(effect, names),
      stroke: ({ effect }) => colour(effect, names),
    },
    symbol: ({ effect }) => symbol(effect, names),
  });
}

/** Around the defaults. */
function ring(rows, x, y) {
  const chosen = rows.filter(({ chosen }) => chosen);
  return Plot.dot(chosen, { x, y, stroke: INK, strokeWidth: 1.5, r: 9 });
}

const colour = (name, names) => COLOURS[names.indexOf(name) % COLOURS.length];

/** Where colours come again, they do with other symbols. */
function symbol(name, names) {
  const at = names.indexOf(name);
  return SYMBOLS[(at + Math.floor(at / SYMBOLS.length)) % SYMBOLS.length];
}

/** A logarithmic axis with some room at both ends, and ticks at powers of two. */
function ratioAxis(label, values) {
  const domain = [Math.min(...values) / 1.3, Math.max(...values) * 1.3];
  const ticks = [1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8].filter((at) => at > domain[0] && at < domain[1]);
  return { type: "log", grid: true, label, domain, ticks, tickFormat: (value) => `× ${value}` };
}

function plot(heading, options) {
  const { document } = parseHTML("<html><body></body></html>");
  return Plot.plot({
    ...{ document, width: WIDTH, height: HEIGHT, marginLeft: 60, marginBottom: 45, marginTop: 50 },
    style: { fontFamily: "sans-serif", fontSize: "12px", background: "white", color: INK },
    ...options,
    marks: [
      heading ? Plot.frame({ stroke: "#d5dae0" }) : null,
      Plot.text([heading], { frameAnchor: "top", dy: -20, fontWeight: "bold", text: [heading] }),
      ...options.marks,
    ],
  });
}
