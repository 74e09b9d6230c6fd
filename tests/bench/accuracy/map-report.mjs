import { length, paretoChart } from "./chart.mjs";
import { FIT, FORWARD, GLOBE, measureMap, TOLERANCE } from "./map.mjs";
import { summarise } from "./summary.mjs";
import { digits, markdownTable } from "./table.mjs";

/** What placing a point on a map costs, by fit and by proj4js, per projection and size of node. */
export async function mapReport() {
  const rows = measureMap();
  const own = rows
    .filter(({ method }) => method !== GLOBE)
    .map((row) => ({ ...row, panel: `node of ${length(row.edge)}`, chosen: row.method === FIT }));
  return {
    title: "Placing on a map: error against time",
    text: describe(rows),
    svg: paretoChart({
      summaries: summarise(own),
      methods: [FIT, FORWARD],
      columns: 2,
      errors: [1e-8, 1e-1],
      tolerance: TOLERANCE,
      title: "Placing on a map: error against nanoseconds per point, by node size",
      time: "ns per point →",
      error: "↑ greatest error",
    }),
    table: markdownTable(
      own.map(({ map, edge, method, scheme = "–", ns, error, bound }) => ({
        map,
        node: length(edge),
        method: method === FIT ? `**${method}**` : method,
        scheme,
        "ns/point": digits(ns),
        "× the globe's": ratio(rows, { map, edge, ns }),
        "greatest error": length(error),
        "certified bound": bound === undefined ? "–" : length(bound),
      })),
    ),
    rows,
  };
}

function ratio(rows, { map, edge, ns }) {
  const globe = rows.find((row) => row.map === map && row.edge === edge && row.method === GLOBE);
  return (ns / globe.ns).toFixed(2);
}

function describe(rows) {
  const fits = rows.filter(({ method }) => method === FIT);
  const ratios = fits.map((row) => Number(ratio(rows, row)));
  const faster = fits.map(({ map, edge, ns }) => {
    const forward = rows.find((row) => row.map === map && row.edge === edge && row.method === FORWARD);
    return forward.ns / ns;
  });
  return (
    "Points of a scan in UTM zone 32 (EPSG:32632, 200 m high) on maps in five projections: Web Mercator, degrees, the equal-area one of " +
    "Europe, Gauss-Krüger with its datum shift, polar stereographic. The error is the distance from proj4js, which is how " +
    "OpenLayers places everything else on the map, of points as the page stores them (float32, nominal metres of the map in the node's " +
    "frame); of proj4js itself it is what float32 takes. " +
    `The fit is held to ${length(TOLERANCE)}; a map that cannot be zoomed in so far needs less.\n\n` +
    `Per point a map costs ${Math.min(...ratios).toFixed(2)} to ${Math.max(...ratios).toFixed(2)} × the globe (bar: 1.5), and is placed ` +
    `${Math.round(Math.min(...faster))} to ${Math.round(Math.max(...faster))} times faster than by proj4js point by point.`
  );
}
