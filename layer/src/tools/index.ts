export type {
  AccuracyPart,
  Crs,
  DatumOperation,
  Fault,
  FaultWire,
  GromaError,
  HeightReference,
  StatedAccuracy,
  Unit,
  Vector,
} from "@groma/georef";
export { MeasureError } from "../errors/index.js";
export * from "./measure/index.js";
