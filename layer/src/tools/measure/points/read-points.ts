import { ofClasses, type PointOrigin, type QueryVolume } from "../../../query/index.js";
import type { Plan } from "./local-plan.js";

/** Least x, least y, greatest x, greatest y; source units. */
export type SourceRectangle = readonly [number, number, number, number];

/** Which points are read, and to where. */
export interface ReadPoints {
  readonly to: Plan;
  /** Default: all. */
  readonly classes?: ReadonlySet<number> | undefined;
  readonly signal?: AbortSignal | undefined;
  /** Hears the share of the points that are read, 0 to 1. */
  readonly onProgress?: ((share: number) => void) | undefined;
}

/**
 * Recorded points of a rectangle, from the lowest to the highest, in a plan.
 * @returns x, y, z of each, metres
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted
 */
export async function readPoints(
  origin: PointOrigin,
  rectangle: SourceRectangle,
  { to, classes, signal, onProgress }: ReadPoints,
): Promise<Float64Array> {
  const { scale, offset } = origin;
  const parts: Float64Array[] = [];
  let count = 0;
  const query = origin.query({ volume: columnOver(rectangle) });
  const total = (await query.bracket({ signal })).most;
  let read = 0;
  for await (const batch of query.batches({ signal })) {
    const { xyz, count: inNode } = batch.records;
    const wanted = classes ? ofClasses(batch, classes) : batch.inside;
    const part = new Float64Array(3 * wanted.length);
    for (let i = 0; i < wanted.length; i++) {
      const at = 3 * wanted[i];
      const place = to(
        xyz[at] * scale[0] + offset[0],
        xyz[at + 1] * scale[1] + offset[1],
        xyz[at + 2] * scale[2] + offset[2],
      );
      part.set(place, 3 * i);
    }
    parts.push(part);
    count += part.length;
    read += inNode;
    onProgress?.(Math.min(1, read / total));
  }
  onProgress?.(1);
  const points = new Float64Array(count);
  let at = 0;
  for (const part of parts) {
    points.set(part, at);
    at += part.length;
  }
  return points;
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
