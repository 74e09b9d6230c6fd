export type {
  AccuracyPart,
  Crs,
  DatumOperation,
  Fault,
  FaultWire,
  GromaError,
  HeightReference,
  LocalPlane,
  StatedAccuracy,
  Unit,
  Vector,
} from "@groma/georef";
export type { ClipMode, SourceSpace } from "../clips/index.js";
export {
  type BoxClip,
  Clip,
  type ClipPlace,
  ClipSet,
  type Corner,
  type PlaneClip,
  type PolygonClip,
} from "../clips/index.js";
export { MeasureError } from "../errors/index.js";
export type { VoxelKey } from "../octree/index.js";
export type {
  BoxRelation,
  PointBatch,
  PointBracket,
  PointOrigin,
  PointQuery,
  QueryOptions,
  QueryVolume,
  RecordQuery,
} from "../query/index.js";
export type { NumberType, PointAttribute } from "../sources/contract/point-attribute.js";
export type { LasEnvelope, LasVariableRecord } from "../sources/contract/point-source.js";
export type { RecordedNode, StoredAttribute } from "../workers/index.js";
export { type Alignment, inUnit } from "./alignment/alignment.js";
export { readDxfLine } from "./alignment/read-dxf.js";
export { readLandXml } from "./alignment/read-landxml.js";
export { type Station, type StationEquation, StationEquations } from "./alignment/station-equations.js";
export { BoxVolume } from "./area/box-volume.js";
export { ClippedVolume } from "./area/clipped-volume.js";
export { PolygonVolume } from "./area/polygon-volume.js";
export { SliceVolume } from "./area/slice-volume.js";
export {
  geodesicLengths,
  Profile,
  type ProfiledCloud,
  type ProfileOptions,
  type ProfilePoints,
} from "./cut/profile.js";
export type { MeasureToolOptions } from "./draw/given.js";
export type { MeasurementChange } from "./draw/history.js";
export { MeasureControl, type MeasureControlOptions } from "./draw/measure-control.js";
export { MeasureTool } from "./draw/measure-tool.js";
export { DRAWING_CLASS, type ScreenPoint, type ViewAdapter } from "./draw/view-adapter.js";
export type { MeasureWords } from "./draw/words.js";
export { type LineOnEllipsoid, lineOnEllipsoid } from "./ellipsoid/line-on-ellipsoid.js";
export {
  CorridorOnEllipsoid,
  CrossSectionsOnEllipsoid,
  type Geodetic,
  type InPlane,
  type OnEllipsoid,
  type SourceBounds,
} from "./ellipsoid/on-ellipsoid.js";
export * from "./measure/index.js";
export { PlotIndex, type PlottedPart, type PlottedPoint } from "./plot/plot-index.js";
export {
  areaBetween,
  areaToDatum,
  type Clearance,
  distanceInPlot,
  gradesOf,
  leastClearance,
  type PlotAreas,
  type PlotDistance,
  type PlotPlace,
} from "./plot/plot-measures.js";
export { type PlotAxes, type PlotExtent, PlotView } from "./plot/plot-view.js";
export {
  type SightClearance,
  type SightOptions,
  sightBetween,
  sightClearance,
  sightRise,
} from "./plot/sight.js";
export { Corridor, type LinePlace, type Stationing } from "./profile/corridor.js";
export { sourceLine } from "./profile/source-line.js";
export { type CrossSection, CrossSections, type SectionWidths } from "./sections/cross-sections.js";
export { type StationOptions, stations, stationText } from "./sections/station.js";
export {
  TerrainLine,
  type TerrainOptions,
  type TerrainStation,
  type TerrainStatistic,
  terrainStations,
} from "./terrain/terrain-line.js";
