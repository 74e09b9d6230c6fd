import * as Plot from "@observablehq/plot";
import { parseHTML } from "linkedom";
import { COLOURS, INK, length } from "./chart.mjs";
import { measureChainage, measurePicture } from "./profile.mjs";
import { markdownTable } from "./table.mjs";

/** What a thinner picture of a profile costs in truth, and grid chainage in length. */
export async function profileReport(root) {
  const picture = await measurePicture(root);
  if (picture.length === 0) return undefined;
  const chainage = measureChainage();
  const { document } = parseHTML("<html><body></body></html>");
  const svg = Plot.plot({
    document,
    width: 720,
    height: 400,
    marginLeft: 70,
    marginTop: 45,
    style: { fontFamily: "sans-serif", fontSize: "12px", background: "white", color: INK },
    x: { type: "log", label: "points read →", grid: true, tickFormat: "~s", ticks: 5 },
    y: {
      type: "log",
      label: "↑ ground against that of all points, RMS, units of the scan",
      grid: true,
      domain: [0.5, 8],
      tickFormat: "~g",
    },
    color: { domain: [...new Set(picture.map(({ scan }) => scan))], range: COLOURS, legend: false },
    marks: [
      Plot.lineY(
        picture.filter(({ rms }) => rms > 0),
        { x: "read", y: "rms", stroke: "scan", marker: "circle" },
      ),
      Plot.text(
        picture.filter(({ rms }) => rms > 0),
        Plot.selectFirst({
          x: "read",
          y: "rms",
          z: "scan",
          text: "scan",
          fill: "scan",
          dy: -12,
          textAnchor: "start",
        }),
      ),
    ],
  });
  svg.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  const pictures = markdownTable(
    picture.map(({ scan, spacing, read, shown, share, time, ms, bytes, rms, missing }) => ({
      scan,
      spacing: spacing === 0 ? "every point" : String(spacing),
      "points read": read.toLocaleString("en"),
      "in the picture": `${shown.toLocaleString("en")} (${percent(share)})`,
      MB: (bytes / 1e6).toPrecision(2),
      "processor, ms": `${Math.round(ms)} (${percent(time)})`,
      "ground, RMS": rms.toPrecision(2),
      "stations without a point": percent(missing),
    })),
  );
  const chainages = markdownTable(
    chainage.map(({ line, length: metres, grid }) => ({
      line,
      length: length(metres),
      "grid − geodesic": `${grid < 0 ? "−" : ""}${length(Math.abs(grid))}`,
      ppm: ((1e6 * grid) / metres).toFixed(0),
    })),
  );
  return {
    title: "Profiles: completeness against time, grid against geodesic chainage",
    text:
      "A profile is read level by level. Until its last level is read, the picture lacks points: what that does to the ground " +
      "(median of the heights of each station, every metre in vol_total, every 5 ft in autzen) is its RMS difference from that of all points, " +
      "in units of the scan (metres; feet), over the stations that have a point at all. The last row of each scan is the complete profile. " +
      "Shares of the time are of what every point took, asked for without a spacing; they are good to about a tenth.",
    svg: svg.outerHTML,
    table: `${pictures}\n\nChainage in the plane of UTM against the geodesic of WGS 84, for lines to the north-east at 47° of latitude:\n\n${chainages}`,
    how: "Times are the least of five rounds in which all levels were read in turn, from a file of this machine: their shares hold on others. Bytes are the share of the file's that its points have.",
    rows: [...picture, ...chainage],
  };
}

/** A share in per cent, two digits where it is small. */
function percent(share) {
  return `${100 * share < 10 ? Number((100 * share).toPrecision(2)) : Math.round(100 * share)} %`;
}
