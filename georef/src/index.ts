export { type Covariance, covariance } from "./cartesian/covariance.js";
export type { Domain } from "./cartesian/domain.js";
export { type Eigen, symmetricEigen } from "./cartesian/eigen.js";
export { splitFloat32 } from "./cartesian/float32.js";
export { type FittedPlane, fitPlane } from "./cartesian/plane.js";
export { quantise } from "./cartesian/quantise.js";
export { planarArea } from "./cartesian/shoelace.js";
export { type Slab, slab } from "./cartesian/slab.js";
export { cross, difference, dot, unit, type Vector } from "./cartesian/vectors.js";
export {
  type AreaOfUse,
  areaOf,
  areOverlapping,
  countriesIn,
  distanceTo,
  extentOf,
  isInside,
  type Place,
} from "./crs/area-of-use.js";
export type {
  Crs,
  CrsNote,
  CrsSources,
  DatumOperation,
  EpsgEntry,
  EpsgLookup,
  GeoTiffKeys,
  HeightReference,
  LasDeclaration,
  ResolvedCrs,
  Unit,
} from "./crs/crs.js";
export { epsgLookup, type PackedEpsg, packEpsg } from "./crs/epsg-table.js";
export { keepHeights, resolveCrs, resolveWithNotes } from "./crs/resolve.js";
export { isAboveOwnEllipsoid, isShifted, sameHeights, samePlane, sameSize } from "./crs/same.js";
export { publishedAccuracy } from "./crs/shift-worth.js";
export { doubtOfHeights } from "./crs/wkt-vertical.js";
export { type CurvatureRadii, curvatureRadii, radiusAlong } from "./ellipsoid/curvature.js";
export { ecefToGeodetic } from "./ellipsoid/ecef-to-geodetic.js";
export { type Ellipsoid, ellipsoid, WGS84 } from "./ellipsoid/ellipsoid.js";
export { eastNorthUp, type Frame, levelFrame, pointIn, pointOf, turnIn, turnOut } from "./ellipsoid/frame.js";
export { geodeticToEcef } from "./ellipsoid/geodetic-to-ecef.js";
export { ENGINE, type ExactTransform, exactTransform } from "./engines/exact.js";
export { type SourceTransform, sourceTransform } from "./engines/inverse-truth.js";
export { type LocalPlane, localPlane } from "./engines/local-plane.js";
export { isOwnPlane, planeTransform, truthOnMap } from "./engines/map-plane.js";
export type { MapPlane } from "./engines/on-map.js";
export { type GridPlane, gridPlane, type PlaneInverse } from "./engines/projection.js";
export { truthOf } from "./engines/settled-truth.js";
export {
  placePoint,
  pointTransform,
  recordedTruth,
  type Similarity,
  similarityTransform,
  type Truth,
  type TruthSources,
} from "./engines/truth.js";
export { truthOnWebMercator, WEB_MERCATOR_PLANE } from "./engines/web-mercator-plane.js";
export { boundsInWords, coordinate } from "./errors/coordinates.js";
export {
  ArgumentError,
  ControlError,
  CrsError,
  type Fault,
  type FaultWire,
  GromaError,
  PlacementError,
  RecordError,
} from "./errors/errors.js";
export { type Geodesic, type GeodesicEnd, geodesicBetween, geodesicFrom } from "./geodesic/geodesic.js";
export {
  type ChordPolygon,
  chordPolygon,
  type GeodesicPolygon,
  geodesicPolygon,
} from "./geodesic/polygon.js";
export { areaOfDomain, boundsOfPlaces, domainAround, spread, withWorthThere } from "./georeference/area.js";
export { aroundPoints } from "./georeference/around-points.js";
export { type DerivedOptions, deriveTransformation } from "./georeference/derive.js";
export { fitPlacement } from "./georeference/fit.js";
export { greatestBound } from "./georeference/greatest-bound.js";
export { place } from "./georeference/place.js";
export { placeIntegers } from "./georeference/place-integers.js";
export type { Placement, Scheme } from "./georeference/placement.js";
export { type Bounds, cutWindow, type Grid, type GridWindow } from "./grid/window.js";
export { printable } from "./printable.js";
export {
  type AccuracyPart,
  accuracyParts,
  EGM96_ACCURACY,
  EGM96_NOTE,
  type Placing,
  type StatedAccuracy,
  similarityParts,
  statedAccuracy,
} from "./record/accuracy.js";
export type { GeoreferenceRecord } from "./record/georeference-record.js";
export type { OperationReport } from "./record/operation-report.js";
export { decodeRecord, encodeRecord } from "./record/record.js";
export {
  type DataSetIdentity,
  decodeRecordFile,
  encodeRecordFile,
  RECORD_FILE_MOST,
  type RecordFile,
  requireSame,
} from "./record/record-file.js";
export { type Anchor, anchorSimilarity } from "./similarity/anchor.js";
export { type ControlPoint, type FittedSimilarity, fitSimilarity } from "./similarity/fit.js";
export { localCrs } from "./similarity/local-crs.js";
export { everyStep } from "./transformation/choice.js";
export { decodeTransformation } from "./transformation/decode.js";
export { encodeTransformation } from "./transformation/encode.js";
export {
  type CompiledTransformation,
  compileTransformation,
  type StepwiseTruth,
} from "./transformation/evaluate.js";
export { type GivenHeights, withHeights } from "./transformation/given-heights.js";
export type { PointTransform } from "./transformation/link.js";
export { fitPatchwork, PATCHWORK_TOLERANCE, type ProjectionSampler } from "./transformation/patchwork.js";
export { domainOf, type Rectangle } from "./transformation/rectangle.js";
export type {
  ChoiceStep,
  DatumShiftStep,
  EllipsoidAxes,
  GeocentricStep,
  HeightStep,
  HorizontalShiftStep,
  Patch,
  Patchwork,
  ProjectionStep,
  ShiftStep,
  Step,
  Transformation,
  VerticalShiftStep,
  Way,
} from "./transformation/step.js";
export { decodeEgm96, EGM96, egm96Grid, egm96Step, egm96Undulation, encodeEgm96 } from "./vertical/egm96.js";
export { guessHeight, type HeightGuess } from "./vertical/guess.js";
export { similarSystems } from "./vertical/spelling.js";
export {
  type EpsgRow,
  type HeightClues,
  likelySystems,
  type VerticalSystem,
  verticalLookup,
  verticalSystems,
} from "./vertical/systems.js";
export { type Undulation, undulationOf } from "./vertical/undulation.js";
export { isAboveGeoid, type OwnLevel, ownLevel, ownLevelNote } from "./vertical/zero-level.js";
