import { MeasureError } from "../../../errors/index.js";
import { axesAt } from "../vertex/axes.js";
import type { Vertex } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity } from "../worth/quantity.js";

/** A model of the ground that is no point cloud: the terrain of a globe, say. */
export interface Terrain {
  /** For people. */
  readonly name: string;
  /** One standard deviation of its heights, metres; undefined: unknown. */
  readonly precision?: number | undefined;
  /**
   * Its height at a place of WGS 84, metres above the ellipsoid; undefined where it has none.
   * @param longitude radians, as `latitude`
   */
  heightAt(longitude: number, latitude: number, signal?: AbortSignal): Promise<number | undefined>;
}

/** Options of {@link measureHeightAboveTerrain}. */
export interface AboveTerrainOptions extends WorthOptions {
  /** Stops it; what is asked for ends with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
}

/**
 * Height of a vertex above a terrain, along the normal of the ellipsoid. Datum and height reference of the vertex are part
 * of its worth, as the precision of the terrain is.
 *
 * @throws MeasureError MEASURE_TERRAIN where the terrain has no height; what the terrain throws; the signal's reason
 */
export async function measureHeightAboveTerrain(
  vertex: Vertex,
  terrain: Terrain,
  { signal, ...worth }: AboveTerrainOptions = {},
): Promise<Quantity<"m">> {
  signal?.throwIfAborted();
  const { longitude, latitude, height } = vertex;
  const ground = await terrain.heightAt(longitude, latitude, signal);
  signal?.throwIfAborted();
  if (ground === undefined || !Number.isFinite(ground)) {
    throw new MeasureError({
      code: "MEASURE_TERRAIN",
      file: terrain.name,
      cause: "it has no height below the vertex",
      fix: "wait until the terrain is loaded, or take one that covers the place",
    });
  }
  const own = [{ name: "terrain", standard: terrain.precision ?? null, note: terrain.name }];
  const up = [[{ vertex, gradient: axesAt(vertex).up }]];
  return quantity(height - ground, "m", up, { ...worth, own });
}
