import { length, paretoChart } from "./chart.mjs";
import { EXACT, FORWARD, measurePlacing, SCHEMES, TOLERANCE } from "./placing.mjs";
import { CREASED, EVALUATE, FALLBACK, measureWithGrids, RELIEF, REMAINDER } from "./placing-grids.mjs";
import { measureBorder, measureOperations } from "./placing-operations.mjs";
import { summarise } from "./summary.mjs";
import { digits, markdownTable, span } from "./table.mjs";

const GRIDS = {
  "EPSG:7415": "1 km, RD + NAP, against PROJ with grids",
  "EPSG:2056+5728": "1 km, LV95 + LN02, against PROJ with grids",
};

/** What placing a point costs, by scheme, engine and size of node. */
export async function placingReport(root) {
  const plain = measurePlacing().map((row) => ({ panel: `node of ${length(row.edge)}`, ...row }));
  const grids = (await measureWithGrids(root)).map((row) => ({ panel: GRIDS[row.crs], ...row }));
  const named = (panel) => (row) => ({ panel, ...row });
  const operations = (await measureOperations()).map(named("1 km, projections of PROJ alone"));
  const border = (await measureBorder()).map(named("1 km, where two operations meet"));
  const rows = [...plain, ...grids, ...operations, ...border];
  const summaries = summarise(rows);
  return {
    title: "Placing: error against time",
    text: describe(plain, grids, operations, border),
    svg: paretoChart({
      summaries,
      methods: [
        ...SCHEMES,
        EXACT,
        FORWARD,
        ...(grids.length > 0 ? [FALLBACK, EVALUATE, CREASED, RELIEF, REMAINDER] : []),
      ],
      columns: 3,
      errors: [1e-8, 1e3],
      tolerance: TOLERANCE,
      title: "Placing: error against nanoseconds per point, by node size",
      time: "ns per point →",
      error: "↑ greatest error",
    }),
    table: markdownTable(summaries.map((summary) => tableRow(summary, rows))),
    rows,
  };
}

function tableRow(summary, rows) {
  const own = rows.filter(({ panel, method }) => panel === summary.panel && method === summary.method);
  const greatest = (name) => {
    const values = own.map((row) => row[name]).filter((value) => value !== undefined);
    return values.length > 0 ? length(Math.max(...values)) : "–";
  };
  return {
    node: summary.panel.replace("node of ", ""),
    method: summary.chosen ? `**${summary.method}**` : summary.method,
    "ns/point": span(summary),
    "greatest error": length(summary.error),
    "of which fit": greatest("fitError"),
    "certified bound": greatest("bound"),
  };
}

/** The bars: the default for nodes of 1 km at 1 mm. */
function describe(rows, grids, operations, border) {
  const kilometre = rows.filter(({ edge }) => edge === 1000);
  const bars = kilometre
    .filter(({ chosen }) => chosen)
    .map(({ crs, method, ns }) => {
      const forward = kilometre.find((row) => row.crs === crs && row.method === FORWARD);
      const ratio = `${Math.round(forward.ns / ns)} × faster than \`proj4.forward\` (${digits(forward.ns)} ns)`;
      return `${crs} ${method} ${digits(ns)} ns, ${ratio}`;
    });
  return (
    `Each point is a way to place a scan: its time per point, and the greatest error of points as the page stores them ` +
    "(float32 metres in the node's frame) against the exact transform, over five CRSs (UTM, Swiss, Dutch, Oregon in feet, " +
    "Web Mercator); the thin line spans the CRSs. The default is the cheapest scheme whose certified bound is below " +
    `${length(TOLERANCE)}; where float32 alone reaches that (nodes of 100 km, which a page draws only from far away), ` +
    "the one whose fit is. `exact` is proj4js's inverse projection, improved by one step, with this project's own ECEF; " +
    "`proj4.forward` goes to longitude and latitude, then to ECEF. In the last panels the truth is PROJ with the grids of " +
    "RD New and NAP, LV95 and LN02: `transformation` is PROJ's steps one by one with windows of its grids; the default is a fit of those, " +
    `${shares(grids)}.\n\n` +
    `Nodes of 1 km at 1 mm: ${bars.join("; ")}. Forty times faster than Web Mercator's \`forward\`, ` +
    "two functions of one variable, would be as fast as the affine scheme, which is off by centimetres there." +
    ofOperations(operations, border)
  );
}

/** Nodes of operations that are carried as patchworks; nothing where PROJ is not there. */
function ofOperations(operations, border) {
  const fitted = operations.filter(({ chosen }) => chosen);
  if (fitted.length === 0) return "";
  const told = fitted.map(
    ({ crs, what, method, ns, error }) =>
      `${crs} (${what}) ${method} ${digits(ns)} ns, ${length(error)} from PROJ`,
  );
  const meeting = border.find(({ chosen }) => chosen);
  return (
    `\n\nOperations of PROJ whose projection the page has no closed form for are carried as certified patchworks, and nodes of 1 km ` +
    `cost what others do: ${told.join("; ")}. A node in which two operations meet goes point by point (\`${meeting.method}\`): ` +
    `${digits(meeting.ns)} ns.`
  );
}

/** How many nodes are fitted in which way. */
function shares(grids) {
  const kinds = grids.filter(({ nodes }) => nodes > 0);
  const all = (crs) => kinds.reduce((sum, kind) => sum + (kind.crs === crs ? kind.nodes : 0), 0);
  const share = ({ crs, method, nodes, ns }) =>
    `\`${method}\` in ${nodes} of ${all(crs)} nodes of ${crs} at ${digits(ns)} ns`;
  return kinds.map(share).join(", ");
}
