export { OFFSET } from "../effects/index.js";
export type { LazTask, RecordLayout } from "../laz/index.js";
export type { PaintOptions } from "./along.js";
export { type ArchiveEntry, writeArchive } from "./archive.js";
export { BlobStore, type BlockStore } from "./block-store.js";
export { type ByteSink, MemorySink } from "./byte-sink.js";
export { collectParts } from "./collect.js";
export type { PointCompressor } from "./compressor/laz-worker.js";
export { exportCsv } from "./csv.js";
export { type CutFacts, cutFacts, type LengthUnit } from "./cut-facts.js";
export { type DatedOptions, exportLandXml, exportPicture, type PictureFileOptions } from "./documents.js";
export { type DxfOptions, exportDxf } from "./dxf.js";
export { exportGeoJson } from "./geojson.js";
export type { DocumentOptions, GroundOptions } from "./ground.js";
export type { KnownPoints } from "./known.js";
export type { GroundRuns, LandXmlSection } from "./landxml.js";
export { exportLas, type LasOptions } from "./las.js";
export { exportLaz, type LazOptions } from "./laz.js";
export { type Narrowing, narrowed } from "./narrowed.js";
export { type PaintChoices, type PaintedSource, paintBy } from "./paint-by.js";
export type { PictureScale } from "./picture/profile-picture.js";
export { type ExportedPoints, exportPoints, type PointExportOptions, type PointFormat } from "./points.js";
export {
  exportSectionLandXml,
  exportSectionSheets,
  exportSections,
  type SectionArchiveOptions,
  type SectionFormat,
  type SectionOptions,
  type SectionPlace,
  type SectionSelection,
  type SectionSet,
} from "./sections.js";
export type {
  AlongLine,
  ExportOptions,
  ExportProgress,
  PartedSelection,
  PartedVolume,
  PointSelection,
} from "./selection.js";
