export type { Fault, FaultWire, GromaError, Vector } from "@groma/georef";
export type { ScreenPlace } from "../camera/index.js";
export { StyleError } from "../errors/index.js";
export type { DrawnKind } from "./globe-drawing.js";
export { Link, type LinkOptions, synchronize } from "./synchronize.js";
export type { Move, MoveOrigin, ViewMode } from "./view-link.js";
