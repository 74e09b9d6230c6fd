export { OFFSET } from "../effects/index.js";
export type * from "../every-view.js";
export type * from "../tools/index.js";
export { type ProfiledLine, profileLedger } from "./plot-ledger.js";
export { PlotPicture } from "./plot-picture.js";
export { type PlotDrawing, PlotSeries } from "./plot-series.js";
