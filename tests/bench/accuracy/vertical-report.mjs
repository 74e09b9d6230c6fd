import { length, paretoChart } from "./chart.mjs";
import { summarise } from "./summary.mjs";
import { markdownTable, span } from "./table.mjs";
import { measureVertical, NONE, PACKAGE, WINDOW, WINDOW96 } from "./vertical.mjs";

/** What the height of the geoid costs, by where it is taken from. */
export async function verticalReport(root) {
  const rows = await measureVertical(root);
  const summaries = summarise(rows);
  return {
    title: "Heights above the geoid: error against time",
    text:
      "The undulation that makes an ellipsoidal height of a height above sea level, against PROJ with the grid of the height " +
      "system. The default is a window of that very grid, cut at conversion and interpolated as PROJ does. Where PROJ or " +
      "the grid is missing at conversion, EGM96 stands in: as a window cut from a grid, or from the npm package, whose " +
      "values are rounded to a centimetre. Its error in a country is that of another zero level and a coarser model. " +
      "Without a geoid the height is off by all of the undulation.",
    svg: paretoChart({
      summaries,
      methods: [WINDOW, WINDOW96, PACKAGE, NONE],
      columns: 2,
      errors: [1e-12, 1e3],
      tolerance: 0.001,
      title: "Geoid: error against nanoseconds per point, by place",
      time: "ns per point →",
      error: "↑ greatest error",
    }),
    table: markdownTable(
      summaries.map((summary) => {
        const { rms } = rows.find(
          ({ panel, method }) => panel === summary.panel && method === summary.method,
        );
        return {
          place: summary.panel,
          method: summary.chosen ? `**${summary.method}**` : summary.method,
          "ns/point": span(summary),
          "greatest error": length(summary.error),
          "root mean square": length(rms),
        };
      }),
    ),
    rows,
  };
}
