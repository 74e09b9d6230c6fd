import type { PointSource } from "../sources/point-source.js";
import type { Appearance } from "../workers/index.js";

/**
 * Appearance by the statistics record; undefined where the file has none. Where it has none, the first node decides,
 * one near the root and so a sample of the whole: many scanners write 8-bit colours into LAS's 16-bit fields, and no
 * colour above 255 there means that this one did.
 */
export function recordedAppearance({
  statistics,
  attributes,
}: Pick<PointSource, "statistics" | "attributes">): Appearance | undefined {
  if (!statistics) return undefined;
  const names = new Set(attributes.map(({ name }) => name));
  const known = statistics.attributes.filter(({ name }) => names.has(name));
  const ranges = new Map(known.map(({ name, min, max }) => [name, [min, max] as const]));
  return { rgbBits: statistics.rgbBits ?? 8, ranges };
}
