import { length, paretoChart } from "./chart.mjs";
import { CHORD, GEOGRAPHICLIB, HAVERSINE, measureGeodesic, POLYGON, UTM } from "./geodesic.mjs";
import { summarise } from "./summary.mjs";
import { markdownTable, span } from "./table.mjs";

/** What measuring on the ellipsoid costs, by method and size. */
export async function geodesicReport(root) {
  const rows = measureGeodesic(root);
  const summaries = summarise(rows);
  return {
    title: "Distance and area on the ellipsoid: error against time",
    text:
      "Distances: 500 lines of each length from anywhere up to 75° of latitude, and Karney's test set (3,000 lines of any " +
      "length, many nearly antipodal); the planar one is taken in the UTM zone where the line begins. Areas: polygons of 24 " +
      "vertices on the equator, in between, at the antimeridian and around the pole (not planar there), against the surface " +
      "summed from small triangles, which is itself good to about 1e-9 m times the perimeter; time is per vertex. " +
      "`geodesicPolygon` is the default: by chords and the bulge of the ground over them up to 20 km, GeographicLib beyond. Errors in metres and " +
      "square metres.",
    svg: paretoChart({
      summaries,
      methods: [GEOGRAPHICLIB, POLYGON, HAVERSINE, CHORD, UTM],
      columns: 4,
      errors: [1e-9, 1e8],
      title: "Distance and area: error against nanoseconds per line or vertex, by size",
      time: "ns per line or vertex →",
      error: "↑ greatest error, m or m²",
      unit: "",
    }),
    table: markdownTable(
      summaries.map((summary) => ({
        panel: summary.panel,
        method: summary.chosen ? `**${summary.method}**` : summary.method,
        "ns per line or vertex": span(summary),
        "greatest error": summary.panel.startsWith("area")
          ? `${summary.error.toPrecision(2)} m²`
          : length(summary.error),
      })),
    ),
    rows,
  };
}
