import type { Crs } from "../crs/crs.js";
import { WGS84 } from "../ellipsoid/ellipsoid.js";
import { requireFields, requireKind } from "../errors/arguments.js";
import { EGM96 } from "../vertical/egm96.js";
import { ownLevel, ownLevelNote } from "../vertical/zero-level.js";
import type { OperationReport } from "./operation-report.js";

/** One named part of what a stated position is worth. */
export interface AccuracyPart {
  readonly name: string;
  /** Metres; `null` when it is not known. */
  readonly metres: number | null;
  readonly note?: string;
}

/** The parts and their sum; the sum is `null` as soon as one part is not known, and where there is none. */
export interface StatedAccuracy {
  readonly total: number | null;
  readonly parts: readonly AccuracyPart[];
}

/**
 * Sums the parts linearly: they are bounds and stated accuracies, not independent deviations.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function statedAccuracy(parts: readonly AccuracyPart[]): StatedAccuracy {
  requireKind(parts, "list", "statedAccuracy: parts");
  let total: number | null = parts.length === 0 ? null : 0;
  for (const { metres } of parts) total = total === null || metres === null ? null : total + metres;
  return { total, parts };
}

/** How an engine places a data set, as far as its accuracy depends on it. */
export interface Placing {
  readonly operation: Pick<OperationReport, "name" | "accuracy" | "ballpark">;
  /** Grids that heights go through, by their files; {@link EGM96} for the geoid that stands for a missing one. */
  readonly geoids: readonly string[];
  /** For heights of unknown reference or a level of their own: what they may be, and how far off the points then are. */
  readonly guess?: string | undefined;
  /** The height system of a data set that lies outside of its area of use: nobody states what it is worth there. */
  readonly outsideOf?: string | undefined;
}

/**
 * What heights by EGM96 are worth in a country's height system, metres. The zero levels of countries follow tide gauges
 * and lie up to 2.3 m from the global geoid (Ostend); EGM96 itself, with a node every 28 km, is off by decimetres, in
 * mountains by metres (2.8 m in the Alps, against the geoid of Switzerland).
 */
export const EGM96_ACCURACY = 4;

/** Said of heights by EGM96 in a country's height system. */
export const EGM96_NOTE =
  `height by the geoid model ${EGM96} instead of the country's own: expect errors of some decimetres, up to about ` +
  `${EGM96_ACCURACY} m in mountains`;

/** Heights above EGM96 itself (EPSG:5773) lose the rounding of its nodes to a centimetre alone, metres (5.3 mm met). */
const EGM96_ROUNDING = 0.006;
const EGM96_HEIGHT = 5773;

/**
 * The parts of a data set's accuracy that follow from its CRS, the LAS scale factors and its placement: quantisation,
 * fit, datum operation, height.
 *
 * @param scale LAS scale factors, 3 values, source units
 * @param fitBound certified bound of the placement, metres (the tolerance, while no node is placed yet)
 * @param placing the engine's operation; without one, that which `crs.proj4` stands for, heights as they are
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function accuracyParts(
  crs: Pick<Crs, "horizontalUnit" | "verticalUnit" | "height" | "datum">,
  scale: ArrayLike<number>,
  fitBound: number,
  placing?: Placing,
): AccuracyPart[] {
  requireFields(
    crs,
    { horizontalUnit: "object", verticalUnit: "object", height: "object" },
    "accuracyParts: crs",
  );
  return [
    ...storageParts(crs, scale, fitBound),
    placing ? operationPart(placing.operation) : datumPart(crs.datum),
    heightPart(crs, placing),
  ];
}

/**
 * The parts of a data set that a similarity puts on the globe.
 *
 * @param control residuals of its control points, metres; without them it stands where its anchor was given
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function similarityParts(
  crs: Pick<Crs, "horizontalUnit" | "verticalUnit">,
  scale: ArrayLike<number>,
  fitBound: number,
  control?: { readonly residuals: readonly number[]; readonly rms: number; readonly max: number },
): AccuracyPart[] {
  requireFields(crs, { horizontalUnit: "object", verticalUnit: "object" }, "similarityParts: crs");
  const parts = storageParts(crs, scale, fitBound);
  if (!control)
    return [...parts, { name: "anchor", metres: null, note: "as good as the place that was given" }];
  const { residuals, rms, max } = control;
  const note = `greatest of ${residuals.length} residuals, their RMS is ${Number(rms.toPrecision(3))} m`;
  return [...parts, { name: "control points", metres: max, note }];
}

function storageParts(
  crs: Pick<Crs, "horizontalUnit" | "verticalUnit">,
  scale: ArrayLike<number>,
  fitBound: number,
): AccuracyPart[] {
  return [
    { name: "quantisation", metres: quantisation(crs, scale), note: "half a step of the stored integers" },
    { name: "fit", metres: fitBound, note: "certified, rounding to float32 included" },
  ];
}

/** Half a step per axis, taken together; degrees count as their length along the equator. */
function quantisation(
  { horizontalUnit, verticalUnit }: Pick<Crs, "horizontalUnit" | "verticalUnit">,
  scale: ArrayLike<number>,
): number {
  const metres = horizontalUnit.size * (horizontalUnit.kind === "angular" ? WGS84.a : 1);
  return Math.hypot(scale[0] * metres, scale[1] * metres, scale[2] * verticalUnit.size) / 2;
}

function datumPart(datum: Crs["datum"]): AccuracyPart {
  if (!datum) return { name: "datum operation", metres: null, note: "not stated" };
  return { name: "datum operation", metres: datum.accuracy, note: datum.operation };
}

function operationPart({ name, accuracy, ballpark }: Placing["operation"]): AccuracyPart {
  const note = ballpark ? `${name}; a difference of datums is passed over` : name;
  return { name: "datum operation", metres: ballpark ? null : accuracy, note };
}

function heightPart(
  { height, verticalUnit }: Pick<Crs, "height" | "verticalUnit">,
  placing: Placing | undefined,
): AccuracyPart {
  const name = "height";
  if (height.kind !== "unknown" && height.doubt !== undefined)
    return { name, metres: null, note: height.doubt };
  if (height.kind === "ellipsoidal") return { name, metres: 0, note: "ellipsoidal" };
  if (height.kind === "unknown") {
    return { name, metres: null, note: placing?.guess ?? "reference unknown, drawn as ellipsoidal" };
  }
  const level = ownLevel({ height, verticalUnit });
  if (level && !placing?.geoids.length) {
    return { name, metres: null, note: placing?.guess ?? ownLevelNote({ height }, level) };
  }
  if (!placing) return { name, metres: null, note: `${height.model}: drawn without its geoid` };
  if (placing.outsideOf !== undefined) {
    return { name, metres: null, note: `${height.model}: not in use at this place` };
  }
  if (placing.geoids.includes(EGM96) && height.epsg === EGM96_HEIGHT) {
    return { name, metres: EGM96_ROUNDING, note: `${height.model}: nodes rounded to a centimetre` };
  }
  if (placing.geoids.includes(EGM96)) {
    return { name, metres: EGM96_ACCURACY, note: `${height.model}: by ${EGM96} in place of its own geoid` };
  }
  const by = placing.geoids.length > 0 ? ` by ${placing.geoids.join(", ")}` : "";
  return { name, metres: 0, note: `${height.model}${by}: its accuracy is part of the datum operation's` };
}
