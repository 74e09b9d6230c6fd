export { type ByteSink, MemorySink } from "./byte-sink.js";
export { exportCsv } from "./csv.js";
export { type DxfOptions, exportDxf } from "./dxf.js";
export { exportGeoJson } from "./geojson.js";
export { exportLas, type LasOptions } from "./las.js";
export type { AlongLine, ExportOptions, ExportProgress, PointSelection } from "./selection.js";
