import { paretoChart } from "./chart.mjs";
import {
  GEODESIC,
  GRID,
  LOWEST,
  measureFigures,
  measureVolumes,
  PLANAR,
  PRISMS,
  RASTER,
  SPHERE,
  WHOLE,
} from "./measuring.mjs";
import { summarise } from "./summary.mjs";
import { markdownTable, span } from "./table.mjs";

/** What measured values cost, by method, latitude and density. */
export async function measuringReport() {
  const rows = [...measureFigures(), ...measureVolumes()];
  const summaries = summarise(rows);
  return {
    title: "Measured values: error against time",
    text:
      "Relative errors. Distances: 60 lines of 10 m, 1 km and 100 km at each latitude in a zone of UTM, against the length " +
      "on the ellipsoid of WGS 84; areas: hexagons as wide, against the surface summed from small triangles. " +
      "`measureDistance` and `measureArea` are the defaults: their time is that of all distances or areas and of the perimeter, each " +
      "with its uncertainty; the error is that of the geodesic one. The grid is not wrong, it is another value: its scale " +
      "factor is up to 1e-3 from 1 here. Volumes: a cone, half a ball and a bell of 10 m by points on a shaken grid; rasters have cells of two " +
      "spacings. Time is per value, and per point for volumes.",
    svg: paretoChart({
      summaries,
      methods: [WHOLE, GEODESIC, SPHERE, PLANAR, GRID, PRISMS, RASTER, LOWEST],
      columns: 4,
      errors: [1e-14, 1],
      title: "Measured values: relative error against nanoseconds, by latitude and density",
      time: "ns per value or point →",
      error: "↑ greatest relative error",
      unit: "",
    }),
    table: markdownTable(
      summaries.map((summary) => ({
        panel: summary.panel,
        method: summary.chosen ? `**${summary.method}**` : summary.method,
        "ns per value or point": span(summary),
        "greatest relative error": summary.error.toExponential(1),
      })),
    ),
    rows,
  };
}
