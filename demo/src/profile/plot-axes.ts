import type { PlotPlace, PlotView, TerrainStation } from "@groma/layer/tools";
import { axisBottom, axisLeft } from "d3-axis";
import { scaleLinear } from "d3-scale";
import { select } from "d3-selection";
import { sightIn } from "./measured-words.js";

/** Room for the axes, CSS pixels; `profile.css` leaves it around the canvas. */
const MARGIN = { left: 64, right: 12, top: 8, bottom: 36 } as const;

/** What is drawn over the points. */
export interface PlotOverlay {
  /** Words of the axes, with units. */
  readonly along: string;
  readonly up: string;
  /** The ground, with a band from the least to the greatest of its heights. */
  readonly ground: readonly TerrainStation[];
  readonly secondGround: readonly TerrainStation[];
  /** The line that is measured, and the words beside it. */
  readonly measured: readonly PlotPlace[];
  readonly measuredWords: string;
  /** The point that is pointed at, and where the keyboard's crosshair stands, pixels of the plot. */
  readonly hover: PlotPlace | undefined;
  readonly crosshair: readonly [x: number, y: number] | undefined;
}

/** Draws axes, grid, ground and marks over a plot. */
export function drawAxes(root: SVGSVGElement, view: PlotView, overlay: PlotOverlay): void {
  const { width, height, shown } = view;
  const x = scaleLinear([shown.from, shown.to], [0, width]);
  const y = scaleLinear([shown.low, shown.high], [height, 0]);
  const full = [width + MARGIN.left + MARGIN.right, height + MARGIN.top + MARGIN.bottom] as const;
  const svg = select(root).attr("viewBox", `0 0 ${full[0]} ${full[1]}`);
  svg.selectAll("*").remove();
  const plot = svg.append("g").attr("transform", `translate(${MARGIN.left},${MARGIN.top})`);
  const ticks = { x: Math.max(2, width / 90), y: Math.max(2, height / 32) };
  plot
    .append("path")
    .attr("class", "grid")
    .attr(
      "d",
      x
        .ticks(ticks.x)
        .map((at) => `M${x(at)},0V${height}`)
        .join("") +
        y
          .ticks(ticks.y)
          .map((at) => `M0,${y(at)}H${width}`)
          .join(""),
    );
  plot.append("g").attr("transform", `translate(0,${height})`).call(axisBottom(x).ticks(ticks.x));
  plot.append("g").call(axisLeft(y).ticks(ticks.y));
  const words = (text: string, left: number, down: number, anchor: string) =>
    plot.append("text").attr("x", left).attr("y", down).attr("text-anchor", anchor).text(text);
  words(overlay.along, width, height + 32, "end");
  words(overlay.up, -height / 2, -52, "middle").attr("transform", "rotate(-90)");
  const inner = plot.append("svg").attr("width", width).attr("height", height);
  drawGround(inner.node()!, view, overlay.secondGround, "second-ground");
  drawGround(inner.node()!, view, overlay.ground, "ground");
  const pixels = overlay.measured.map(([along, up]) => view.pixelOf(along, up));
  const sight = sightIn(overlay.measured).map(([along, up]) => view.pixelOf(along, up));
  inner.append("polyline").attr("class", "sight").attr("points", sight.map(String).join(" "));
  if (pixels.length > 0) {
    inner.append("polyline").attr("class", "measured").attr("points", pixels.map(String).join(" "));
    for (const [left, down] of pixels)
      inner.append("circle").attr("class", "measured").attr("cx", left).attr("cy", down).attr("r", 4);
    const [left, down] = pixels[pixels.length - 1]!;
    const side = left > width / 2 ? "end" : "start";
    inner
      .append("text")
      .attr("class", "measured-words")
      .attr("text-anchor", side)
      .attr("x", left + (side === "end" ? -8 : 8))
      .attr("y", Math.max(14, down - 8))
      .text(overlay.measuredWords);
  }
  if (overlay.hover) {
    const [left, down] = view.pixelOf(...overlay.hover);
    inner.append("circle").attr("class", "hover").attr("cx", left).attr("cy", down).attr("r", 5);
  }
  if (overlay.crosshair) {
    const [left, down] = overlay.crosshair;
    inner
      .append("path")
      .attr("class", "crosshair")
      .attr("d", `M${left - 9},${down}h18M${left},${down - 9}v18`);
  }
}

/** The ground as a line, and its band; both end at gaps. */
function drawGround(
  root: SVGSVGElement,
  view: PlotView,
  stations: readonly TerrainStation[],
  className: string,
): void {
  const { from, to } = view.shown;
  const inner = select(root);
  let run: TerrainStation[] = [];
  const close = () => {
    if (run.length > 1) {
      const at = (height: (station: TerrainStation) => number) =>
        run.map((station) => view.pixelOf(station.chainage, height(station)).map((one) => one.toFixed(1)));
      const band = [...at(({ greatest }) => greatest), ...at(({ least }) => least).toReversed()];
      inner.append("polygon").attr("class", "band").attr("points", band.join(" "));
      inner
        .append("polyline")
        .attr("class", className)
        .attr("points", at(({ height }) => height).join(" "));
    }
    run = [];
  };
  // Stations beyond the edges cost nothing; one on each side leads the line out of the plot.
  for (const [index, station] of stations.entries()) {
    const beside = [stations[index - 1], stations[index + 1]];
    const near = [station, ...beside].some((one) => one && one.chainage >= from && one.chainage <= to);
    if (station.count === 0) close();
    else if (near) run.push(station);
  }
  close();
}
