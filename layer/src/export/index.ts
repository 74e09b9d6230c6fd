export { type ByteSink, MemorySink } from "./byte-sink.js";
export { exportLas, type LasOptions } from "./las.js";
export type { AlongLine, ExportOptions, ExportProgress, PointSelection } from "./selection.js";
