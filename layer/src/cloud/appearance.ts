import type { PointSource } from "../sources/contract/point-source.js";
import { type Appearance, type Column, constantColumn, type NodeVertices } from "../workers/index.js";

/**
 * Appearance by the statistics record; undefined where the file has none. Where it has none, the first node decides,
 * one near the root and so a sample of the whole: many scanners write 8-bit colours into LAS's 16-bit fields, and no
 * colour above 255 means that this one did, until a node has one.
 */
export function recordedAppearance({
  statistics,
  attributes,
}: Pick<PointSource, "statistics" | "attributes">): Appearance | undefined {
  if (!statistics) return undefined;
  const names = new Set(attributes.map(({ name }) => name));
  const known = statistics.attributes.filter(({ name }) => names.has(name));
  const ranges = new Map(known.map(({ name, min, max }) => [name, [min, max] as const]));
  return { rgbBits: statistics.rgbBits ?? 8, rgbBitsKnown: true, ranges };
}

/**
 * Shows the colours of a node as what they are of 16 bits, whose upper byte is shown. Nothing needs to be decoded again
 * for that: colours taken for 8 bits are none above 255, so that byte is 0.
 */
export function showSixteenBits(vertices: NodeVertices): void {
  if (vertices.rgbBits === 16 || !vertices.columns.has("rgb")) return;
  // The same node with another column: what is known by its vertices, such as answers of clips, stays.
  (vertices.columns as Map<string, Column>).set("rgb", constantColumn("rgb", [0, 0, 0, 255], 1));
}
