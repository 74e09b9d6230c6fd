import { ofClasses, Pace, type PointOrigin, type QueryVolume } from "../../../query/index.js";
import type { Plan } from "./local-plan.js";

/** Least x, least y, greatest x, greatest y; source units. */
export type SourceRectangle = readonly [number, number, number, number];

/** Points between two looks at the clock: some tenths of a millisecond. */
const SLICE = 16_384;

/** Which points are read, and to where. */
export interface ReadPoints {
  readonly plan: Plan;
  /** Default: all. */
  readonly classes?: ReadonlySet<number> | undefined;
  readonly signal?: AbortSignal | undefined;
  /** Hears the share of the points that are read, 0 to 1. */
  readonly onProgress?: ((share: number) => void) | undefined;
}

/**
 * Recorded points of a rectangle, from the lowest to the highest, in a plan.
 * @returns x, y, z of each, metres; several arrays, so that none of millions need be made
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted
 */
export async function readPoints(
  origin: PointOrigin,
  rectangle: SourceRectangle,
  { plan, classes, signal, onProgress }: ReadPoints,
): Promise<Float64Array[]> {
  const [scaleX, scaleY, scaleZ] = origin.scale;
  const [offsetX, offsetY, offsetZ] = origin.offset;
  const parts: Float64Array[] = [];
  const query = origin.query({ volume: columnOver(rectangle) });
  const total = (await query.bracket({ signal })).most;
  const pace = new Pace(signal);
  let read = 0;
  for await (const batch of query.batches({ signal })) {
    const { xyz, count: inNode } = batch.records;
    for (let from = 0; from < batch.inside.length; from += SLICE) {
      const slice = { records: batch.records, inside: batch.inside.subarray(from, from + SLICE) };
      const wanted = classes ? ofClasses(slice, classes) : slice.inside;
      const part = new Float64Array(3 * wanted.length);
      for (let i = 0, to = 0; i < wanted.length; i++) {
        const at = 3 * wanted[i];
        part[to++] = xyz[at] * scaleX + offsetX;
        part[to++] = xyz[at + 1] * scaleY + offsetY;
        part[to++] = xyz[at + 2] * scaleZ + offsetZ;
      }
      if (part.length > 0) parts.push(plan.take(part));
      await pace.rest();
    }
    read += inNode;
    onProgress?.(Math.min(1, read / total));
  }
  onProgress?.(1);
  return parts;
}

/** Several arrays as one. */
export function joined(parts: readonly Float64Array[]): Float64Array {
  const whole = new Float64Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

function columnOver([minX, minY, maxX, maxY]: SourceRectangle): QueryVolume {
  return {
    toBox(box) {
      if (box[3] < minX || box[0] > maxX || box[4] < minY || box[1] > maxY) return "out";
      const within = box[0] >= minX && box[3] <= maxX && box[1] >= minY && box[4] <= maxY;
      return within ? "in" : "crossing";
    },
    contains: (x, y) => x >= minX && x <= maxX && y >= minY && y <= maxY,
  };
}
