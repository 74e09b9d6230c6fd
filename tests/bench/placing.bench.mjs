import { length } from "./accuracy/chart.mjs";
import { FORWARD, measurePlacing } from "./accuracy/placing.mjs";

/** Placing: ns per point of every scheme against proj4js, in one run; what `npm run bench:accuracy` draws. */
export async function bench() {
  const rows = measurePlacing();
  return rows.map(({ crs, edge, method, ns, error, bound, chosen }) => {
    const forward = rows.find((row) => row.crs === crs && row.edge === edge && row.method === FORWARD);
    return {
      crs,
      node: length(edge),
      method,
      "at 1 mm": chosen ? "default" : "",
      "ns/point": Number(ns.toFixed(1)),
      "× proj4": Number((forward.ns / ns).toPrecision(2)),
      error: length(error),
      bound: bound === undefined ? "" : length(bound),
    };
  });
}
