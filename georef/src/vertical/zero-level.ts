import type { Crs } from "../crs/crs.js";

/** A zero level that is not the sea's. */
export interface OwnLevel {
  /** Metres from mean sea level, at most; `null` where nobody knows. */
  readonly offset: number | null;
}

/** Tides rise and fall by no more than this about mean sea level, metres (Bay of Fundy: 8.5 m at spring tide). */
const TIDES = 9;

/**
 * Height systems of EPSG whose zero is not near mean sea level, and how far from it that is, metres: by EPSG's own offsets
 * (9371 Vienna, 5438 Caspian, 5443 AIOC95, 7980 KOC, 7654 Kiunga, 7964 Poolbeg) or the tides.
 */
const OFFSETS: ReadonlyMap<number, number> = new Map([
  ...[[8881, 157] as const, [5611, 28] as const, [5797, 26.3] as const],
  ...[5788, 5790, 7979].map((kuwait) => [kuwait, 6] as const),
  ...[[7652, 3] as const, [5754, 2.7] as const, [7962, 2.7] as const],
  ...[5829, 5868, 5869, 5870, 5871, 5872, 5874].map((water) => [water, TIDES] as const),
  // Depths: the Caspian's, and those below the zero of a height system, that is mean sea level.
  ...[[5706, 28] as const, [5734, 29.7] as const],
  ...[5336, 5612, 5715, 6357, 6358, 6359, 7976, 8051, 8053, 8358].map((sea) => [sea, 0.5] as const),
  ...[5861, 5862, 5863, 5864, 5865, 5866, 5867, 5873, 9287, 9672, 10151].map((low) => [low, TIDES] as const),
]);

/**
 * Words of a system without a code whose zero is a place's own, or the water's; those of OFFSETS are among them, since ESRI's
 * WKT has no codes.
 */
const OWN_WORDS =
  /\b(local|site|plant|project|construction|assumed|arbitrary|relative|depths?|chart|soundings?|tid(?:al|e)|(?:low|high) water|water levels?|lat|hat|mllw|mlw|mhw|mhhw|vienna|wiener|caspian|aioc ?95|koc|kuwait pwd|kiunga|poolbeg)\b/i;

/**
 * Whether heights count from a level of their own: that of Vienna, of the Caspian Sea, of a chart or a site, or downwards.
 * The geoid says nothing of those, so no model of it is applied to them.
 *
 * @returns undefined for heights above a geoid, above the ellipsoid, and for unknown ones
 */
export function ownLevel({
  height,
  verticalUnit,
}: Pick<Crs, "height" | "verticalUnit">): OwnLevel | undefined {
  if (height.kind !== "geoid") return undefined;
  const offset = height.epsg === undefined ? undefined : OFFSETS.get(height.epsg);
  if (offset !== undefined) return { offset };
  const own =
    verticalUnit.size < 0 || (height.epsg === undefined && OWN_WORDS.test(height.model.replaceAll("_", " ")));
  return own ? { offset: null } : undefined;
}

/** Whether a model of the geoid makes ellipsoidal heights of those of a CRS. */
export function isAboveGeoid(crs: Pick<Crs, "height" | "verticalUnit">): boolean {
  return crs.height.kind === "geoid" && ownLevel(crs) === undefined;
}

/** The geoid is nowhere farther from the ellipsoid, metres (EGM96: 106.9 m south of India). */
const GEOID_FARTHEST = 107;

/**
 * How far off the points may be that {@link ownLevel} leaves without a geoid, in words.
 *
 * @param undulation of the geoid at the place, metres; undefined where that is not known
 */
export function ownLevelNote(
  { height }: Pick<Crs, "height">,
  { offset }: OwnLevel,
  undulation?: number,
): string {
  const name = height.kind === "geoid" ? height.model : "its heights";
  const metres = Math.ceil((offset ?? 0) + Math.abs(undulation ?? GEOID_FARTHEST));
  const far =
    offset === null ? `by ${metres} m and as much as its zero is from sea level` : `by up to ${metres} m`;
  return `${name}: counts from a level of its own, shown as ellipsoidal; the heights may be off ${far}`;
}
