import { attributeStatistics, type CopcFile } from "../sources/index.js";
import type { NodeVertices } from "../workers/index.js";

/** What must be the same for all nodes of a data set, or its nodes would not match in colour. */
export interface Appearance {
  /** Bits per colour channel that the scan really uses. */
  readonly rgbBits: 8 | 16;
  /** Least and greatest intensity. */
  readonly intensity: readonly [number, number];
}

/** Appearance by the statistics record; undefined where the file has none. */
export function recordedAppearance({ statistics }: CopcFile): Appearance | undefined {
  const intensity = attributeStatistics(statistics, "intensity");
  if (!statistics || !intensity) return undefined;
  return { rgbBits: statistics.rgbBits ?? 8, intensity: [intensity.min, intensity.max] };
}

/**
 * Appearance by what one node near the root holds, a sample of the whole: many scanners write 8-bit colours
 * into LAS's 16-bit fields, and no colour above 255 there means that this one did.
 */
export function seenAppearance({ seen }: NodeVertices): Appearance {
  return {
    rgbBits: seen.colourMax > 255 ? 16 : 8,
    intensity: [seen.intensityMin, seen.intensityMax],
  };
}
