export type { CameraView } from "../../camera/index.js";
export { type Angle, measureAngle } from "./figures/angle.js";
export { type Area, measureArea } from "./figures/area.js";
export { type Circle, measureCircle } from "./figures/circle.js";
export { type Direction, type GridBearing, measureDirection } from "./figures/direction.js";
export { type Distance, type GridDistance, measureDistance, measureHeight } from "./figures/distance.js";
export { type BestPlane, measurePlane } from "./figures/plane.js";
export { measurePolyline, type Polyline } from "./figures/polyline.js";
export { type ReadOut, readOut } from "./figures/read-out.js";
export { type GroundOptions, measureHeightAboveGround } from "./ground/height-above-ground.js";
export {
  type AboveTerrainOptions,
  measureHeightAboveTerrain,
  type Terrain,
} from "./ground/height-above-terrain.js";
export {
  type KindOfMeasurement,
  MEASUREMENT_KINDS,
  type Measurement,
  type MeasurementKind,
  type NamedValue,
  valuesOf,
  wordsOf,
} from "./measurement/measurement.js";
export type { Note } from "./measurement/note.js";
export { type ReadValuesOptions, readsPoints, readValues } from "./measurement/read-values.js";
export { type Reading, type ReadingOptions, Readings } from "./measurement/reading.js";
export type { VolumeBaseSetting, VolumeSettings } from "./measurement/volume-settings.js";
export { valuesToCsv, verticesToCsv } from "./save/csv.js";
export type {
  MeasurementCollection,
  MeasurementFeature,
  SavedDataset,
  SavedValue,
  SavedVertex,
} from "./save/document.js";
export type { Geometry, Position } from "./save/geometry.js";
export { type ReadMeasurements, readMeasurements } from "./save/read.js";
export { type ReadableCloud, verifyRecords } from "./save/verify.js";
export { measurementsToGeoJson, type SaveOptions } from "./save/write.js";
export {
  MeasureUnits,
  type MeasureUnitsOptions,
  type Words,
  type WorthWords,
} from "./units/measure-units.js";
export type { AngleUnit, AreaUnit, LengthUnit, SlopeUnit, VolumeUnit } from "./units/tables.js";
export type { DatasetName } from "./vertex/dataset.js";
export {
  attached,
  ecefVertex,
  isSameRecord,
  type MeasuredCloud,
  placeVertex,
  type RecordedPoint,
  recordVertex,
  sourceVertex,
  type Vertex,
  type VertexRecord,
} from "./vertex/vertex.js";
export type { Progress, VolumeBase } from "./volume/base.js";
export { cutAndFill, type RingVolume } from "./volume/cut-and-fill.js";
export type { VolumeReply, VolumeWorker } from "./volume/in-worker.js";
export { measureVolume, type Volume } from "./volume/measure-volume.js";
export type { CutAndFill } from "./volume/prisms.js";
export type { Sensitivities, Sensitivity } from "./volume/sensitivity.js";
export type { VolumeJob, VolumeSums } from "./volume/volume-job.js";
export type { VolumeCloud, VolumeOptions } from "./volume/volume-options.js";
export type { Precision, WorthOptions } from "./worth/point-errors.js";
export type { Quantity, SiUnit, UncertaintyPart } from "./worth/quantity.js";
