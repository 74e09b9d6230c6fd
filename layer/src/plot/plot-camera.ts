import type { PlotView } from "../tools/plot/plot-view.js";
import type { FlatCamera } from "../webgl2/flat-camera.js";

/** Metres before the points and behind them. */
const MARGIN = 1;

/**
 * The camera that sees a plot: chainages to the right, heights up, and of points in one place the one nearest to the line.
 * It is in metres of chainage, heights are stretched on their way to it, so that sizes on the ground are those along the line.
 * @param reach greatest distance of a point from the line, metres
 */
export function plotCamera(view: PlotView, reach: number, pixelRatio: number): FlatCamera {
  const { shown, exaggeration } = view;
  const [along, up] = [(shown.from + shown.to) / 2, (shown.low + shown.high) / 2];
  // In steps, so that what was drawn before a point came that lies a little farther keeps its depth.
  const far = 2 ** Math.ceil(Math.log2(reach + 2 * MARGIN));
  return {
    width: Math.max(1, Math.round(view.width * pixelRatio)),
    height: Math.max(1, Math.round(view.height * pixelRatio)),
    pixelRatio,
    worlds: [0],
    projection: [
      ...[2 / (shown.to - shown.from), 0, 0, 0],
      ...[0, 2 / (exaggeration * (shown.high - shown.low)), 0, 0],
      ...[0, 0, -2 / far, 0],
      ...[0, 0, -1, 1],
    ],
    modelView: (origin) => [
      ...[1, 0, 0, 0],
      ...[0, exaggeration, 0, 0],
      ...[0, 0, 1, 0],
      ...[origin[0] - along, exaggeration * (origin[1] - up), -MARGIN, 1],
    ],
  };
}
